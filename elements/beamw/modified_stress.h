/* The stress function of modified modes for one element or several in lanes. With D = Q(e) and B =
 * 1 + D, sigma = B^T S ebar and dsigma/de = B^T S B + sum (S ebar)_i Q_i. */
#ifndef BEAMWORK_BEAMW_MODIFIED_STRESS_H
#define BEAMWORK_BEAMW_MODIFIED_STRESS_H

#include <string.h>

#include "elements/beamw/variants.h"
#include "elements/shared/lanes.h"

/* Computes y = S x. */
static inline void beamw_modified_stress_of(const element_data *d, const real x[BEAMW_STRAINS],
                                            real y[BEAMW_STRAINS])
{
    for (int i = 0; i < BEAMW_STRAINS; i++)
        y[i] = real_of(0);
    for (int t = 0; t < d->springs; t++)
        y[d->spring[t].i] += d->spring[t].c * x[d->spring[t].j];
}

/* Computes C from D and the conjugate stresses S ebar. */
static inline void beamw_modified_stress_stiffness(const element_data *d, const real D[],
                                                   const real conjugate[BEAMW_STRAINS], real C[])
{
    enum { E = BEAMW_STRAINS };
    real SB[E * E]; /* the rows with D = 0 are not used */
    for (int i = 0; i < E * E; i++)
        SB[i] = real_of(d->S[i]);
    for (int t = 0; t < d->springs; t++) {
        const int i = d->spring[t].i, j = d->spring[t].j;
        if (j < BEAMW_MODIFIED)
            for (int k = 0; k < E; k++)
                SB[E * i + k] += d->spring[t].c * D[E * j + k];
    }
    for (int i = 0; i < E; i++)
        for (int j = i; j < E; j++) {
            real sum = SB[E * i + j];
            for (int k = 0; k < BEAMW_MODIFIED; k++)
                sum += D[E * k + i] * SB[E * k + j];
            C[E * i + j] = sum;
        }
    for (int t = 0; t < d->terms; t++)
        C[d->term[t].entry] += d->term[t].c * conjugate[d->term[t].row];
    for (int i = 0; i < E; i++)
        for (int j = 0; j < i; j++)
            C[E * i + j] = C[E * j + i];
}

/* Computes D and the modified strains ebar. */
static inline void beamw_modified_stress_strains(const element_data *d, const real e[BEAMW_STRAINS],
                                                 real D[], real modified[BEAMW_STRAINS])
{
    enum { E = BEAMW_STRAINS, M = BEAMW_MODIFIED };
    for (int i = 0; i < M * E; i++)
        D[i] = real_of(0);
    for (int t = 0; t < d->terms; t++) {
        const beamw_quadratic_term *of = &d->term[t];
        D[of->to] += of->c * e[of->j];
        D[of->mirrored] += of->c * e[of->i];
    }
    memcpy(modified, e, E * sizeof *modified);
    for (int k = 0; k < M; k++) {
        real sum = D[E * k] * e[0];
        for (int j = 1; j < E; j++)
            sum += D[E * k + j] * e[j];
        modified[k] += sum / 2;
    }
}

static inline void beamw_modified_stress_evaluate(const element_data *d,
                                                  const real e[BEAMW_STRAINS], stress_real *out)
{
    enum { E = BEAMW_STRAINS, M = BEAMW_MODIFIED };
    real D[M * E + 1], modified[E], conjugate[E]; /* the last entry of D is not used */
    beamw_modified_stress_strains(d, e, D, modified);
    for (int i = 0; i < E; i++)
        modified[i] -= d->free[i];
    beamw_modified_stress_of(d, modified, conjugate);
    if (out->energy != NULL) {
        *out->energy = real_of(0);
        for (int i = 0; i < E; i++)
            *out->energy += modified[i] * conjugate[i] / 2;
    }
    if (out->sigma != NULL)
        for (int i = 0; i < E; i++) {
            real sum = conjugate[i];
            for (int k = 0; k < M; k++)
                sum += D[E * k + i] * conjugate[k];
            out->sigma[i] = sum;
        }
    if (out->state != NULL && out->sigma != NULL)
        for (int i = 0; i < E; i++)
            conjugate[i] += out->state[i] - out->sigma[i];
    if (out->C != NULL)
        beamw_modified_stress_stiffness(d, D, conjugate, out->C);
    if (out->residual != NULL)
        *out->residual = real_of(0);
}

#endif
