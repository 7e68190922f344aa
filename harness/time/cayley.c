#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/real.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

void cayley_of_vector(const double t[3], double c[3])
{
    const double x = vec3_norm(t), part = x < 1e-8 ? 1 : 2 * tan(x / 2) / x;
    for (int i = 0; i < 3; i++)
        c[i] = part * t[i];
}

/* Returns 2 atan(x/2)/x. */
static double arc(double x)
{
    const double s = x * x / 4;
    return x < 0.02 ? 1 - s / 3 * (1 - 3 * s / 5 * (1 - 5 * s / 7)) : 2 * atan(x / 2) / x;
}

void cayley_to_vector(const double c[3], double t[3])
{
    const double part = arc(vec3_norm(c));
    for (int i = 0; i < 3; i++)
        t[i] = part * c[i];
}

void cayley_skew(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

void cayley_tangent(const double c[3], double T[9])
{
    const double part = 1 / (1 + vec3_dot(c, c) / 4);
    cayley_skew(c, T);
    for (int i = 0; i < 9; i++)
        T[i] = part * (T[i] / 2 + (i % 4 == 0));
}

static void turn_by(const double t[3], double R[9])
{
    double q[4];
    rotation_exp(t, q);
    rotation_matrix(q, R);
}

static void mean_of(int n, double share, double v[][3], double mean[3])
{
    for (int i = 0; i < 3; i++) {
        mean[i] = 0;
        for (int j = 0; j < n; j++)
            mean[i] += v[j][i] * share;
    }
}

static void common_turn(cayley_step *s)
{
    const double *c = s->mean;
    double half[3], vector[3];
    s->kappa = 1 / sqrt(1 + vec3_dot(c, c) / 4);
    s->b = s->kappa * s->kappa / (4 * (1 + s->kappa));
    for (int i = 0; i < 3; i++) {
        half[i] = s->kappa * c[i] / (1 + s->kappa);
        for (int j = 0; j < 3; j++) {
            s->S[3 * i + j] = (i == j ? s->kappa : 0) + s->b * c[i] * c[j];
            s->T[3 * i + j] = (i == j) - s->b * c[i] * c[j];
        }
    }
    cayley_to_vector(half, vector);
    turn_by(vector, s->G);
}

static void relative_node(cayley_step *s, int j, double da)
{
    double apart[3], lever[3], moved[3], *y = s->y + NODE_COORDINATES * j;
    s->divisor[j] = s->kappa * (1 + vec3_dot(s->mean, s->c[j]) / 4);
    for (int i = 0; i < 3; i++)
        apart[i] = (s->c[j][i] - s->mean[i]) / s->divisor[j];
    mat3_mul_vec(s->T, apart, s->relative[j]);
    s->psi[j] = arc(vec3_norm(s->relative[j]));
    s->z[j] = s->psi[j] / s->divisor[j];
    vec3_cross(s->mean, s->Dm[j], lever);
    for (int i = 0; i < 3; i++)
        moved[i] = s->dD[j][i] - lever[i];
    mat3_mul_vec(s->S, moved, y);
    for (int i = 0; i < 3; i++)
        y[3 + i] = s->psi[j] * s->relative[j][i];
    y[6] = da;
}

void cayley_begin(int nodes, int ground, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *s)
{
    double mean_r[3] = {0, 0, 0}, mean_dr[3];
    s->nodes = nodes;
    s->share = ground ? 0 : 1.0 / nodes;
    s->from = from;
    mean_of(nodes, s->share, dr, mean_dr);
    mean_of(nodes, s->share, c, s->mean);
    for (int j = 0; j < nodes; j++)
        for (int i = 0; i < 3; i++)
            mean_r[i] += from[j].r[i] * s->share;
    for (int j = 0; j < nodes; j++)
        for (int i = 0; i < 3; i++) {
            s->c[j][i] = c[j][i];
            s->Dn[j][i] = from[j].r[i] - mean_r[i];
            s->dD[j][i] = dr[j][i] - mean_dr[i];
            s->D1[j][i] = s->Dn[j][i] + s->dD[j][i];
            s->Dm[j][i] = s->Dn[j][i] + s->dD[j][i] / 2;
        }
    common_turn(s);
    for (int j = 0; j < nodes; j++)
        relative_node(s, j, da[j]);
}

void cayley_between(const cayley_step *s, double at, cayley_point *p)
{
    p->at = at;
    for (int j = 0; j < s->nodes; j++) {
        const double *y = s->y + NODE_COORDINATES * j;
        double first[3], last[3], part[3], turned[9];
        mat3_mul_vec(s->G, s->Dn[j], first);
        mat3_transpose_mul_vec(s->G, s->D1[j], last);
        for (int i = 0; i < 3; i++) {
            p->x[j].r[i] = (1 - at) * first[i] + at * last[i];
            p->x[j].u[i] = p->x[j].r[i] - (s->from[j].r[i] - s->from[j].u[i]);
            part[i] = at * y[3 + i];
        }
        turn_by(part, p->turn[j]);
        mat3_mul(s->G, s->from[j].R, turned);
        mat3_mul(p->turn[j], turned, p->x[j].R);
        p->x[j].a = s->from[j].a + at * y[6];
    }
}

void cayley_forces(const cayley_step *s, int columns, double f[])
{
    REAL_CHOSEN(cayley_turn_forces)(s, columns, f);
}

enum { N = NODE_COORDINATES };

static void add_product(double factor, const double a[3], const double b[3], double A[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] += factor * a[i] * b[j];
}

static void add_identity(double factor, double A[9])
{
    for (int i = 0; i < 3; i++)
        A[4 * i] += factor;
}

/* Adds to A `factor` times the derivative of b c (c.v) with respect to c. */
static void add_square(const cayley_step *s, const cayley_slopes *d, double factor,
                       const double v[3], double A[9])
{
    const double along = vec3_dot(s->mean, v);
    add_product(factor * along, s->mean, d->b, A);
    add_product(factor * s->b, s->mean, v, A);
    add_identity(factor * s->b * along, A);
}

static void spin_of(const cayley_step *s, cayley_slopes *d)
{
    const double k = s->kappa, ratio = k / (1 + k);
    const double part = 1 / (1 + ratio * ratio * vec3_dot(s->mean, s->mean) / 4);
    double g[9];
    cayley_skew(s->mean, g);
    memset(d->spin, 0, sizeof d->spin);
    add_identity(part * ratio, d->spin);
    add_product(part / ((1 + k) * (1 + k)), s->mean, d->kappa, d->spin);
    for (int i = 0; i < 9; i++)
        d->spin[i] += part * ratio * ratio / 2 * g[i];
}

/* Returns the factor f in d psi = f c^ . d c^, where x = |c^| and phi = psi c^ (cayley_step). */
static double arc_change(double x, double psi)
{
    return x < 0.02 ? -1 / 6.0 + x * x / 20 : (1 / (1 + x * x / 4) - psi) / (x * x);
}

static void node_slopes(const cayley_step *s, int j, cayley_slopes *d)
{
    const double *c = s->c[j], *mean = s->mean, *relative = s->relative[j];
    const double divisor = s->divisor[j], inside = 1 + vec3_dot(mean, c) / 4,
                 slope = arc_change(vec3_norm(relative), s->psi[j]);
    double own[9], common[9], to_own[3], to_common[3], apart[3], psi_own[3], psi_common[3], E[9];
    for (int i = 0; i < 3; i++) {
        to_own[i] = s->kappa * mean[i] / 4;
        to_common[i] = d->kappa[i] * inside + s->kappa * c[i] / 4;
        apart[i] = c[i] - mean[i];
    }
    memcpy(own, s->T, sizeof own);
    for (int i = 0; i < 9; i++)
        common[i] = -s->T[i];
    add_product(-1, relative, to_own, own);
    add_product(-1, relative, to_common, common);
    add_square(s, d, -1, apart, common);
    for (int i = 0; i < 9; i++) {
        own[i] /= divisor;
        common[i] /= divisor;
    }
    mat3_transpose_mul_vec(own, relative, psi_own);
    mat3_transpose_mul_vec(common, relative, psi_common);
    for (int i = 0; i < 3; i++) {
        d->z_own[j][i] = (slope * psi_own[i] - s->z[j] * to_own[i]) / divisor;
        d->z_common[j][i] = (slope * psi_common[i] - s->z[j] * to_common[i]) / divisor;
    }
    memset(E, 0, sizeof E);
    add_identity(s->psi[j], E);
    add_product(slope, relative, relative, E);
    mat3_mul(E, own, d->own[j]);
    mat3_mul(E, common, d->common[j]);
}

void cayley_slopes_of(const cayley_step *s, cayley_slopes *d)
{
    const double k = s->kappa;
    for (int i = 0; i < 3; i++) {
        d->kappa[i] = -k * k * k * s->mean[i] / 4;
        d->b[i] = d->kappa[i] * k * (2 + k) / (4 * (1 + k) * (1 + k));
    }
    spin_of(s, d);
    for (int j = 0; j < s->nodes; j++)
        node_slopes(s, j, d);
}

/* Stores A as rows of four numbers, the last of which is zero. */
static void pad_rows(const double A[9], double rows[12])
{
    for (int i = 0; i < 12; i++)
        rows[i] = i % 4 < 3 ? A[3 * (i / 4) + i % 4] : 0;
}

static void columns_of(const cayley_step *s, const cayley_slopes *d, const cayley_point *p, int j,
                       cayley_columns *out)
{
    const double at = p->at, *y = s->y + N * j;
    double back[3], Jl[9], first[3], swept[9], carried[9], apart[9], turned[9], more[9], by_phi[9],
        r_common[9];
    for (int i = 0; i < 3; i++)
        back[i] = -at * y[3 + i];
    rotation_rates_jacobian(back, Jl);
    for (int i = 0; i < 9; i++)
        Jl[i] *= at;
    mat3_mul(Jl, d->own[j], by_phi);
    mat3_mul(Jl, d->common[j], more);
    mat3_mul(p->turn[j], d->spin, turned);
    mat3_mul_vec(s->G, s->Dn[j], first);
    cayley_skew(first, swept);
    cayley_skew(s->D1[j], apart);
    mat3_transpose_mul(s->G, apart, carried);
    for (int i = 0; i < 9; i++) {
        apart[i] = at * carried[i] - (1 - at) * swept[i];
        more[i] += turned[i];
    }
    mat3_mul(apart, d->spin, r_common);
    pad_rows(by_phi, out->by_phi);
    pad_rows(r_common, out->r_common);
    pad_rows(more, out->phi_common);
}

void cayley_slopes_columns(const cayley_step *s, const cayley_slopes *d, const cayley_point *p,
                           double weight, int rows, const double A[], double out[])
{
    cayley_columns of[ELEMENT_MAX_NODES];
    double back[9], padded[12];
    for (int j = 0; j < s->nodes; j++)
        columns_of(s, d, p, j, &of[j]);
    for (int i = 0; i < 9; i++)
        back[i] = s->G[3 * (i % 3) + i / 3];
    pad_rows(back, padded);
    REAL_CHOSEN(cayley_rows)(s->nodes, s->share, p->at, weight, of, padded, rows, A, out);
}

static void add_block(int n, int row, int column, double factor, const double A[9], double K[])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[(row + i) * n + column + j] += factor * A[3 * i + j];
}

