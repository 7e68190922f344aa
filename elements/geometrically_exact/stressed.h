/* Stresses derived from the energy of exact.h, in lanes (real.h). */
#ifndef BEAMWORK_EXACT_STRESSED_H
#define BEAMWORK_EXACT_STRESSED_H

#include <string.h>

#include "elements/geometrically_exact/exact.h"
#include "elements/math/real.h"

/* Stresses, energy, and the difference C - S in the rows of strains that affect the twist, in each
 * lane. */
typedef struct exact_stressed {
    real stress[EXACT_STIFFNESS_MAX_STRAINS], energy;
    real more[EXACT_STIFFNESS_MAX_STRAINS][EXACT_STIFFNESS_MAX_STRAINS];
} exact_stressed;

static inline int exact_stressed_entry(int g, int i)
{
    return 6 * g + (i == 0 ? 0 : 3 + i);
}

static inline real exact_stressed_along(const exact_stiffness *k, const real stress[], int g)
{
    real sum = k->r[0] * stress[exact_stressed_entry(g, 0)];
    for (int i = 1; i < 3; i++)
        sum += k->r[i] * stress[exact_stressed_entry(g, i)];
    return sum;
}

/* Adds the Wagner torque, whose energy is sum torque_i (twist_i . e)^4. */
static inline void exact_stressed_torque(const exact_stiffness *k, const real twisting[],
                                         exact_stressed *out)
{
    for (int p = 0; p < k->field && k->torque[p] != 0; p++) {
        real twist = k->twist[p][0] * twisting[0];
        for (int i = 1; i < k->twisting; i++)
            twist += k->twist[p][i] * twisting[i];
        const real square = twist * twist, force = (4 * k->torque[p]) * (square * twist),
                   slope = (12 * k->torque[p]) * square;
        out->energy += force * twist * 0.25;
        for (int i = 0; i < k->twisting; i++) {
            const real along = slope * k->twist[p][i];
            out->stress[k->place[i]] += force * k->twist[p][i];
            for (int j = 0; j <= i; j++)
                out->more[i][k->place[j]] += along * k->twist[p][j];
        }
    }
}

/* Computes t_g = Q_g e, and replaces e by ebar, which adds e . t_g/2 times r_g to the elongation
 * and the bending strains. */
static inline void exact_stressed_lengthen(const exact_stiffness *k, const real twisting[],
                                           real t[][EXACT_STIFFNESS_MAX_STRAINS], real e[])
{
    for (int g = 0; g < k->points; g++) {
        real half = real_of(0);
        for (int i = 0; i < k->twisting; i++) {
            t[g][i] = real_of(0);
            for (int j = 0; j < k->twisting; j++)
                t[g][i] += k->Q[g][i][j] * twisting[j];
            half += twisting[i] * t[g][i];
        }
        for (int i = 0; i < 3; i++)
            e[exact_stressed_entry(g, i)] += (0.5 * k->r[i]) * half;
    }
}

/* Computes C = S + S r_g t_g^T + t_g (S r_g)^T + t_g (r_g . S r_h) t_h^T + tau_g Q_g in the rows of
 * the strains that affect the twist. In the columns of these strains, only entries up to the
 * diagonal are computed. */
static inline void exact_stressed_tangent(const exact_stiffness *k,
                                          real t[][EXACT_STIFFNESS_MAX_STRAINS], const real tau[],
                                          exact_stressed *out)
{
    for (int g = 0; g < k->points; g++) {
        real bent[EXACT_STIFFNESS_MAX_STRAINS];
        for (int i = 0; i < k->twisting; i++) {
            bent[i] = real_of(k->Sr[g][k->place[i]]);
            for (int h = 0; h < k->points; h++)
                bent[i] += k->coupling[g][h] * t[h][i];
        }
        for (int i = 0; i < k->twisting; i++) {
            real *row = out->more[i];
            for (int j = 0; j < k->strains; j++)
                if (k->order[j] < 0)
                    row[j] += t[g][i] * k->Sr[g][j];
            for (int j = 0; j <= i; j++)
                row[k->place[j]] +=
                    bent[j] * t[g][i] + t[g][j] * k->Sr[g][k->place[i]] + tau[g] * k->Q[g][i][j];
        }
    }
}

static inline void exact_stressed_evaluate(const exact_stiffness *k, const real strain[],
                                           exact_stressed *out)
{
    const int n = k->strains;
    real e[EXACT_STIFFNESS_MAX_STRAINS], twisting[EXACT_STIFFNESS_MAX_STRAINS],
        t[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS], tau[EXACT_STRAIN_MAX_POINTS];
    for (int i = 0; i < n; i++)
        e[i] = strain[i];
    for (int i = 0; i < k->twisting; i++) {
        twisting[i] = strain[k->place[i]];
        for (int j = 0; j < n; j++)
            out->more[i][j] = real_of(0);
    }
    if (k->modified)
        exact_stressed_lengthen(k, twisting, t, e);
    out->energy = real_of(0);
    for (int i = 0; i < n; i++) {
        out->stress[i] = k->S[i * n] * e[0];
        for (int j = 1; j < n; j++)
            out->stress[i] += k->S[i * n + j] * e[j];
        out->energy += out->stress[i] * e[i];
    }
    out->energy *= 0.5;
    if (k->modified) {
        for (int g = 0; g < k->points; g++)
            tau[g] = exact_stressed_along(k, out->stress, g);
        exact_stressed_tangent(k, t, tau, out);
        for (int g = 0; g < k->points; g++)
            for (int i = 0; i < k->twisting; i++)
                out->stress[k->place[i]] += tau[g] * t[g][i];
    }
    if (k->twisting > 0)
        exact_stressed_torque(k, twisting, out);
}

static inline void exact_stressed_write(const exact_stiffness *k, const exact_stressed *w, int lane,
                                        stress_output *out)
{
    const int n = k->strains;
    if (out->sigma != NULL)
        for (int i = 0; i < n; i++)
            out->sigma[i] = real_lane(&w->stress[i], lane);
    if (out->energy != NULL)
        *out->energy = real_lane(&w->energy, lane);
    if (out->residual != NULL)
        *out->residual = 0;
    if (out->C == NULL)
        return;
    memcpy(out->C, k->S, (size_t)(n * n) * sizeof *out->C);
    for (int i = 0; i < k->twisting; i++) {
        const int row = k->place[i];
        for (int j = 0; j < n; j++) {
            if (k->order[j] > i)
                continue;
            const double C = k->S[row * n + j] + real_lane(&w->more[i][j], lane);
            out->C[row * n + j] = out->C[j * n + row] = C;
        }
    }
}

/* Computes the outputs of element_type.stress_many for `run` elements of one kind, at most
 * LANES. */
static inline void exact_stressed_stress(const exact_stiffness *k, int run, const double *const e[],
                                         stress_output out[], status outcome[])
{
    real strain[EXACT_STIFFNESS_MAX_STRAINS];
    exact_stressed w;
    for (int lane = 0; lane < LANES; lane++)
        for (int i = 0; i < k->strains; i++)
            real_put(&strain[i], lane, e[lane < run ? lane : run - 1][i]);
    exact_stressed_evaluate(k, strain, &w);
    for (int lane = 0; lane < run; lane++) {
        exact_stressed_write(k, &w, lane, &out[lane]);
        outcome[lane] = STATUS_OK;
    }
}

#endif
