/* The strains of strain.h with their derivatives.  In lanes (real.h). */
#ifndef BEAMWORK_EXACT_DEFORMED_H
#define BEAMWORK_EXACT_DEFORMED_H

#include <string.h>

#include "elements/geometrically_exact/point.h"
#include "elements/geometrically_exact/strain.h"
#include "elements/math/rotation.h"

enum { EXACT_DEFORMED_PAIRS = ELEMENT_MAX_NODES * (ELEMENT_MAX_NODES + 1) / 2 };

/* Values derived from the nodes' states, once per evaluation. */
typedef struct exact_deformed_nodes {
    real q[ELEMENT_MAX_NODES][4];
    real r[ELEMENT_MAX_NODES][3], u[ELEMENT_MAX_NODES][3]; /* per l0 */
} exact_deformed_nodes;

/* Values of all points. */
typedef struct exact_deformed {
    real e[EXACT_STRAIN_MAX_POINTS][6];
    /* J by its blocks: of v with r, l0 times those of v and of the measured kappa with theta */
    real axes[EXACT_STRAIN_MAX_POINTS][9], v[EXACT_STRAIN_MAX_POINTS][ELEMENT_MAX_NODES][9],
        kappa[EXACT_STRAIN_MAX_POINTS][ELEMENT_MAX_NODES][9];
    /* H by its blocks: of theta with theta, k <= l, and of theta with r */
    real turns[EXACT_DEFORMED_PAIRS][9], moves[ELEMENT_MAX_NODES][ELEMENT_MAX_NODES][9];
} exact_deformed;

/* y = r' and dy = u' at point g. */
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

/* v - v0; the part along x from |v|^2 - |v0|^2 = (2 y0 + dy) . dy, so that a small elongation is no
 * difference of lengths. */
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

/* Second derivatives of f . v + n . measure(kappa) at point g; weights in [N m]. */
static inline void exact_deformed_second(int nodes, const exact_strain_line *line, int g,
                                         const exact_point *p, const real m[3], const real T[9],
                                         const real f[3], const real moment[3],
                                         exact_point_turn t[], exact_deformed *out)
{
    const double *N = line->N[g], *dN = line->dN[g];
    const int measured = line->rotation != EXACT_MEASURE_QUARTER;
    real n[3], inner[9], bent[ELEMENT_MAX_NODES][9];
    for (int i = 0; i < 3; i++)
        n[i] = moment[i];
    if (measured) { /* T^T n takes n's place, and the second derivative of the measure meets dkappa
                       twice */
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

/* s [strains]: stresses, or NULL. */
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
        exact_point_turn t[ELEMENT_MAX_NODES];
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

/* The states of the nodes of one lane. */
static inline void exact_deformed_read(int nodes, const exact_strain_line *line,
                                       const node_state x[], int lane, exact_deformed_nodes *s)
{
    double q[ELEMENT_MAX_NODES][4];
    for (int k = 0; k < nodes; k++) {
        rotation_from_matrix(x[k].R, q[k]);
        double side = 0;
        for (int i = 0; i < 4 && k > 0; i++)
            side += q[k - 1][i] * q[k][i];
        for (int i = 0; i < 4; i++) {
            if (side < 0) /* neighbours are on the same side */
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

/* Evaluates with `nodes` nodes. */
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

/* Evaluates `run` elements of one kind, at most LANES, x [run x nodes]; as
 * element_type.strain_many. */
static inline void exact_deformed_strain(const exact_strain_line *line, int run,
                                         const node_state x[], strain_output out[])
{
    if (line->nodes == 2)
        exact_deformed_run(2, line, run, x, out);
    else
        exact_deformed_run(3, line, run, x, out);
}

#endif
