/* The stress function of the third-order elements in the generalized strains, of one element or of
 * several in lanes: N Eqs. 58-65, x = scale e + 1/2 e^T X e inverts the deformation function to
 * second order.  Of X only u and the angles about y have terms: u products of e5 and e6, the angles
 * products of one of these and e2, e7 or e8. */
#ifndef BEAMWORK_SHEET_INVERSE_H
#define BEAMWORK_SHEET_INVERSE_H

#include "elements/sheet/base.h"
#include "elements/sheet/stationary.h"

enum { SHEET_INVERSE_CURVED = 3, SHEET_INVERSE_BENT = 2, SHEET_INVERSE_TWISTED = 3 };

/* Local coordinates whose inverse is quadratic (N Eqs. 58, 60, 61), and the strains, from 0, in
 * their products. */
static const int sheet_inverse_curved[SHEET_INVERSE_CURVED] = {SHEET_LOCAL_U, SHEET_LOCAL_YP,
                                                               SHEET_LOCAL_YQ},
                 sheet_inverse_bent[SHEET_INVERSE_BENT] = {4, 5},
                 sheet_inverse_twisted[SHEET_INVERSE_TWISTED] = {1, 6, 7};

typedef struct sheet_inverse_data {
    sheet_base_data base;
    sheet_potential potential;
    double bending; /* L^2/EIz [1/N] */
    double scale[SHEET_STRAINS];
    double X[SHEET_INVERSE_CURVED][SHEET_STRAINS * SHEET_STRAINS];
    /* Potential and stress of N Eq. 52 in the stress-free element; they are subtracted. */
    double rest_energy, rest_stress[SHEET_STRAINS]; /* [J], [N] */
} sheet_inverse_data;

static inline const sheet_inverse_data *sheet_inverse_of(const element_data *d)
{
    return (const sheet_inverse_data *)(const void *)d;
}

/* The rows X e that dx/de has beside its diagonal, and 1/2 e^T X e; entries that are zero are not
 * written. */
static inline void sheet_inverse_row(const double X[SHEET_STRAINS * SHEET_STRAINS], int angle,
                                     const real e[SHEET_STRAINS], real row[SHEET_STRAINS])
{
    const int *bent = sheet_inverse_bent, *twisted = sheet_inverse_twisted;
    for (int i = 0; i < SHEET_INVERSE_BENT; i++) {
        const double *c = X + SHEET_STRAINS * bent[i];
        row[bent[i]] = angle ? c[twisted[0]] * e[twisted[0]] + c[twisted[1]] * e[twisted[1]] +
                                   c[twisted[2]] * e[twisted[2]]
                             : c[bent[0]] * e[bent[0]] + c[bent[1]] * e[bent[1]];
    }
    for (int i = 0; i < SHEET_INVERSE_TWISTED && angle; i++) {
        const double *c = X + SHEET_STRAINS * twisted[i];
        row[twisted[i]] = c[bent[0]] * e[bent[0]] + c[bent[1]] * e[bent[1]];
    }
}

/* x(e), of strains counted from the undeformed arc. */
static inline void sheet_inverse_point(const sheet_inverse_data *d, const real e[SHEET_STRAINS],
                                       real x[SHEET_STRAINS],
                                       real row[SHEET_INVERSE_CURVED][SHEET_STRAINS])
{
    static const int angle_strains[] = {1, 4, 5, 6, 7};
    real whole[SHEET_STRAINS];
    for (int k = 0; k < SHEET_STRAINS; k++) {
        whole[k] = e[k] + d->base.table.rest[k];
        x[k] = d->scale[k] * whole[k];
    }
    for (int r = 0; r < SHEET_INVERSE_CURVED; r++)
        sheet_inverse_row(d->X[r], r > 0, whole, row[r]);
    for (int k = 0; k < SHEET_INVERSE_BENT; k++)
        x[SHEET_LOCAL_U] += row[0][sheet_inverse_bent[k]] * whole[sheet_inverse_bent[k]] / 2;
    for (int r = 1; r < SHEET_INVERSE_CURVED; r++)
        for (int k = 0; k < 5; k++)
            x[sheet_inverse_curved[r]] += row[r][angle_strains[k]] * whole[angle_strains[k]] / 2;
}

