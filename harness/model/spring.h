/* A spring between two frames, or between a frame and the ground. */
#ifndef BEAMWORK_MODEL_SPRING_H
#define BEAMWORK_MODEL_SPRING_H

#include "elements/element.h"

enum { SPRING_STRAINS = 6 };

/* Deformation d = (R_p^T (r_q - r_p) less its initial value [m], rotation vector of R_p^T R_q
 * [rad]) in the axes of p; with one node q, p is the ground.  x[nodes]: R is the turn since the
 * undeformed state.  out->e[6], out->J[6 x 7 nodes] and out->H[7 nodes x 7 nodes] of out->s[6], in
 * the exponential chart, as strains of elements are.  near: the vector that the turn has come to,
 * by which that of several turns is known; NULL: less than half a turn.
 *
 * On a full turn the vector's derivatives across it have no bounds; within 1e-3 rad of it they stay
 * what they are there. The moment stays exact while it is along the turn (turns.h). */
void spring_strain(int nodes, const node_state x[], const double near[3], strain_output *out);

#endif
