#include "elements/exact/strain.h"

#include <math.h>
#include <string.h>

#include "elements/exact/line.h"
#include "elements/exact/measure.h"
#include "elements/exact/point.h"
#include "elements/math/arc.h"
#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/math/rotation.h"

/* What the nodes' states say, once per evaluation. */
typedef struct nodes {
    double q[ELEMENT_MAX_NODES][4];
    double r[ELEMENT_MAX_NODES][3], u[ELEMENT_MAX_NODES][3]; /* per l0 */
} nodes;

static void observe(const exact_strain_line *line, const nodes *s, int g, exact_point *p,
                    double y[3], double dy[3])
{
    for (int i = 0; i < 3; i++) {
        y[i] = dy[i] = 0;
        for (int k = 0; k < line->nodes; k++) {
            y[i] += line->dN[g][k] * s->r[k][i];
            dy[i] += line->dN[g][k] * s->u[k][i];
        }
    }
    exact_point_at(line->nodes, s->q[0], line->N[g], line->dN[g], y, p);
}

/* v - v0; the part along x from |v|^2 - |v0|^2 = (2 y0 + dy) . dy, so that a small elongation is no
 * difference of lengths. */
static void stretch(const double v[3], const double v0[3], const double y[3], const double dy[3],
                    double e[3])
{
    e[1] = v[1] - v0[1];
    e[2] = v[2] - v0[2];
    const double squares =
        2 * vec3_dot(y, dy) - vec3_dot(dy, dy) - e[1] * (v[1] + v0[1]) - e[2] * (v[2] + v0[2]);
    e[0] = v[0] + v0[0] > 1 ? squares / (v[0] + v0[0]) : v[0] - v0[0];
}

static void strains_at(const exact_strain_line *line, int g, const exact_point *p,
                       const double y[3], const double dy[3], double e[6])
{
    double psi[3], T[9];
    stretch(p->v, line->rest[g], y, dy, e);
    exact_measure_of(line->rotation, p->kappa, psi, T);
    for (int i = 0; i < 3; i++) {
        e[i] = line->l0 * (e[i] - line->initial[g][i]);
        e[3 + i] = line->l0 * (psi[i] - line->rest[g][3 + i]);
    }
}

/* Six rows of J, those of point g. */
static void first(const exact_strain_line *line, const nodes *s, int g, const exact_point *p,
                  double J[])
{
    const double none[3] = {0}, l0 = line->l0;
    const int n = NODE_COORDINATES * line->nodes;
    double T[9], psi[3];
    exact_measure_of(line->rotation, p->kappa, psi, T);
    for (int row = 0; row < 6; row++) {
        double Q[4], S[4], unit[3] = {0}, inverse[4], weight[4], gradient[4];
        if (row < 3)
            unit[row] = 1;
        exact_point_gradient(p, row < 3 ? none : &T[3 * (row - 3)], unit, Q, S);
        for (int k = 0; k < line->nodes; k++) {
            double *out = &J[row * n + NODE_COORDINATES * k];
            for (int i = 0; i < 4; i++)
                weight[i] = line->N[g][k] * Q[i] + line->dN[g][k] * S[i];
            rotation_conjugate(s->q[k], inverse);
            rotation_compose(weight, inverse, gradient); /* w . (theta q) = theta . Im(w q^-1) */
            for (int i = 0; i < 3; i++) {
                out[i] =
                    row < 3 ? line->dN[g][k] * p->R[3 * i + row] : 0; /* r per l0, e times l0 */
                out[3 + i] = l0 / 2 * gradient[i + 1];
            }
            out[6] = 0;
        }
    }
}

