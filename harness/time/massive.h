/* Errors of what has inertia. Accelerations of what has none are its positions by the square of a
 * step, so that an estimate that reads them tells nothing of the error of a motion. */
#ifndef BEAMWORK_MASSIVE_H
#define BEAMWORK_MASSIVE_H

#include "harness/time/carried.h"

typedef struct massive {
    int ready;
    double *light; /* [nodes and bodies x 2 x 9] onto shifts and onto turns without inertia, turns
                      in the frames' axes; NULL: there are none */
} massive;

/* Of the masses in a state, once. */
status massive_of(const model *, const carried_masses *, const model_state *, massive *, fault *);
void massive_free(massive *);
/* Root of the sum of weight[c] e[c]^2 over the free coordinates, without what has no inertia, which
 * e loses. */
double massive_norm(const massive *, const model *, const double weight[], double e[]);

#endif
