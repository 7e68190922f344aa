/* Compliances along a path, taken while it is walked: where Newton's last correction changes the
 * tangent by less than its rounding, the last tangent is that of the station, and no other one is
 * made; one is made at once where members are condensed. */
#ifndef BEAMWORK_COMPLIANCE_WALK_H
#define BEAMWORK_COMPLIANCE_WALK_H

#include "harness/newton/newton.h"

typedef struct compliance_walk compliance_walk;

/* Of all analyses that follow `path`; *out NULL: there are none. */
status compliance_walk_begin(newton_run *, int path, compliance_walk **out, fault *);
/* Newton has reached the station; what cannot be had now is left to the analysis itself. w NULL:
 * nothing follows. FAULT: out of memory. */
status compliance_walk_take(compliance_walk *w, const newton_run *, int station, fault *);
void compliance_walk_end(compliance_walk *);

#endif