/* H += second derivatives of f . v + n . kappa between nodes k and l; both weights in [N m]. */
static void second_of_pair(const exact_strain_line *line, const nodes *s, int g, int k, int l,
                           const double QQ[16], const double QS[16], const double QY[12],
                           double H[])
{
    const int n = NODE_COORDINATES * line->nodes;
    const double Nk = line->N[g][k], Nl = line->N[g][l], dk = line->dN[g][k], dl = line->dN[g][l];
    double X[16], Pk[12], Pl[12], XP[12], block[9] = {0}, mixed[9] = {0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            X[4 * i + j] =
                (Nk * Nl * QQ[4 * i + j] + Nk * dl * QS[4 * i + j] + dk * Nl * QS[4 * j + i]) / 4;
    exact_point_increment(s->q[k], Pk);
    exact_point_increment(s->q[l], Pl);
    dense_mul(4, 4, 3, X, Pl, XP);
    dense_add_transpose_mul(3, 4, 3, Pk, XP, block);
    dense_add_transpose_mul(3, 4, 3, Pk, QY, mixed);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double coupling = Nk * dl / (2 * line->l0) * mixed[3 * i + j];
            H[(NODE_COORDINATES * k + 3 + i) * n + NODE_COORDINATES * l + 3 + j] +=
                block[3 * i + j];
            H[(NODE_COORDINATES * k + 3 + i) * n + NODE_COORDINATES * l + j] += coupling;
            H[(NODE_COORDINATES * l + j) * n + NODE_COORDINATES * k + 3 + i] += coupling;
        }
}

static void second(const exact_strain_line *line, const nodes *s, int g, const exact_point *p,
                   const double weight[6], const double J[], double H[])
{
    const int n = NODE_COORDINATES * line->nodes;
    double moment[3], stretching[3], Q[4], S[4], QQ[16], QS[16], QY[12];
    for (int i = 0; i < 3; i++) {
        stretching[i] = line->l0 * weight[i];
        moment[i] = line->l0 * weight[3 + i];
    }
    if (line->rotation != EXACT_MEASURE_QUARTER) {
        /* n . psi(x): T^T n takes n's place, and the second derivative of psi meets dx = T^-1 J
         * twice. */
        double psi[3], T[9], inner[9], inverse[9], bent[9],
            dx[3 * NODE_COORDINATES * ELEMENT_MAX_NODES], weighted[3];
        int pivot[3];
        exact_measure_of(line->rotation, p->kappa, psi, T);
        exact_measure_second(line->rotation, p->kappa, moment, inner);
        memcpy(inverse, T, sizeof inverse);
        memcpy(dx, &J[3 * n], 3 * (size_t)n * sizeof *dx);
        dense_lu(3, inverse, pivot); /* every measure grows with the angle: never singular */
        dense_lu_solve(3, n, inverse, pivot, dx);
        for (int i = 0; i < 9; i++)
            bent[i] = inner[i] / (line->l0 * line->l0);
        double work[3 * NODE_COORDINATES * ELEMENT_MAX_NODES];
        dense_add_congruence(3, n, dx, bent, H, work);
        mat3_transpose_mul_vec(T, moment, weighted);
        memcpy(moment, weighted, sizeof moment);
    }
    exact_point_gradient(p, moment, stretching, Q, S);
    exact_point_hessian(p, moment, stretching, QQ, QS, QY);
    for (int k = 0; k < line->nodes; k++) {
        double curved = 0;
        for (int i = 0; i < 4; i++)
            curved += (line->N[g][k] * Q[i] + line->dN[g][k] * S[i]) * s->q[k][i];
        for (int i = 0; i < 3; i++) /* q'' = -1/4 |theta|^2 q */
            H[(NODE_COORDINATES * k + 3 + i) * (n + 1)] -= curved / 4;
        for (int l = 0; l < line->nodes; l++)
            second_of_pair(line, s, g, k, l, QQ, QS, QY, H);
    }
}

