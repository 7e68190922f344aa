/* A frame with its mass over a step. */
#ifndef BEAMWORK_CARRIED_STEP_H
#define BEAMWORK_CARRIED_STEP_H

#include "harness/conserving/conserving_impl.h"

typedef struct carried_step {
    double Rn[9], R1[9], before[3], after[3], mean[3]; /* centre from the frame */
    double J[9];                                       /* about the centre, in the frame's axes */
    double v0[3], v1[3], W0[3], W1[3];                 /* of the centre; in the frame's axes */
    double c[3];
} carried_step;

/* Of one mass: its centre from the frame and its tensor about that, in the frame's axes. */
void carried_step_centre(const carried_mass *, double centre[3], double J[9]);
void carried_step_of(const conserving *, const instant *from, const model_state *now, double h,
                     const carried_mass *, carried_step *);

#endif
