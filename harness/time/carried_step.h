/* A frame with its mass over a step. */
#ifndef BEAMWORK_CARRIED_STEP_H
#define BEAMWORK_CARRIED_STEP_H

#include "harness/time/conserving_impl.h"

typedef struct carried_step {
    double Rn[9], R1[9];
    double centre[3], before[3], after[3], mean[3]; /* from the frame; centre: in its axes */
    double J[9];                                    /* about the centre, in the frame's axes */
    double v0[3], v1[3], W0[3], W1[3];              /* of the centre; in the frame's axes */
    double c[3];
    int rides, held[3]; /* 1: translations of the frame are held, and not all */
    double g[3], behind[3], turned[3], late[3]; /* of these (carried_step.c) */
} carried_step;

/* Of one mass: its centre from the frame and its tensor about that, in the frame's axes; of a frame
 * that only turns it is about the frame, which then counts as its centre. */
void carried_step_centre(const model *, const carried_mass *, double centre[3], double J[9]);
void carried_step_of(const conserving *, const instant *from, const model_state *now, double h,
                     const carried_mass *, carried_step *);

/* carried_step.c: where a translation of the frame is held beside free ones. */
/* v1 of the held ones, and the moment `late`. */
void carried_step_follow(const carried_mass *, carried_step *);
/* sway[9] = -h/2 dv1/dc; swept: minus d(centre)/dc, T: cayley_tangent. */
void carried_step_sway(const carried_step *, double h, const double T[9], const double swept[9],
                       double sway[9]);
/* K[6 x 6] += derivative of `late`. */
void carried_step_late(const carried_mass *, const carried_step *, double h, const double T[9],
                       const double sway[9], double K[36]);

#endif
