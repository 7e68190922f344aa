/* One element of a geometrically exact beam with warping, solved by Gauss collocation (derived
 * here).
 *
 * In the axes half way between its ends the element has the strains e of strain.h (two nodes): v,
 * the vector from p to q, and 2 X, 8 tan(angle/8) about the axis of the rotation from p to q; and
 * the end amplitudes a.  Orientation is given by a vector x (milenkovic.h), a polynomial of degree
 * p through -X, p - 1 inner values and X.  The force F is constant.  The potential
 *
 *   P = F . v + sum_i w_i [-N_x - N_x^2/2EA - 1/2 (N_y, N_z) F (N_y, N_z) + (ys N_z - zs N_y) k +
 * 1/2 rho^2 N_x k^2
 *                          + 1/2 EI_y kappa_y^2 + 1/2 EI_z kappa_z^2 + 1/2 GJ k^2 + c k^4] +
 * warping (warping.h), N = R^T F, k = kappa_x, over p Gauss points,
 *
 * is stationary in F and in the inner x.  In a linear problem this is collocation of the moments'
 * equilibrium m' = F x r' at the Gauss points; N = R^T F is in equilibrium exactly.  The tangent is
 * symmetric, and the error of order 2 p.  All dimensionless (beam_constants.h). */
#ifndef BEAMWORK_EXACT_STAGES_H
#define BEAMWORK_EXACT_STAGES_H

#include "elements/geometrically_exact/strain.h"
#include "elements/geometrically_exact/warping.h"

enum {
    EXACT_STAGES_MAX = EXACT_WARPING_MAX_STAGES,
    EXACT_STAGES_NODES = EXACT_STAGES_MAX + 1,
    EXACT_STAGES_OUTER = 8,                       /* strains */
    EXACT_STAGES_UNKNOWNS = 3 * EXACT_STAGES_MAX, /* F, inner x */
    EXACT_STAGES_ALL = EXACT_STAGES_UNKNOWNS + EXACT_STAGES_OUTER
};

/* Head of the element_data of collocation elements. Variables: x of the inner nodes, then 2 X, of
 * which each end node has half. */
typedef struct exact_stages {
    int stages, unknowns; /* unknowns: F (3), x of the inner nodes */
    beam_constants c;
    exact_strain_line line;
    double w[EXACT_STAGES_MAX], N[EXACT_STAGES_MAX][EXACT_STAGES_MAX],
        dN[EXACT_STAGES_MAX][EXACT_STAGES_MAX]; /* x and x' at the points from the variables */
    double rest_x[EXACT_STAGES_NODES][3], rest_kappa[EXACT_STAGES_MAX][3], rest_v[3];
    double rest_axis[EXACT_STAGES_MAX][3]; /* R (e_x + g) at the points, without stress */
    int warps;                             /* 0: no warping energy */
    double S[EXACT_WARPING_MAX * EXACT_WARPING_MAX];
} exact_stages;

status exact_stages_prepare(const element_request *request, int count, exact_stages *out, fault *f);

#endif
