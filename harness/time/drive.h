/* What is prescribed in time: increments, rates and their derivatives of driven coordinates. */
#ifndef BEAMWORK_DRIVE_H
#define BEAMWORK_DRIVE_H

#include "harness/newton/newton.h"

/* REFUSED: an unknown driver has no motion in time. */
status drive_check(const model *, fault *);
/* Entries [free, free + driven) of inc (from the state), v and a at `time`; each NULL: not wanted.
 */
void drive_at(const equations *, const model_state *from, double time, double inc[], double v[],
              double a[]);

#endif
