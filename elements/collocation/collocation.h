#ifndef BEAMWORK_COLLOCATION_COLLOCATION_H
#define BEAMWORK_COLLOCATION_COLLOCATION_H

#include "elements/geometrically_exact/exact.h"

/* One element of a geometrically exact beam with warping, solved by Gauss collocation (derived
 * here).
 *
 * The strains e are those of the two-node element of exact.h, in the mean axes of the ends: v, the
 * vector from p to q; 2 X, a vector of magnitude 8 tan(angle/8) along the axis of the rotation from
 * p to q; and the warping amplitudes a at the ends. The vector x (stage.h) gives the orientation.
 * The components of x are polynomials of degree p through -X, p - 1 inner values and X. The force F
 * is constant. The potential
 *
 *   P = F . v + sum_i w_i [-N_x - N_x^2/2EA - 1/2 (N_y, N_z) F_s (N_y, N_z)
 *                          + (ys N_z - zs N_y) k + 1/2 rho^2 N_x k^2 + 1/2 EI_y kappa_y^2
 *                          + 1/2 EI_z kappa_z^2 + 1/2 GJ k^2 + c k^4] + warping (exact.h),
 *   N = R^T F, k = kappa_x, over p Gauss points,
 *
 * with the shear flexibility F_s, rho^2 = trapeze and c = torque (beam_constants.h), is stationary
 * with respect to F and the inner x. In a linear problem this is collocation of the moment
 * equilibrium m' = F x r' at the Gauss points, and N = R^T F satisfies force equilibrium exactly.
 * The tangent is symmetric, and the error is of order 2 p. All values are dimensionless
 * (beam_constants.h). */

enum {
    EXACT_STAGES_MAX = EXACT_WARPING_MAX_STAGES,
    EXACT_STAGES_NODES = EXACT_STAGES_MAX + 1,
    EXACT_STAGES_OUTER = 8,                       /* strains */
    EXACT_STAGES_UNKNOWNS = 3 * EXACT_STAGES_MAX, /* F, inner x */
    EXACT_STAGES_ALL = EXACT_STAGES_UNKNOWNS + EXACT_STAGES_OUTER
};

/* First part of the element_data of collocation elements. The interpolated variables are x of the
 * inner nodes, then 2 X (x is -X at p and X at q). */
typedef struct exact_stages {
    int stages,
        unknowns; /* number of Gauss points, and of the unknowns F (3) and x of the inner nodes */
    beam_constants c;
    exact_strain_line line;
    double w[EXACT_STAGES_MAX], N[EXACT_STAGES_MAX][EXACT_STAGES_MAX],
        dN[EXACT_STAGES_MAX]
          [EXACT_STAGES_MAX]; /* coefficients of x and x' at the points for the variables */
    double rest_x[EXACT_STAGES_NODES][3], rest_kappa[EXACT_STAGES_MAX][3], rest_v[3];
    double rest_axis[EXACT_STAGES_MAX]
                    [3]; /* R (e_x + g) at the points of the stress-free element */
    int warps;
    double S[EXACT_WARPING_MAX * EXACT_WARPING_MAX];
} exact_stages;

status exact_stages_prepare(const element_request *request, int count, exact_stages *out, fault *f);

/* A dead force per length q(x) inside the equilibrium of a collocation element (derived here). The
 * internal force is F + g(x), where F is the force in the middle and
 *   g(x) = l0 (int_x^1 q - 1/2 int_0^1 q).
 * F + g replaces F in N above, and half of int q acts on each node. Together, both terms represent
 * the load potential - int q . r. F and xi = G^T g are given in the mean axes G of the ends. A
 * small rotation psi of G, in the axes of G, changes xi by xi x psi. The potential depends on G
 * only through xi. */

