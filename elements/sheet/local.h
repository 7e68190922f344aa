/* Local coordinates of a two-node beam that is simply supported in its own frame (N Eqs. 12, 40, 42).
 *
 * The frame F = (n, j, k): n from p to q, j across n and the z axis of p, k = n x j.  In it the nodes' triads are
 * F^T R^p = Ry(yp) Rz(zp) and F^T R^q = Ry(yq) Rz(zq) Rx(px).
 *
 * Derivatives are taken with respect to eleven rates along a path of constant velocity and constant spatial spin: in frame
 * axes the relative velocity v of q against p, the spins P and Q of the nodes, and the rates of the two warping amplitudes. */
#ifndef BEAMWORK_SHEET_LOCAL_H
#define BEAMWORK_SHEET_LOCAL_H

#include "elements/element.h"

/* u elongation [m]; angles [rad] of N, x twist, y and z bending; W warping amplitudes [rad/m] */
enum {
    LOCAL_U,
    LOCAL_PX,
    LOCAL_YP,
    LOCAL_YQ,
    LOCAL_ZP,
    LOCAL_ZQ,
    LOCAL_WP,
    LOCAL_WQ,
    LOCAL_COORDINATES
};
enum { RATE_V = 0, RATE_P = 3, RATE_Q = 6, RATE_TURNS = 9, RATE_WP = 9, RATE_WQ, RATES };
enum { LOCAL_NODAL = 2 * NODE_COORDINATES };

typedef struct local_state {
    double q[LOCAL_COORDINATES];
    double F[9]; /* columns n j k */
    double l;    /* present distance of the nodes [m] */
    double tan_yp, sec_yp, cos_yq, sin_yq, tan_zq, sec_zq;
} local_state;

/* chord: initial distance of the nodes [m], from which the elongation is counted. */
void local_of(double chord, const node_state x[2], local_state *out);

/* R[8 x 11]: dq/dt = R rates. */
void local_rates(const local_state *s, double R[LOCAL_COORDINATES * RATES]);

/* H[11 x 11] += sum_k t_k d2q_k/dt2 as a symmetric form in the rates. */
void local_add_second(const local_state *s, const double R[LOCAL_COORDINATES * RATES],
                      const double t[LOCAL_COORDINATES], double H[RATES * RATES]);

/* From rates to the coordinates of the nodes: J[m x 14] = A[m x 11] d(rates)/dx, K[14 x 14] = the same for a symmetric form
 * H[11 x 11]. */
void local_nodal_gradient(const local_state *s, int m, const double A[], double J[]);
void local_nodal_form(const local_state *s, const double H[RATES * RATES],
                      double K[LOCAL_NODAL * LOCAL_NODAL]);

#endif
