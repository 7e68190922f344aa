/* The last states of a path, oldest first: where the next one is looked for. */
#ifndef BEAMWORK_PREDICTOR_H
#define BEAMWORK_PREDICTOR_H

#include "harness/newton/extrapolate.h"
#include "harness/newton/run_state.h"

typedef struct predictor {
    int count, iterations;                   /* of the last step */
    int most;                                /* states that a guess is made from */
    model_state *at[MODEL_EXTRAPOLATED + 1]; /* NULL: not needed so far */
    /* [m] of a guess of the last state from k states before it; k = 1: that it stays as it was */
    double error[MODEL_EXTRAPOLATED + 1];
} predictor;

status predictor_alloc(const model *, predictor *, fault *); /* holds the undeformed state */
void predictor_free(predictor *);
status predictor_add(const equations *, const model_state *, int iterations, predictor *, fault *);
void predictor_forget(predictor *);
/* Moves s, the last state, to a guess of the one at `path`, or leaves it as it is. */
void predictor_guess(const equations *, const predictor *, double path, model_state *s);

#endif
