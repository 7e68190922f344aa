/* Records of motions, and what is said of them. */
#ifndef BEAMWORK_PACE_RECORD_H
#define BEAMWORK_PACE_RECORD_H

#include "harness/experiments/integrators.h"

extern const record_type record_pace_all, record_pace_run;
extern const record_type *const pace_records[]; /* all but the first; ends with NULL */
/* found: motions. */
void pace_gather(const void *found, const record_type *type, subjects *out);

#endif
