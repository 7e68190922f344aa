/* How a motion begins: velocities that were asked for, and accelerations and massless coordinates
 * that belong to them. */
#ifndef BEAMWORK_LAUNCH_H
#define BEAMWORK_LAUNCH_H

#include "harness/time/instant.h"
#include "harness/time/stage.h"

/* Behind a kink or a jump of what acts: accelerations and massless coordinates that belong to it,
 * velocities as they are. */
status launch_again(analysis_context *, const carried_masses *, const scene_motion *, instant *now,
                    instant *room, fault *);
/* now: the state and the time are given; `room` is work space. frame: the axes that the state is at
 * rest in turn so [rad/s, m]; omega zero: they do not. REFUSED: something is driven or held
 * otherwise than that turns. */
status launch_turning(analysis_context *, const carried_masses *, const scene_motion *,
                      const scene_rotating_frame *frame, instant *now, instant *room, fault *);
/* From axes at rest. */
status launch(analysis_context *, const carried_masses *, const scene_motion *, instant *now,
              instant *room, fault *);

#endif
