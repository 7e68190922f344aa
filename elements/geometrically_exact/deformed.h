/* Geometry at one point of a line with rotating sections. The quaternions of the nodes are
 * interpolated like vectors of R^4, Q = sum N_k q_k, and Q is normalised. A common rotation of all
 * q_k rotates Q, so strains in the axes of the section are objective (derived here). No
 * trigonometric function is needed, and every derivative is rational in Q.
 *
 *   kappa = 2 Im(Q^-1 Q'), v = R(Q)^T y.
 *
 * With Q = m u, |u| = 1 and eta = m'/m, let A0 and A be the scalar and the vector part of u^-1
 * dQ/m, and D0 and D those of u^-1 dQ'/m, in the axes of the section. Then
 *
 *   dkappa = 2 D - A0 kappa - 2 eta A - A x kappa,  dv = dy - 2 A x v,
 *   d2kappa = 2 (A0^2 - |A|^2) kappa + 8 eta A0 A + 4 A0 A x kappa - 4 (A0 D + D0 A + A x D),
 *   d2v = 4 A0 A x v + 4 A x (A x v) - 4 A x dy,
 *
 * from the expansion of Q^-1 Q' and of the rotation 2 Im Q/Re Q.
 *
 * A rotation of node k by the spatial increment theta changes q_k to exp(theta/2) q_k. The first
 * derivative is 1/2 theta q_k, the second -1/4 |theta|^2 q_k. Therefore (A0, A) = N_k a_k theta and
 * (D0, D) = N'_k a_k theta with a matrix a_k [4 x 3]. */
#ifndef BEAMWORK_GEOMETRICALLY_EXACT_DEFORMED_H
#define BEAMWORK_GEOMETRICALLY_EXACT_DEFORMED_H

#include <string.h>

#include "elements/geometrically_exact/exact.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

typedef struct exact_point {
    real m, u[4];  /* Q = m u, |u| = 1 */
    real eta;      /* m'/m */
    real R[9];     /* axes of the section, columns */
    real kappa[3]; /* twist rate and curvatures in the axes of the section */
    real v[3];     /* vector y in the axes of the section */
} exact_point;

typedef struct exact_point_turn {
    real c[4];             /* u^-1 q */
    real a[12];            /* matrix a [4 x 3] */
    real kappa[9], v[9];   /* derivatives of kappa and v with respect to theta, stored by rows */
    real twice[12], by[9]; /* factors of the products in exact_point_add_second */
} exact_point_turn;

/* Computes ab = a^-1 o b. */
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

/* Computes the values at the point from the quaternions q [nodes][4] and the interpolation
 * functions N and dN [nodes]. */
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

/* Adds factor b x a to `out` for each column a of a [3 x 3]. */
static inline void exact_point_add_cross(const real b[3], const real a[9], real factor, real out[9])
{
    for (int j = 0; j < 3; j++) {
        out[j] += factor * (b[1] * a[6 + j] - b[2] * a[3 + j]);
        out[3 + j] += factor * (b[2] * a[j] - b[0] * a[6 + j]);
        out[6 + j] += factor * (b[0] * a[3 + j] - b[1] * a[j]);
    }
}

/* Computes the first derivatives with respect to the rotation of a node. */
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

/* Computes the factors, for one node, of the second derivatives of n . kappa + f . v in
 * exact_point_add_second. */
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

/* Adds the second derivative with respect to the rotations of nodes k and l [3 x 3] to H. The mixed
 * derivative with respect to y and the rotation of node k is N_k t_k->by. */
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

/* Returns the contribution of q'' = -1/4 |theta|^2 q to the diagonal of the second derivative with
 * respect to the rotation of a node. */
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

/* The strains of exact.h with their derivatives, in lanes (real.h). */

enum { EXACT_DEFORMED_PAIRS = EXACT_MAX_NODES * (EXACT_MAX_NODES + 1) / 2 };

typedef struct exact_deformed_nodes {
    real q[EXACT_MAX_NODES][4];
    real r[EXACT_MAX_NODES][3], u[EXACT_MAX_NODES][3]; /* divided by l0 */
} exact_deformed_nodes;

/* Values of all points. */
typedef struct exact_deformed {
    real e[EXACT_STRAIN_MAX_POINTS][6];
    /* blocks of J: derivatives of v with respect to r, and l0 times the derivatives of v and of the
     * measured kappa with respect to theta */
    real axes[EXACT_STRAIN_MAX_POINTS][9], v[EXACT_STRAIN_MAX_POINTS][EXACT_MAX_NODES][9],
        kappa[EXACT_STRAIN_MAX_POINTS][EXACT_MAX_NODES][9];
    /* blocks of H: for theta of nodes k <= l, and for theta and r */
    real turns[EXACT_DEFORMED_PAIRS][9], moves[EXACT_MAX_NODES][EXACT_MAX_NODES][9];
} exact_deformed;

