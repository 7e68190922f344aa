/* Forces of inertia as reactions and resultants of sections take them. */
#ifndef BEAMWORK_SHARES_H
#define BEAMWORK_SHARES_H

#include "harness/inertia/carried.h"

/* F[6] += force and moment (about the node's frame) that the masses moved by a node take. */
status shares_node(const model *, const model_state *, const double v[], const double a[], int node,
                   double F[6], fault *);
/* Of the mass of one element: ends[e][7] += what its share at the first (0) and the last (1) node
 * takes, with the warping's. */
void shares_ends(const model *, const model_state *, const double v[], const double a[],
                 int element, double ends[2][7]);

#endif
