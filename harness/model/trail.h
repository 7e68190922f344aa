/* The last states of a path, oldest first: where the next one is looked for. */
#ifndef BEAMWORK_TRAIL_H
#define BEAMWORK_TRAIL_H

#include "harness/model/extrapolate.h"
#include "harness/model/model.h"

typedef struct trail {
    int count,
        iterations; /* of the last step: one that took many was too long to extrapolate from */
    model_state *at[MODEL_EXTRAPOLATED];
} trail;

status trail_alloc(const model *, trail *, fault *); /* holds the undeformed state */
void trail_free(trail *);
void trail_add(const model *, const model_state *, int iterations, trail *);
void trail_forget(trail *);
/* Moves s, the last state, to a guess of the one at `path`, or leaves it as it is. */
void trail_guess(const model *, trail *, double path, model_state *s);

#endif
