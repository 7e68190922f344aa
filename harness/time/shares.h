/* Forces of inertia as reactions and resultants of sections take them. */
#ifndef BEAMWORK_SHARES_H
#define BEAMWORK_SHARES_H

#include "harness/time/carried.h"

/* The motion that they are asked of. */
typedef struct shares_motion {
    const double *v, *a; /* [free + driven] */
    int spread;          /* 1: elements spread their masses (spread.h) */
} shares_motion;

/* F[6] += force and moment (about the node's frame) that the masses moved by a node take. */
status shares_node(const model *, const model_state *, const shares_motion *, int node, double F[6],
                   fault *);
/* density[nodes][6]: what the mass of one element takes where it moves as each of its nodes does,
 * per initial length, with the moment about that node. */
void shares_along(const model *, const model_state *, const shares_motion *, int element,
                  double density[ELEMENT_MAX_NODES][6]);
/* Of the mass of one element: ends[e][7] += what its share at the first (0) and the last (1) node
 * takes, with the warping's. */
void shares_ends(const model *, const model_state *, const shares_motion *, int element,
                 double ends[2][7]);

#endif
