/* The Hessian of (z, q), [Kzz, G^T; G, -f] (condensed.h).  G = dh/dz - 1 is near -1 in whatever
 * state, and Kzz may have any sign, so that G goes first: dz = H (q + f dq), X dq = z - Kzz H q. */
#ifndef BEAMWORK_BEAMW_HESSIAN_H
#define BEAMWORK_BEAMW_HESSIAN_H

#include "elements/beamw/internal.h"
#include "elements/math/dense.h"

/* The Hessian and, once it is factorised, H = G^-1, H f and X^-1, X = G^T + Kzz H f. */
typedef struct beamw_hessian {
    real Kzz[9], G[9], H[9], Hf[9], inverse[9];
    real_truth regular; /* neither G nor X is anywhere near a singular one; else by pivots */
} beamw_hessian;

/* dh/dz - 1 and Kzz. */
static inline void beamw_hessian_evaluate(const beamw_condensed *d, const beamw_internal *s,
                                          const real w[BEAMW_CONDENSED_ROWS], beamw_hessian *k)
{
    const real *D[BEAMW_CONDENSED_ROWS];
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++)
        D[r] = beamw_internal_inside(s, r);
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            real sum = real_of(i == j ? d->Ka[i] : 0);
            for (int r = 0; r < BEAMW_INTERNAL_U; r++)
                sum += d->k[r] * D[r][i] * D[r][j];
            k->Kzz[3 * i + j] = sum;
        }
    for (int t = d->own; t < d->terms; t++)
        k->Kzz[d->term[t].entry] += d->term[t].c * w[d->term[t].row];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++)
            k->Kzz[3 * i + j] = k->Kzz[3 * j + i];
    for (int j = 0; j < 3; j++) {
        k->G[j] = D[BEAMW_INTERNAL_H][j] - (j == 0);
        k->G[3 + j] = D[BEAMW_INTERNAL_H + 1][j] - (j == 1);
        k->G[6 + j] = d->share * D[1][j] - (j == 2);
    }
}

/* inverse = A^-1 by cofactors, which the units of rows and columns do not matter to. Returns where
 * A has a determinant below -1/10: G and X are -1 without stress or flexibility, and grow with it.
 */
static inline real_truth beamw_hessian_invert(const real A[9], real inverse[9])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (int c = 0; c < 3; c++) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            inverse[3 * c + i] = A[3 * j + d] * A[3 * k + e] - A[3 * j + e] * A[3 * k + d];
        }
    }
    const real determinant = A[0] * inverse[0] + A[1] * inverse[3] + A[2] * inverse[6],
               factor = 1 / determinant;
    for (int i = 0; i < 9; i++)
        inverse[i] *= factor;
    return determinant < -0.1;
}

static inline void beamw_hessian_factorise(const beamw_condensed *d, beamw_hessian *k)
{
    real X[9];
    k->regular = beamw_hessian_invert(k->G, k->H);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k->Hf[3 * i + j] = k->H[3 * i] * d->f[j] + k->H[3 * i + 1] * d->f[3 + j] +
                               k->H[3 * i + 2] * d->f[6 + j];
    mat3_mul(k->Kzz, k->Hf, X);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            X[3 * i + j] += k->G[3 * j + i];
    k->regular &= beamw_hessian_invert(X, k->inverse);
}

/* (dz, dq) = Hessian^-1 (z, q). */
static inline void beamw_hessian_solve(const beamw_hessian *k, const real z[3], const real q[3],
                                       real dz[3], real dq[3])
{
    real Hq[3], KHq[3], more[3];
    mat3_mul_vec(k->H, q, Hq);
    mat3_mul_vec(k->Kzz, Hq, KHq);
    for (int i = 0; i < 3; i++)
        KHq[i] = z[i] - KHq[i];
    mat3_mul_vec(k->inverse, KHq, dq);
    mat3_mul_vec(k->Hf, dq, more);
    for (int i = 0; i < 3; i++)
        dz[i] = Hq[i] + more[i];
}

/* The Hessian of one lane with pivots: solves for columns of right[6 x columns], in place.  Returns
 * 0, or 1: it is singular. */
static inline int beamw_hessian_pivoted(const beamw_condensed *d, const beamw_hessian *k, int lane,
                                        int columns, double right[])
{
    enum { INNER = 6 };
    double K[INNER * INNER];
    int pivot[INNER];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            K[INNER * i + j] = real_lane(&k->Kzz[3 * i + j], lane);
            K[INNER * (3 + i) + j] = K[INNER * j + 3 + i] = real_lane(&k->G[3 * i + j], lane);
            K[INNER * (3 + i) + 3 + j] = -d->f[3 * i + j];
        }
    if (dense_lu(INNER, K, pivot) != 0)
        return 1;
    dense_lu_solve(INNER, columns, K, pivot, right);
    return 0;
}

#endif
