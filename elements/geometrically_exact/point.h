/* Geometry at one point of a line whose section turns: quaternions of the nodes are interpolated as
 * vectors of R^4, Q = sum N_k q_k, and normalised.  Turning all q_k turns Q with them, so that
 * strains in the section's axes are objective (derived here).  No function of an angle is needed,
 * and every derivative is rational in Q.
 *
 *   kappa = 2 Im(Q^-1 Q'),  v = R(Q)^T y.
 *
 * In the axes of the section, A = u^-1 dQ/m and D = u^-1 dQ'/m, with (A0, A) their scalar and
 * vector parts: dkappa = 2 D - A0 kappa - 2 eta A - A x kappa,   dv = dy - 2 A x v, d2kappa = 2
 * (A0^2 - |A|^2) kappa + 8 eta A0 A + 4 A0 A x kappa - 4 (A0 D + D0 A + A x D), d2v = 4 A0 A x v +
 * 4 A x (A x v) - 4 A x dy, from the expansion of Q^-1 Q' and of the rotation 2 Im Q/Re Q.
 *
 * Turning node k by the spatial increment theta makes q_k -> exp(theta/2) q_k: first derivative 1/2
 * theta q_k, second -1/4 |theta|^2 q_k; A = N_k a_k theta, D = N'_k a_k theta.  The caller chooses
 * the unit of length.  In lanes (real.h). */
#ifndef BEAMWORK_EXACT_POINT_H
#define BEAMWORK_EXACT_POINT_H

#include "elements/math/vec3.h"

typedef struct exact_point {
    real m, u[4];  /* Q = m u, |u| = 1 */
    real eta;      /* m'/m */
    real R[9];     /* axes of the section, columns */
    real kappa[3]; /* twist rate and curvatures in the section's axes */
    real v[3];     /* y in the section's axes */
} exact_point;

/* Effect of the rotation of one node at the point. */
typedef struct exact_point_turn {
    real c[4];             /* u^-1 q */
    real a[12];            /* [4 x 3] */
    real kappa[9], v[9];   /* derivatives of kappa and v with respect to theta, rows */
    real twice[12], by[9]; /* exact_point_second: on the right of its products */
} exact_point_turn;

/* ab = a^-1 o b */
static inline void exact_point_relative(const real a[4], const real b[4], real ab[4])
{
    ab[0] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    ab[1] = a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2];
    ab[2] = a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1];
    ab[3] = a[0] * b[3] - a[1] * b[2] + a[2] * b[1] - a[3] * b[0];
}

static inline void exact_point_axes(const real q[4], real R[9])
{
    const real w = q[0], x = q[1], y = q[2], z = q[3];
    R[0] = 1 - 2 * (y * y + z * z);
    R[1] = 2 * (x * y - w * z);
    R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z);
    R[4] = 1 - 2 * (x * x + z * z);
    R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y);
    R[7] = 2 * (y * z + w * x);
    R[8] = 1 - 2 * (x * x + y * y);
}

/* q [nodes][4], N and dN [nodes]. */
static inline void exact_point_at(int nodes, real q[][4], const double N[], const double dN[],
                                  const real y[3], exact_point *p)
{
    real Q[4], S[4], h[4];
    for (int i = 0; i < 4; i++) {
        Q[i] = N[0] * q[0][i];
        S[i] = dN[0] * q[0][i];
        for (int k = 1; k < nodes; k++) {
            Q[i] += N[k] * q[k][i];
            S[i] += dN[k] * q[k][i];
        }
    }
    p->m = real_sqrt(Q[0] * Q[0] + Q[1] * Q[1] + Q[2] * Q[2] + Q[3] * Q[3]);
    const real inverse = 1 / p->m;
    for (int i = 0; i < 4; i++)
        p->u[i] = Q[i] * inverse;
    exact_point_relative(p->u, S, h);
    p->eta = h[0] * inverse;
    for (int i = 0; i < 3; i++)
        p->kappa[i] = 2 * (h[i + 1] * inverse);
    exact_point_axes(p->u, p->R);
    mat3_transpose_mul_vec(p->R, y, p->v);
}

/* out (+)= factor b x each column of a [3 x 3] */
static inline void exact_point_add_cross(const real b[3], const real a[9], real factor, real out[9])
{
    for (int j = 0; j < 3; j++) {
        out[j] += factor * (b[1] * a[6 + j] - b[2] * a[3 + j]);
        out[3 + j] += factor * (b[2] * a[j] - b[0] * a[6 + j]);
        out[6 + j] += factor * (b[0] * a[3 + j] - b[1] * a[j]);
    }
}

