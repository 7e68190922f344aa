/* The mass matrix of what moves with one body: its coordinates and those of the ends of members
 * that are released from it. */
#ifndef BEAMWORK_BODY_MASS_H
#define BEAMWORK_BODY_MASS_H

#include "harness/time/carried.h"

typedef struct body_mass {
    int count, *index;    /* free coordinates [count] */
    double *M;            /* [count x count] by spatial increments; turns in lengths of the model */
    double *unit;         /* [count] 1; of a turn that makes the length of the model [rad/m] */
    int *used;            /* room [count] */
    double *rest, *value; /* room [count x count], [count] */
    double *zero;         /* [free + driven] rates */
} body_mass;

/* Room for any body of the model. */
status body_mass_alloc(const model *, body_mass *, fault *);
void body_mass_free(body_mass *);
/* Of one body in a state; returns the largest mass in it [kg]. */
double body_mass_of(const model *, const carried_masses *, int body, const model_state *,
                    body_mass *);
/* Of a warping amplitude [kg m^4]. */
double body_mass_warps(const model *, const carried_masses *, int warp, const model_state *);
/* Rank of M, in which `none` is zero. */
int body_mass_rank(body_mass *, double none);

#endif