void exact_strain_of(const exact_strain_line *line, const node_state x[], strain_output *out)
{
    const int n = NODE_COORDINATES * line->nodes, first_a = 6 * line->points;
    nodes s;
    for (int k = 0; k < line->nodes; k++) {
        rotation_from_matrix(x[k].R, s.q[k]);
        for (int i = 0; i < 3; i++) {
            s.r[k][i] = (x[k].r[i] - x[0].r[i]) / line->l0;
            s.u[k][i] = (x[k].u[i] - x[0].u[i]) / line->l0;
        }
    }
    exact_point_align(line->nodes, s.q);
    if (out->H != NULL)
        memset(out->H, 0, (size_t)(n * n) * sizeof *out->H);
    for (int g = 0; g < line->points; g++) {
        exact_point p;
        double y[3], dy[3], e[6], rows[6 * NODE_COORDINATES * ELEMENT_MAX_NODES];
        observe(line, &s, g, &p, y, dy);
        strains_at(line, g, &p, y, dy, e);
        if (out->e != NULL)
            memcpy(&out->e[6 * g], e, sizeof e);
        if (out->J == NULL && out->H == NULL)
            continue;
        first(line, &s, g, &p, rows);
        if (out->J != NULL)
            memcpy(&out->J[6 * g * n], rows, 6 * (size_t)n * sizeof *rows);
        if (out->H != NULL)
            second(line, &s, g, &p, &out->s[6 * g], rows, out->H);
    }
    for (int k = 0; k < line->nodes; k++) {
        if (out->e != NULL)
            out->e[first_a + k] = line->l0 * line->l0 * x[k].a;
        if (out->J != NULL) {
            memset(&out->J[(first_a + k) * n], 0, (size_t)n * sizeof *out->J);
            out->J[(first_a + k) * n + NODE_COORDINATES * k + 6] = line->l0 * line->l0;
        }
    }
}

/* R^T r' and measures of rotation at the points, of nodes along the arc without stress. */
static void observe_rest(exact_strain_line *line, const double rotation_vector[3],
                         const double e[3], const double at[],
                         double rest[EXACT_STRAIN_MAX_POINTS][6])
{
    nodes s;
    memset(s.u, 0, sizeof s.u);
    for (int k = 0; k < line->nodes; k++)
        arc_at(rotation_vector, e, at[k], s.r[k], s.q[k]);
    for (int g = 0; g < line->points; g++) {
        exact_point p;
        double y[3], dy[3], T[9];
        observe(line, &s, g, &p, y, dy);
        memcpy(rest[g], p.v, sizeof p.v);
        exact_measure_of(line->rotation, p.kappa, &rest[g][3], T);
    }
}

void exact_strain_prepare(int nodes_count, int points, double l0, const double curvature[3],
                          const double strain[3], exact_measure_kind rotation,
                          exact_strain_line *line)
{
    const double rotation_vector[3] = {curvature[0] * l0, curvature[1] * l0, curvature[2] * l0},
                 along[3] = {1, 0, 0};
    const double strained[3] = {1 + strain[0], strain[1], strain[2]};
    double x[EXACT_STRAIN_MAX_POINTS], w[EXACT_STRAIN_MAX_POINTS],
        at[ELEMENT_MAX_NODES] = {0}, without[EXACT_STRAIN_MAX_POINTS][6];
    memset(line, 0, sizeof *line);
    line->nodes = nodes_count;
    line->points = points;
    line->l0 = l0;
    line->rotation = rotation;
    quadrature_points(points, x, w);
    for (int k = 0; k < nodes_count; k++)
        at[k] = (double)k / (nodes_count - 1);
    for (int g = 0; g < points; g++)
        exact_line_lagrange(nodes_count, at, x[g], line->N[g], line->dN[g]);
    observe_rest(line, rotation_vector, along, at, line->rest);
    observe_rest(line, rotation_vector, strained, at, without);
    for (int g = 0; g < points; g++)
        for (int i = 0; i < 3; i++)
            line->initial[g][i] = without[g][i] - line->rest[g][i];
}
