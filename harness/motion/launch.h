/* How a motion begins: velocities that were asked for, and accelerations and massless coordinates
 * that belong to them. */
#ifndef BEAMWORK_LAUNCH_H
#define BEAMWORK_LAUNCH_H

#include "harness/scheme/instant.h"
#include "harness/scheme/stage.h"

/* Behind a kink or a jump of what acts: accelerations and massless coordinates that belong to it,
 * velocities as they are. */
status launch_again(analysis_context *, const carried *, const scene_motion *, instant *now,
                    instant *room, fault *);
/* now: the state and the time are given; `room` is work space. */
status launch(analysis_context *, const carried *, const scene_motion *, instant *now,
              instant *room, fault *);

#endif