/* First derivatives for a node with the quaternion q. */
static inline void exact_point_first(const exact_point *p, const real q[4], double N, double dN,
                                     exact_point_turn *t)
{
    real *a = t->a, *turned = t->a + 3;
    exact_point_relative(p->u, q, t->c);
    const real half = 0.5 / p->m, w = half * t->c[0], x = half * t->c[1], y = half * t->c[2],
               z = half * t->c[3];
    for (int j = 0; j < 3; j++) {
        const real X = p->R[3 * j], Y = p->R[3 * j + 1], Z = p->R[3 * j + 2];
        a[j] = -(x * X + y * Y + z * Z);
        a[3 + j] = w * X + z * Y - y * Z;
        a[6 + j] = w * Y + x * Z - z * X;
        a[9 + j] = w * Z + y * X - x * Y;
    }
    const real own = 2 * dN - (2 * N) * p->eta;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            t->kappa[3 * i + j] = own * turned[3 * i + j] - (N * p->kappa[i]) * a[j];
            t->v[3 * i + j] = real_of(0);
        }
    exact_point_add_cross(p->kappa, turned, real_of(N), t->kappa);
    exact_point_add_cross(p->v, turned, real_of(2 * N), t->v);
}

/* Second derivatives of n . kappa + f . v, as exact_point_add_second needs them of all nodes. */
static inline void exact_point_second(const exact_point *p, const real n[3], const real f[3],
                                      exact_point_turn *t)
{
    real across[3], lever[3], Z[9];
    const real *a = t->a, *turned = t->a + 3, *v = p->v;
    const real nk = vec3_dot(n, p->kappa), fv = vec3_dot(f, v), level = -2 * nk - 4 * fv;
    vec3_cross(p->kappa, n, across);
    vec3_cross(v, f, lever);
    for (int j = 0; j < 3; j++) {
        const real fa = vec3_dot(f, (const real[3]){turned[j], turned[3 + j], turned[6 + j]}),
                   va = vec3_dot(v, (const real[3]){turned[j], turned[3 + j], turned[6 + j]});
        t->twice[j] = (2 * nk) * a[j];
        for (int i = 0; i < 3; i++) {
            const real edge = 4 * p->eta * n[i] + 2 * across[i] + 2 * lever[i];
            t->twice[j] += edge * turned[3 * i + j];
            t->twice[3 * (i + 1) + j] =
                edge * a[j] + 2 * (f[i] * va + v[i] * fa) + level * turned[3 * i + j];
        }
    }
    for (int j = 0; j < 3; j++) /* 2 f x the axes of the section */
        for (int i = 0; i < 3; i++)
            Z[3 * i + j] = 2 * (f[(i + 1) % 3] * p->R[3 * j + (i + 2) % 3] -
                                f[(i + 2) % 3] * p->R[3 * j + (i + 1) % 3]);
    real_zero(9, t->by);
    mat3_add_transpose_mul(turned, Z, t->by);
}

/* H += second derivative for nodes k and l [3 x 3]; that with respect to y is N_k t_k->by. */
static inline void exact_point_add_second(const real n[3], const double N[], const double dN[],
                                          int k, int l, const exact_point_turn t[], real H[9])
{
    const real *a = t[l].a, *turned = t[l].a + 3, *left = t[k].a;
    const double symmetric = dN[k] * N[l] + N[k] * dN[l], skew = N[k] * dN[l] - dN[k] * N[l];
    real W[12], spin[9];
    real_zero(9, spin);
    exact_point_add_cross(n, turned, real_of(2 * skew), spin);
    for (int j = 0; j < 3; j++) {
        W[j] = (N[k] * N[l]) * t[l].twice[j] -
               (2 * symmetric) * (n[0] * turned[j] + n[1] * turned[3 + j] + n[2] * turned[6 + j]);
        for (int i = 0; i < 3; i++)
            W[3 * (i + 1) + j] = (N[k] * N[l]) * t[l].twice[3 * (i + 1) + j] -
                                 (2 * symmetric) * (n[i] * a[j]) + spin[3 * i + j];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            H[3 * i + j] += left[i] * W[j] + left[3 + i] * W[3 + j] + left[6 + i] * W[6 + j] +
                            left[9 + i] * W[9 + j];
}

/* Contribution of turning a node to its own second derivative along the diagonal: q'' = -1/4
 * |theta|^2 q. */
static inline real exact_point_curved(const exact_point *p, const real n[3], const real f[3],
                                      double N, double dN, const exact_point_turn *t)
{
    real across[3], lever[3];
    vec3_cross(p->kappa, n, across);
    vec3_cross(p->v, f, lever);
    real sum = -N * vec3_dot(n, p->kappa) * t->c[0];
    for (int i = 0; i < 3; i++)
        sum += (2 * dN * n[i] - N * (2 * p->eta * n[i] + across[i] + 2 * lever[i])) * t->c[i + 1];
    return -0.25 * sum / p->m;
}

#endif