static inline void exact_deformed_observe(int nodes, const exact_strain_line *line,
                                          exact_deformed_nodes *s, int g, exact_point *p, real y[3],
                                          real dy[3])
{
    for (int i = 0; i < 3; i++) {
        y[i] = dy[i] = real_of(0);
        for (int k = 0; k < nodes; k++) {
            y[i] += line->dN[g][k] * s->r[k][i];
            dy[i] += line->dN[g][k] * s->u[k][i];
        }
    }
    exact_point_at(nodes, s->q, line->N[g], line->dN[g], y, p);
}

/* Computes v - v0. If v_x + v0_x > 1, the x component is computed from |v|^2 - |v0|^2 = (2 y0 + dy)
 * . dy, which avoids cancellation for small elongations. */
static inline void exact_deformed_stretch(const real v[3], const double v0[3], const real y[3],
                                          const real dy[3], real e[3])
{
    e[1] = v[1] - v0[1];
    e[2] = v[2] - v0[2];
    const real squares =
        2 * vec3_dot(y, dy) - vec3_dot(dy, dy) - e[1] * (v[1] + v0[1]) - e[2] * (v[2] + v0[2]);
    const real sum = v[0] + v0[0], longer = squares / sum, difference = v[0] - v0[0];
    for (int lane = 0; lane < LANES; lane++)
        real_put(&e[0], lane,
                 real_lane(&sum, lane) > 1 ? real_lane(&longer, lane)
                                           : real_lane(&difference, lane));
}

/* Computes the second derivatives of f . v + n . measure(kappa) at point g. The weights f and n are
 * in [N m]. */
static inline void exact_deformed_second(int nodes, const exact_strain_line *line, int g,
                                         const exact_point *p, const real m[3], const real T[9],
                                         const real f[3], const real moment[3],
                                         exact_point_turn t[], exact_deformed *out)
{
    const double *N = line->N[g], *dN = line->dN[g];
    const int measured = line->rotation != EXACT_MEASURE_QUARTER;
    real n[3], inner[9], bent[EXACT_MAX_NODES][9];
    for (int i = 0; i < 3; i++)
        n[i] = moment[i];
    if (measured) { /* T^T n replaces n, and the second derivative of the measure is multiplied by
                       dkappa on both sides */
        exact_measure_second(m, p->kappa, moment, inner);
        mat3_transpose_mul_vec(T, moment, n);
        for (int k = 0; k < nodes; k++)
            mat3_mul(inner, t[k].kappa, bent[k]);
    }
    for (int k = 0; k < nodes; k++)
        exact_point_second(p, n, f, &t[k]);
    for (int l = 0; l < nodes; l++)
        for (int k = 0; k <= l; k++) {
            real *H = out->turns[l * (l + 1) / 2 + k];
            exact_point_add_second(n, N, dN, k, l, t, H);
            if (measured)
                mat3_add_transpose_mul(t[k].kappa, bent[l], H);
        }
    for (int k = 0; k < nodes; k++) {
        const real curved = exact_point_curved(p, n, f, N[k], dN[k], &t[k]);
        for (int i = 0; i < 3; i++)
            out->turns[k * (k + 1) / 2 + k][4 * i] += curved;
        for (int l = 0; l < nodes; l++) {
            const double weight = N[k] * dN[l] / line->l0;
            for (int i = 0; i < 9; i++)
                out->moves[k][l][i] += weight * t[k].by[i];
        }
    }
}

static inline __attribute__((always_inline)) void
exact_deformed_evaluate(int nodes, const exact_strain_line *line, exact_deformed_nodes *state,
                        int first, const real s[], exact_deformed *out)
{
    const double l0 = line->l0;
    const int measured = line->rotation != EXACT_MEASURE_QUARTER;
    if (s != NULL) {
        for (int k = 0; k < nodes * (nodes + 1) / 2; k++)
            real_zero(9, out->turns[k]);
        for (int k = 0; k < nodes; k++)
            for (int l = 0; l < nodes; l++)
                real_zero(9, out->moves[k][l]);
    }
    for (int g = 0; g < nodes - 1; g++) {
        exact_point p;
        exact_point_turn t[EXACT_MAX_NODES];
        real y[3], dy[3], psi[3], m[3], T[9];
        exact_deformed_observe(nodes, line, state, g, &p, y, dy);
        exact_deformed_stretch(p.v, line->rest[g], y, dy, out->e[g]);
        real_zero(3, m);
        real_zero(9, T);
        for (int i = 0; i < 3; i++)
            psi[i] = p.kappa[i];
        if (measured) {
            exact_measure_ratio(line->rotation, p.kappa, m);
            exact_measure_of(m, p.kappa, psi, T);
        }
        for (int i = 0; i < 3; i++) {
            out->e[g][i] = l0 * (out->e[g][i] - line->initial[g][i]);
            out->e[g][3 + i] = l0 * (psi[i] - line->rest[g][3 + i]);
        }
        if (!first)
            continue;
        for (int i = 0; i < 9; i++)
            out->axes[g][i] = p.R[i];
        for (int k = 0; k < nodes; k++) {
            exact_point_first(&p, state->q[k], line->N[g][k], line->dN[g][k], &t[k]);
            if (measured)
                mat3_mul(T, t[k].kappa, out->kappa[g][k]);
            for (int i = 0; i < 9; i++) {
                out->v[g][k][i] = l0 * t[k].v[i];
                out->kappa[g][k][i] = l0 * (measured ? out->kappa[g][k][i] : t[k].kappa[i]);
            }
        }
        if (s != NULL) {
            real f[3], moment[3];
            for (int i = 0; i < 3; i++) {
                f[i] = l0 * s[6 * g + i];
                moment[i] = l0 * s[6 * g + 3 + i];
            }
            exact_deformed_second(nodes, line, g, &p, m, T, f, moment, t, out);
        }
    }
}

