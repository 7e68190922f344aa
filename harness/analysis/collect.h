/* Centre lines of what has been solved, for pictures. */
#ifndef BEAMWORK_COLLECT_H
#define BEAMWORK_COLLECT_H

#include "harness/newton/newton.h"

/* Of the undeformed structure, of at most `most` states of every path, of linear solutions and
 * modes. */
status collect_shapes(const analysis_context *, int most, shapes *, fault *);

#endif
