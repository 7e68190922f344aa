/* One instant of a motion, found by mixed Newton (N section 4) from the instant before: equilibrium
 * with the forces of inertia of rates that follow the increment,
 *   v = v0 + g inc,   a = a0 + b inc.
 * Elements keep strains and stresses as unknowns, so that stiff ones cost no iterations. */
#ifndef BEAMWORK_STAGE_H
#define BEAMWORK_STAGE_H

#include "harness/newton/newton.h"
#include "harness/time/carried.h"
#include "harness/time/complement.h"
#include "harness/time/inertia.h"

/* Do the factors of the last equations serve for the next ones? What they lack is the product of
 * both corrections; those of the stresses (newton.h) tell where members are stiff. Measured with
 * elongations 1e6 times stiffer: beyond 2e-4 corrections stop to contract and steps of 0.2 s fail,
 * below as many iterations as with factors of their own. */
int stage_stands(const arrival *);

typedef struct motion_stage {
    analysis_context *c;
    const carried_masses *masses;
    sparse S;
    matrix_factor *factor;
    double *residual, *dx; /* [free + driven] */
    arrival arrival;
    complement *complement;
    int all, free;
    int begins; /* 1: at a kink what acts behind it counts, 0: what acts before */
    long counted;
} motion_stage;

status stage_alloc(analysis_context *, const carried_masses *, motion_stage *, fault *);
void stage_free(motion_stage *);

/* S dx = residual; fresh 0: with the factors that there are. */
status stage_direction(motion_stage *, int fresh, fault *);

/* All arrays [free + driven]. */
typedef struct stage_rates {
    double b, g;
    const double *a0, *v0;
    double *inc, *v, *a; /* in: inc is the guess, all of the driven coordinates are right */
} stage_rates;
/* `now` has the strains and stresses of `from`, or better ones, and comes to the state at `time`.
 * NOT_CONVERGED: why; then `now` is of no use. */
status stage_solve(motion_stage *, const model_state *from, double time, stage_rates *,
                   model_state *now, step_record *, fault *);

#endif