/* Data of a kind of element. q is given at the points of element.h. */
typedef struct exact_along {
    double at[EXACT_STAGES_MAX]
             [ELEMENT_ALONG_POINTS]; /* weights of q in g at the Gauss points [m] */
    double missed[ELEMENT_ALONG_POINTS]
                 [3]; /* part of the work on the undeformed line that the quadrature at the stages
                         omits [m^2]; it rotates with G */
    double half[ELEMENT_ALONG_POINTS]; /* weights of half of int q [m] */
} exact_along;

/* The frame G of an element in its current state, and g in the axes of G. */
typedef struct exact_along_frame {
    double q[2][4], u[4], size; /* quaternions of the nodes, their mean, and its length */
    /* g [N], and missed [N m] with columns in axes of G */
    double G[9], g[EXACT_STAGES_MAX][3], missed[9];
    double xi[EXACT_STAGES_MAX][3]; /* dimensionless */
} exact_along_frame;

void exact_along_prepare(const element_request *, const exact_stages *, exact_along *);
void exact_along_frame_of(const exact_stages *, const exact_along *, const node_state x[],
                          const double force[], exact_along_frame *);
/* Computes the terms that depend on the evaluated stages: end forces, the effect of the rotation of
 * G, H, and the contribution of the undeformed line to `moment`. moved[stages][3] is the derivative
 * of the energy with respect to xi. */
void exact_along_finish(const exact_stages *, const exact_along *, const exact_along_frame *,
                        double moved[][3], along_output *);
/* Computes the output for the undeformed element, which is linear in the force. SINGULAR: the
 * equations of the stages are singular. */
status exact_along_linear(const exact_stages *, const exact_along *, const node_state x[],
                          along_output *);
/* Computes derivatives with respect to the size of along_output.rate. SINGULAR: the equations of
 * the stages are singular. */
status exact_along_rate(const exact_stages *, const exact_along *, const node_state x[],
                        along_output *);

/* Computes column = d(xi)/d(psi). */
static inline void exact_along_column(const double xi[3], double column[9])
{
    const double skew[9] = {0, -xi[2], xi[1], xi[2], 0, -xi[0], -xi[1], xi[0], 0};
    for (int i = 0; i < 9; i++)
        column[i] = skew[i];
}

/* Computes Q[i], the derivative of the condensed stiffness [8 x 8] with respect to stress i in the
 * undeformed geometry, where the stiffness is linear in the stresses. Q is dimensionless. */
void exact_prestress_derivatives(
    const exact_stages *s, double Q[EXACT_STAGES_OUTER][EXACT_STAGES_OUTER * EXACT_STAGES_OUTER]);

/* Computes Q [strains x strains] for loads along an element whose nodes are fixed. The loads add
 * along[stages] to F at the points. */
void exact_prestress_load(const exact_stages *s, double along[][3],
                          double Q[EXACT_STAGES_OUTER * EXACT_STAGES_OUTER]);

/* Stresses of one collocation element. The second function of each pair is for processors with AVX2
 * and gives bit-for-bit identical results (elements/math/real.h). */

typedef status exact_alone_stresses(const exact_stages *, const double e[], const double inner[],
                                    stress_output *);
/* Computes the outputs of element_type.along for one element. */
typedef status exact_alone_loads(const exact_stages *, const exact_along *, const node_state x[],
                                 along_output *);

exact_alone_stresses exact_alone_stress_plain, exact_alone_stress_avx2;
exact_alone_loads exact_alone_along_plain, exact_alone_along_avx2;

typedef void exact_lanes_loads(const exact_stages *, const exact_along *, int count,
                               const node_state x[], along_output out[], status outcome[]);

/* Strains and stresses for data that begin with exact_stages. */
exact_lanes_strains exact_lanes_stages_strain_plain, exact_lanes_stages_strain_avx2;
exact_lanes_stresses exact_lanes_stages_stress_plain, exact_lanes_stages_stress_avx2;
/* Computes the outputs of element_type.along for at most LANES_TOGETHER elements of one kind. */
exact_lanes_loads exact_lanes_along_plain, exact_lanes_along_avx2;

#endif
