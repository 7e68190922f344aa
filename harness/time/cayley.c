#include "harness/time/cayley.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

void cayley_of_vector(const double t[3], double c[3])
{
    const double x = vec3_norm(t), part = x < 1e-8 ? 1 : 2 * tan(x / 2) / x;
    for (int i = 0; i < 3; i++)
        c[i] = part * t[i];
}

/* 2 atan(x/2)/x */
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

/* Rotation matrix of a rotation vector. */
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

/* rows[3 x columns] <- A rows, times a factor */
static void turn_rows(const double A[9], double factor, int columns, double rows[])
{
    for (int k = 0; k < columns; k++) {
        const double at[3] = {rows[k], rows[columns + k], rows[2 * columns + k]};
        for (int i = 0; i < 3; i++)
            rows[i * columns + k] =
                factor * (A[3 * i] * at[0] + A[3 * i + 1] * at[1] + A[3 * i + 2] * at[2]);
    }
}

void cayley_forces(const cayley_step *s, int columns, double f[])
{
    double common[3 * ELEMENT_MAX_COORDINATES] = {0};
    const int n = columns;
    for (int j = 0; j < s->nodes; j++) {
        double *F = f + (size_t)(NODE_COORDINATES * j) * (size_t)n, *M = F + 3 * n;
        const double *D = s->Dm[j];
        turn_rows(s->S, 1, n, F);
        turn_rows(s->T, s->z[j], n, M);
        for (int k = 0; k < n; k++) {
            common[k] += M[k] + D[1] * F[2 * n + k] - D[2] * F[n + k];
            common[n + k] += M[n + k] + D[2] * F[k] - D[0] * F[2 * n + k];
            common[2 * n + k] += M[2 * n + k] + D[0] * F[n + k] - D[1] * F[k];
        }
    }
    for (int j = 0; j < s->nodes; j++)
        for (int k = 0; k < 3 * n; k++)
            f[(size_t)(NODE_COORDINATES * j + 3) * (size_t)n + (size_t)k] -= s->share * common[k];
}
