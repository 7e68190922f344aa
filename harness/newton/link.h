/* An element as a link of a chain. */
#ifndef BEAMWORK_LINK_H
#define BEAMWORK_LINK_H

#include "harness/newton/chain.h"

/* Tangent J^T C J + H of an element in coordinates of its nodes (element.h). */
typedef struct link_element {
    int nodes, strains, joint; /* joint: the first coordinates of each node that are wanted */
    const double *J, *C, *H;   /* [strains x 7 nodes], [strains x strains], [7 nodes x 7 nodes] */
    const double *r;           /* [nodes x 3] places of the nodes [m] */
} link_element;

/* Carrying the element along, R, strains it by E = J R, rounding but for warping; it follows by
 * R + d, d = -F (J_y^T C E + (H R)_y), and B = (E + J_y d)^T C (E + J_y d) + (R + d)^T H (R + d):
 * no entries of the size of K are subtracted from each other.
 * SINGULAR: clamped at its first node it is at a critical state. */
status link_of(const link_element *, chain_link *, fault *);

#endif