/* a (dx/de) in place, a[8]. */
static inline void sheet_inverse_multiply(const sheet_inverse_data *d,
                                          real row[SHEET_INVERSE_CURVED][SHEET_STRAINS],
                                          real a[SHEET_STRAINS])
{
    const real u = a[SHEET_LOCAL_U], yp = a[SHEET_LOCAL_YP], yq = a[SHEET_LOCAL_YQ];
    for (int k = 0; k < SHEET_STRAINS; k++)
        a[k] = a[k] * d->scale[k];
    for (int k = 0; k < SHEET_INVERSE_BENT; k++) {
        const int i = sheet_inverse_bent[k];
        a[i] = a[i] + u * row[0][i] + yp * row[1][i] + yq * row[2][i];
    }
    for (int k = 0; k < SHEET_INVERSE_TWISTED; k++) {
        const int i = sheet_inverse_twisted[k];
        a[i] = a[i] + yp * row[1][i] + yq * row[2][i];
    }
}

/* C = (dx/de)^T h (dx/de) + sum_k g_k d2x_k/de2, h symmetric. */
static inline void sheet_inverse_second(const sheet_inverse_data *d,
                                        real row[SHEET_INVERSE_CURVED][SHEET_STRAINS],
                                        const real g[SHEET_STRAINS], const real h[], real C[])
{
    enum { N = SHEET_STRAINS };
    real half[N * N];
    memcpy(half, h, sizeof half);
    for (int i = 0; i < N; i++)
        sheet_inverse_multiply(d, row, half + N * i);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++)
            C[N * i + j] = half[N * j + i];
        sheet_inverse_multiply(d, row, C + N * i);
    }
    for (int i = 0; i < SHEET_INVERSE_BENT; i++) {
        const int a = sheet_inverse_bent[i];
        for (int j = 0; j < SHEET_INVERSE_BENT; j++) {
            const int k = N * a + sheet_inverse_bent[j];
            C[k] += g[SHEET_LOCAL_U] * d->X[0][k];
        }
        for (int j = 0; j < SHEET_INVERSE_TWISTED; j++) {
            const int b = sheet_inverse_twisted[j];
            for (int r = 1; r < SHEET_INVERSE_CURVED; r++) {
                C[N * a + b] += g[sheet_inverse_curved[r]] * d->X[r][N * a + b];
                C[N * b + a] += g[sheet_inverse_curved[r]] * d->X[r][N * b + a];
            }
        }
    }
}

/* As element_type.stress.  Returns where it can be evaluated; where it is nowhere, nothing is
 * written. */
static inline real_truth sheet_inverse_stress(const sheet_inverse_data *d,
                                              const real e[SHEET_STRAINS], stress_real *out)
{
    enum { N = SHEET_STRAINS };
    real x[N], row[SHEET_INVERSE_CURVED][N], g[N], h[N * N];
    const int first = out->sigma != NULL || out->C != NULL;
    sheet_inverse_point(d, e, x, row);
    const real_truth good = sheet_stationary_evaluate(&d->potential, x, out->energy,
                                                      first ? g : NULL, out->C != NULL ? h : NULL);
    if (!real_any(good))
        return good;
    if (out->sigma != NULL) {
        memcpy(out->sigma, g, sizeof g);
        sheet_inverse_multiply(d, row, out->sigma);
        for (int k = 0; k < N; k++)
            out->sigma[k] -= d->rest_stress[k];
    }
    if (out->energy != NULL) {
        *out->energy -= d->rest_energy;
        for (int k = 0; k < N; k++)
            *out->energy -= d->rest_stress[k] * e[k];
    }
    if (out->C != NULL)
        sheet_inverse_second(d, row, g, h, out->C);
    if (out->residual != NULL)
        *out->residual = real_of(0);
    sheet_wagner_add(&d->base.wagner, e, out->energy, out->sigma, out->C);
    return good;
}

#endif
