/* Local coordinates of a two-node beam that is simply supported in its own frame (N Eqs. 12, 40,
 * 42).
 *
 * The frame F = (n, j, k): n from p to q, j across n and the z axis of p, k = n x j.  In it the
 * nodes' triads are F^T R^p = Ry(yp) Rz(zp) and F^T R^q = Ry(yq) Rz(zq) Rx(px).
 *
 * Derivatives are taken with respect to eleven rates along a path of constant velocity and constant
 * spatial spin: in frame axes the relative velocity v of q against p, the spins P and Q of the
 * nodes, and the rates of the two warping amplitudes. */
#ifndef BEAMWORK_SHEET_LOCAL_H
#define BEAMWORK_SHEET_LOCAL_H

#include "elements/element.h"

/* u elongation [m]; angles [rad] of N, x twist, y and z bending; W warping amplitudes [rad/m] */
enum {
    SHEET_LOCAL_U,
    SHEET_LOCAL_PX,
    SHEET_LOCAL_YP,
    SHEET_LOCAL_YQ,
    SHEET_LOCAL_ZP,
    SHEET_LOCAL_ZQ,
    SHEET_LOCAL_WP,
    SHEET_LOCAL_WQ,
    SHEET_LOCAL_COORDINATES
};
enum {
    SHEET_RATE_V = 0,
    SHEET_RATE_P = 3,
    SHEET_RATE_Q = 6,
    SHEET_RATE_TURNS = 9,
    SHEET_RATE_WP = 9,
    SHEET_RATE_WQ,
    SHEET_RATES
};
enum { SHEET_LOCAL_NODAL = 2 * NODE_COORDINATES };

typedef struct sheet_local_state {
    double q[SHEET_LOCAL_COORDINATES];
    double F[9]; /* columns n j k */
    double l;    /* present distance of the nodes [m] */
    double tan_yp, sec_yp, cos_yq, sin_yq, tan_zq, sec_zq;
} sheet_local_state;

/* chord: initial distance of the nodes [m], from which the elongation is counted. */
void sheet_local_of(double chord, const node_state x[2], sheet_local_state *out);

/* R[8 x 11]: dq/dt = R rates. */
void sheet_local_rates(const sheet_local_state *s, double R[SHEET_LOCAL_COORDINATES * SHEET_RATES]);

/* H[11 x 11] += sum_k t_k d2q_k/dt2 as a symmetric form in the rates. */
void sheet_local_add_second(const sheet_local_state *s,
                            const double R[SHEET_LOCAL_COORDINATES * SHEET_RATES],
                            const double t[SHEET_LOCAL_COORDINATES],
                            double H[SHEET_RATES * SHEET_RATES]);

/* From rates to the coordinates of the nodes: J[m x 14] = A[m x 11] d(rates)/dx, K[14 x 14] = the
 * same for a symmetric form H[11 x 11]. */
void sheet_local_nodal_gradient(const sheet_local_state *s, int m, const double A[], double J[]);
void sheet_local_nodal_form(const sheet_local_state *s, const double H[SHEET_RATES * SHEET_RATES],
                            double K[SHEET_LOCAL_NODAL * SHEET_LOCAL_NODAL]);

#endif
