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

#include "elements/math/vec3.h"
#include "elements/shared/lanes.h"

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
enum { SHEET_LOCAL_NODAL = 2 * NODE_COORDINATES };

typedef struct sheet_local_state {
    real q[SHEET_LOCAL_COORDINATES];
    real F[9]; /* columns n j k */
    real l;    /* present distance of the nodes [m] */
    real tan_yp, sec_yp, cos_yq, sin_yq, tan_zq, sec_zq;
} sheet_local_state;

/* chord: initial distance of the nodes [m], from which the elongation is counted.  F^T R^p =
 * Ry(yp) Rz(zp), whose first row is n seen from p, and F^T R^q = Ry(yq) Rz(zq) Rx(px). */
static inline void sheet_local_of(double chord, const node_real x[2], sheet_local_state *out)
{
    const real *p = x[0].R, *q = x[1].R;
    real d[3], moved[3], D[3], F[3][3], M[9];
    for (int i = 0; i < 3; i++) {
        d[i] = x[1].r[i] - x[0].r[i];
        moved[i] = x[1].u[i] - x[0].u[i];
    }
    mat3_transpose_mul_vec(p, d, D);
    const real l = real_sqrt(vec3_dot(d, d)), h = real_sqrt(D[0] * D[0] + D[1] * D[1]);
    for (int i = 0; i < 3; i++) {
        F[0][i] = d[i] / l;
        F[1][i] = (p[3 * i + 1] * D[0] - p[3 * i] * D[1]) / h;
    }
    vec3_cross(F[0], F[1], F[2]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out->F[3 * i + k] = F[k][i];
    mat3_transpose_mul(out->F, q, M);
    const real m = real_sqrt(M[0] * M[0] + M[6] * M[6]);
    out->l = l;
    out->q[SHEET_LOCAL_U] = vec3_elongation(d, moved, chord);
    out->q[SHEET_LOCAL_YP] = real_atan2(D[2], h);
    out->q[SHEET_LOCAL_ZP] = real_atan2(-D[1], D[0]);
    out->q[SHEET_LOCAL_YQ] = real_atan2(-M[6], M[0]);
    out->q[SHEET_LOCAL_ZQ] = real_atan2(M[3], m);
    out->q[SHEET_LOCAL_PX] = real_atan2(-M[5], M[4]);
    out->q[SHEET_LOCAL_WP] = x[0].a;
    out->q[SHEET_LOCAL_WQ] = x[1].a;
    out->tan_yp = D[2] / h;
    out->sec_yp = l / h;
    out->cos_yq = M[0] / m;
    out->sin_yq = -M[6] / m;
    out->tan_zq = M[3] / m;
    out->sec_zq = 1 / m;
}

#endif