static inline void exact_deformed_read(int nodes, const exact_strain_line *line,
                                       const node_state x[], int lane, exact_deformed_nodes *s)
{
    double q[EXACT_MAX_NODES][4];
    for (int k = 0; k < nodes; k++) {
        rotation_from_matrix(x[k].R, q[k]);
        double side = 0;
        for (int i = 0; i < 4 && k > 0; i++)
            side += q[k - 1][i] * q[k][i];
        for (int i = 0; i < 4; i++) {
            if (side < 0) /* the quaternions of all nodes have the same sign */
                q[k][i] = -q[k][i];
            real_put(&s->q[k][i], lane, q[k][i]);
        }
        for (int i = 0; i < 3; i++) {
            real_put(&s->r[k][i], lane, (x[k].r[i] - x[0].r[i]) / line->l0);
            real_put(&s->u[k][i], lane, (x[k].u[i] - x[0].u[i]) / line->l0);
        }
    }
}

static inline void exact_deformed_write_rows(int nodes, const exact_strain_line *line,
                                             exact_deformed *d, int lane, double J[])
{
    const int n = NODE_COORDINATES * nodes, first_a = 6 * (nodes - 1);
    for (int g = 0; g < nodes - 1; g++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < nodes; k++) {
                double *row = &J[(6 * g + i) * n + NODE_COORDINATES * k], *turned = row + 3 * n;
                for (int j = 0; j < 3; j++) {
                    row[j] = line->dN[g][k] * real_lane(&d->axes[g][3 * j + i], lane);
                    row[3 + j] = real_lane(&d->v[g][k][3 * i + j], lane);
                    turned[j] = 0;
                    turned[3 + j] = real_lane(&d->kappa[g][k][3 * i + j], lane);
                }
                row[6] = turned[6] = 0;
            }
    memset(&J[first_a * n], 0, (size_t)(nodes * n) * sizeof *J);
    for (int k = 0; k < nodes; k++)
        J[(first_a + k) * n + NODE_COORDINATES * k + 6] = line->l0 * line->l0;
}

static inline void exact_deformed_write_second(int nodes, exact_deformed *d, int lane, double H[])
{
    const int n = NODE_COORDINATES * nodes;
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    for (int k = 0; k < nodes; k++)
        for (int l = 0; l < nodes; l++) {
            const int down = k > l, at = down ? k * (k + 1) / 2 + l : l * (l + 1) / 2 + k;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    const int row = NODE_COORDINATES * k + 3 + i, move = NODE_COORDINATES * l + j;
                    H[row * n + move + 3] = real_lane(
                        &d->turns[at][down || (k == l && i > j) ? 3 * j + i : 3 * i + j], lane);
                    H[row * n + move] = H[move * n + row] =
                        real_lane(&d->moves[k][l][3 * i + j], lane);
                }
        }
}

static inline __attribute__((always_inline)) void exact_deformed_run(int nodes,
                                                                     const exact_strain_line *line,
                                                                     int run, const node_state x[],
                                                                     strain_output out[])
{
    const int strains = 6 * (nodes - 1), second = out[0].H != NULL;
    exact_deformed_nodes state;
    exact_deformed d;
    real s[6 * EXACT_STRAIN_MAX_POINTS];
    for (int lane = 0; lane < LANES; lane++) {
        const int of = lane < run ? lane : run - 1;
        exact_deformed_read(nodes, line, x + of * nodes, lane, &state);
        for (int i = 0; i < strains && second; i++)
            real_put(&s[i], lane, out[of].s[i]);
    }
    exact_deformed_evaluate(nodes, line, &state, out[0].J != NULL || second, second ? s : NULL, &d);
    for (int lane = 0; lane < run; lane++) {
        if (out[lane].e != NULL) {
            for (int i = 0; i < strains; i++)
                out[lane].e[i] = real_lane(&d.e[i / 6][i % 6], lane);
            for (int k = 0; k < nodes; k++)
                out[lane].e[strains + k] = line->l0 * line->l0 * x[lane * nodes + k].a;
        }
        if (out[lane].J != NULL)
            exact_deformed_write_rows(nodes, line, &d, lane, out[lane].J);
        if (second)
            exact_deformed_write_second(nodes, &d, lane, out[lane].H);
    }
}

/* Computes the outputs of element_type.strain_many for `run` elements of one kind, at most LANES,
 * with states x [run x nodes]. */
static inline void exact_deformed_strain(const exact_strain_line *line, int run,
                                         const node_state x[], strain_output out[])
{
    if (line->nodes == 2)
        exact_deformed_run(2, line, run, x, out);
    else
        exact_deformed_run(3, line, run, x, out);
}

#endif