/* Force F on a node, derivatives of force and moment with respect to the mean c, and derivative of
 * the moment with respect to c_j (own). */
typedef struct node_forces {
    double F[3], force[9], moment[9], own[9];
} node_forces;

static void forces_of(const cayley_step *s, const cayley_slopes *d, const double f[], int j,
                      node_forces *out)
{
    const double *at = f + N * j;
    double M[3];
    memset(out, 0, sizeof *out);
    mat3_mul_vec(s->S, at, out->F);
    mat3_mul_vec(s->T, at + 3, M);
    add_product(1, at, d->kappa, out->force);
    add_square(s, d, 1, at, out->force);
    add_square(s, d, -s->z[j], at + 3, out->moment);
    add_product(1, M, d->z_common[j], out->moment);
    add_product(1, M, d->z_own[j], out->own);
}

void cayley_slopes_forces(const cayley_step *s, const cayley_slopes *d, const double f[],
                          double K[])
{
    const int n = N * s->nodes;
    node_forces of[ELEMENT_MAX_NODES];
    double common[9] = {0}, sum[3] = {0, 0, 0};
    for (int j = 0; j < s->nodes; j++) {
        double lever[9], more[9];
        forces_of(s, d, f, j, &of[j]);
        cayley_skew(s->Dm[j], lever);
        mat3_mul(lever, of[j].force, more);
        for (int i = 0; i < 9; i++)
            common[i] += s->share * (of[j].moment[i] + more[i]);
        for (int i = 0; i < 3; i++)
            sum[i] += s->share * of[j].F[i];
    }
    for (int j = 0; j < s->nodes; j++)
        for (int i = 0; i < s->nodes; i++) {
            const double half[3] = {(sum[0] - of[i].F[0]) / 2, (sum[1] - of[i].F[1]) / 2,
                                    (sum[2] - of[i].F[2]) / 2};
            const int row = N * j, column = N * i;
            double swept[9];
            cayley_skew(half, swept);
            add_block(n, row, column + 3, s->share, of[j].force, K);
            add_block(n, row + 3, column + 3, s->share, of[j].moment, K);
            add_block(n, row + 3, column + 3, -s->share, common, K);
            add_block(n, row + 3, column + 3, -s->share, of[i].own, K);
            add_block(n, row + 3, column, -s->share, swept, K);
            if (i == j)
                add_block(n, row + 3, column + 3, 1, of[j].own, K);
        }
}
