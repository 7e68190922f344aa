/* Local coordinates of N's elements (N Eqs. 40, 42): elongation of the chord and the angles of both nodes to the simply
 * supported frame pu, whose x axis is the chord and whose roll is that of node p. */
#ifndef BEAMWORK_SHEET_LOCAL_H
#define BEAMWORK_SHEET_LOCAL_H

#include "elements/element.h"

enum { LOCAL_U, LOCAL_PX, LOCAL_YP, LOCAL_YQ, LOCAL_ZP, LOCAL_ZQ, LOCAL_WP, LOCAL_WQ, LOCALS };

typedef struct local_frame {
    double value[LOCALS];        /* [m], [rad] x 5, [rad/m] x 2 */
    double gradient[LOCALS][14]; /* with respect to the element's coordinates */
    /* What the Hessian needs: first and second derivatives in (d, eta), the position and rotation of q seen from p. */
    double inner_gradient[6][6], inner_hessian[6][21];
    double Rp[9], d[3]; /* triad of p, Rp^T (rq - rp) */
} local_frame;

/* derivatives: 0 value, 1 and the gradient, 2 and what local_hessian needs. */
void local_evaluate(double length, const node_state x[2], int derivatives, local_frame *out);
/* H[14 x 14] += sum_a w_a d2 x_a/dx2, symmetric in the exponential chart. */
void local_add_hessian(const local_frame *l, const double w[LOCALS], double H[14 * 14]);

#endif
