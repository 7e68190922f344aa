#include "harness/conserving/cayley.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/inertia/turning.h"

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

static void skew(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

void cayley_tangent(const double c[3], double T[9])
{
    const double part = 1 / (1 + vec3_dot(c, c) / 4);
    skew(c, T);
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

static void mean_of(int n, double v[][3], double mean[3])
{
    for (int i = 0; i < 3; i++) {
        mean[i] = 0;
        for (int j = 0; j < n; j++)
            mean[i] += v[j][i] / n;
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

void cayley_begin(int nodes, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *s)
{
    double mean_r[3] = {0, 0, 0}, mean_dr[3];
    memset(s, 0, sizeof *s);
    s->nodes = nodes;
    s->from = from;
    mean_of(nodes, dr, mean_dr);
    mean_of(nodes, c, s->mean);
    for (int j = 0; j < nodes; j++)
        for (int i = 0; i < 3; i++)
            mean_r[i] += from[j].r[i] / nodes;
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

void cayley_between(const cayley_step *s, double at, node_state x[])
{
    for (int j = 0; j < s->nodes; j++) {
        const double *y = s->y + NODE_COORDINATES * j;
        double first[3], last[3], part[3], turn[9], turned[9];
        mat3_mul_vec(s->G, s->Dn[j], first);
        mat3_transpose_mul_vec(s->G, s->D1[j], last);
        for (int i = 0; i < 3; i++) {
            x[j].r[i] = (1 - at) * first[i] + at * last[i];
            x[j].u[i] = x[j].r[i] - (s->from[j].r[i] - s->from[j].u[i]);
            part[i] = at * y[3 + i];
        }
        turn_by(part, turn);
        mat3_mul(s->G, s->from[j].R, turned);
        mat3_mul(turn, turned, x[j].R);
        x[j].a = s->from[j].a + at * y[6];
    }
}

void cayley_forces(const cayley_step *s, const double f[], double F[])
{
    double common[3] = {0, 0, 0};
    for (int j = 0; j < s->nodes; j++) {
        const double *of = f + NODE_COORDINATES * j;
        double *to = F + NODE_COORDINATES * j, lever[3];
        mat3_mul_vec(s->S, of, to);
        mat3_mul_vec(s->T, of + 3, to + 3);
        vec3_cross(s->Dm[j], to, lever);
        for (int i = 0; i < 3; i++) {
            to[3 + i] *= s->z[j];
            common[i] += (to[3 + i] + lever[i]) / s->nodes;
        }
        to[6] = of[6];
    }
    for (int j = 0; j < s->nodes; j++)
        for (int i = 0; i < 3; i++)
            F[NODE_COORDINATES * j + 3 + i] -= common[i];
}

/* Of the common turn by dc of its mean. */
static void change_common(const cayley_step *s, const double dc[3], cayley_change *out)
{
    const double *c = s->mean, k = s->kappa;
    const double dk = -k * k * k * vec3_dot(c, dc) / 4,
                 db = dk * k * (2 + k) / (4 * (1 + k) * (1 + k));
    double g[3], dg[3], crossed[3];
    out->kappa = dk;
    for (int i = 0; i < 3; i++) {
        g[i] = k / (1 + k) * c[i];
        dg[i] = dk / ((1 + k) * (1 + k)) * c[i] + k / (1 + k) * dc[i];
        for (int j = 0; j < 3; j++) {
            const double square = db * c[i] * c[j] + s->b * (dc[i] * c[j] + c[i] * dc[j]);
            out->S[3 * i + j] = (i == j ? dk : 0) + square;
            out->T[3 * i + j] = -square;
        }
    }
    vec3_cross(g, dg, crossed);
    const double part = 1 / (1 + vec3_dot(g, g) / 4);
    for (int i = 0; i < 3; i++)
        out->spin[i] = part * (dg[i] + crossed[i] / 2);
}

/* d psi by (c^ . d c^) */
static double arc_change(double x, double psi)
{
    return x < 0.02 ? -1 / 6.0 + x * x / 20 : (1 / (1 + x * x / 4) - psi) / (x * x);
}

static void change_node(const cayley_step *s, int j, const double dmean[3], const double dc[3],
                        cayley_change *out)
{
    double apart[3], change[3], first[3], then[3], relative[3];
    const double inside = 1 + vec3_dot(s->mean, s->c[j]) / 4,
                 divisor = out->kappa * inside +
                           s->kappa * (vec3_dot(dmean, s->c[j]) + vec3_dot(s->mean, dc)) / 4;
    for (int i = 0; i < 3; i++) {
        apart[i] = s->c[j][i] - s->mean[i];
        change[i] = dc[i] - dmean[i];
    }
    mat3_mul_vec(out->T, apart, first);
    mat3_mul_vec(s->T, change, then);
    for (int i = 0; i < 3; i++)
        relative[i] = (first[i] + then[i] - s->relative[j][i] * divisor) / s->divisor[j];
    const double psi =
        arc_change(vec3_norm(s->relative[j]), s->psi[j]) * vec3_dot(s->relative[j], relative);
    for (int i = 0; i < 3; i++)
        out->phi[j][i] = psi * s->relative[j][i] + s->psi[j] * relative[i];
    out->z[j] = (psi - s->z[j] * divisor) / s->divisor[j];
}

void cayley_change_by(const cayley_step *s, int coordinate, cayley_change *out)
{
    const int node = coordinate / NODE_COORDINATES, component = coordinate % NODE_COORDINATES;
    double dmean[3] = {0, 0, 0};
    memset(out, 0, sizeof *out);
    if (component == 6) {
        out->a[node] = 1;
        return;
    }
    if (component < 3) {
        for (int j = 0; j < s->nodes; j++)
            out->D1[j][component] = (j == node) - 1.0 / s->nodes;
        return;
    }
    dmean[component - 3] = 1.0 / s->nodes;
    change_common(s, dmean, out);
    for (int j = 0; j < s->nodes; j++) {
        double dc[3] = {0, 0, 0};
        dc[component - 3] = j == node;
        change_node(s, j, dmean, dc, out);
    }
}

void cayley_change_between(const cayley_step *s, const cayley_change *by, double at, double y[])
{
    for (int j = 0; j < s->nodes; j++) {
        double *to = y + NODE_COORDINATES * j, turned[3], first[3], carried[3], moved[3], last[3];
        double part[3], back[3], Jl[9], R[9], own[3], common[3];
        mat3_mul_vec(s->G, s->Dn[j], turned);
        vec3_cross(by->spin, turned, first);
        vec3_cross(by->spin, s->D1[j], carried);
        for (int i = 0; i < 3; i++) {
            moved[i] = by->D1[j][i] - carried[i];
            part[i] = at * s->y[NODE_COORDINATES * j + 3 + i];
            back[i] = -part[i];
        }
        mat3_transpose_mul_vec(s->G, moved, last);
        turning_jacobian(back, Jl); /* of increments behind the turn: spatial ones */
        turn_by(part, R);
        mat3_mul_vec(Jl, by->phi[j], own);
        mat3_mul_vec(R, by->spin, common);
        for (int i = 0; i < 3; i++) {
            to[i] = (1 - at) * first[i] + at * last[i];
            to[3 + i] = at * own[i] + common[i];
        }
        to[6] = at * by->a[j];
    }
}

void cayley_change_forces(const cayley_step *s, const cayley_change *by, const double f[],
                          const double df[], double dF[])
{
    double common[3] = {0, 0, 0};
    for (int j = 0; j < s->nodes; j++) {
        const double *of = f + NODE_COORDINATES * j, *change = df + NODE_COORDINATES * j;
        double *to = dF + NODE_COORDINATES * j, S_f[3], dS_f[3], S_df[3], T_m[3], dT_m[3], T_dm[3],
               half[3], lever[3], dlever[3];
        mat3_mul_vec(s->S, of, S_f);
        mat3_mul_vec(by->S, of, dS_f);
        mat3_mul_vec(s->S, change, S_df);
        mat3_mul_vec(s->T, of + 3, T_m);
        mat3_mul_vec(by->T, of + 3, dT_m);
        mat3_mul_vec(s->T, change + 3, T_dm);
        for (int i = 0; i < 3; i++) {
            to[i] = dS_f[i] + S_df[i];
            to[3 + i] = by->z[j] * T_m[i] + s->z[j] * (dT_m[i] + T_dm[i]);
            half[i] = by->D1[j][i] / 2;
        }
        vec3_cross(half, S_f, lever);
        vec3_cross(s->Dm[j], to, dlever);
        for (int i = 0; i < 3; i++)
            common[i] += (to[3 + i] + lever[i] + dlever[i]) / s->nodes;
        to[6] = change[6];
    }
    for (int j = 0; j < s->nodes; j++)
        for (int i = 0; i < 3; i++)
            dF[NODE_COORDINATES * j + 3 + i] -= common[i];
}
