/* Nodes of one element where a test puts them, and derivatives of its strains by differences.
 * Increments d [7 nodes]: displacement [m], spatial rotation vector, warping amplitude [rad/m]. */
#ifndef BEAMWORK_TEST_NODES_H
#define BEAMWORK_TEST_NODES_H

#include "elements/element.h"

/* A straight element along x that is not deformed. */
void nodes_straight(int nodes, double length, node_state x[]);
/* R: turned by the rotation vector about fixed axes, after what R turned it by. */
void nodes_turn(double R[9], const double turn[3]);
/* Moves every node by `times` its part of d. */
void nodes_move(int nodes, double times, const double d[], node_state x[]);
/* The straight element, moved by d. */
void nodes_place(int nodes, double length, const double d[], node_state x[]);
/* Increments uniform in (-size/2, size/2) lengths, radians, 1/lengths. */
void nodes_increments(int nodes, double length, double size, unsigned seed, double d[]);

/* J and H at x against central differences of fourth order of e and of J^T s along the path that
 * moves the nodes by d; s: any stresses [strains]. */
typedef struct nodes_departure {
    double first;     /* of J d, in parts of its largest entry */
    double second;    /* of H d, likewise: H holds in the exponential chart of x */
    double asymmetry; /* of H */
} nodes_departure;
nodes_departure nodes_differences(const element_type *, const element_data *, int nodes,
                                  int strains, const node_state x[], const double d[],
                                  const double s[]);

/* Largest |A[i][j] - A[j][i]| [n x n] beside the largest entry. */
double nodes_asymmetry(int n, const double A[]);

#endif
