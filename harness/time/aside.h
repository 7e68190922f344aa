/* A step beside those of a motion, which does not go on from it: what the scheme itself says of an
 * instant inside a step. */
#ifndef BEAMWORK_ASIDE_H
#define BEAMWORK_ASIDE_H

#include "harness/time/scheme.h"

/* From where the motion's step began; its work is counted, its iterations are not kept. */
status aside_step(analysis_context *, motion_scheme *, const instant *from, double time,
                  instant *at, fault *);

#endif
