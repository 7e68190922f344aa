/* The Hellinger-Reissner potential of N section 3 as a polynomial in the local coordinates (N Eqs.
 * 44-50): P = P0 + b.s - 1/2 s^T A s at the stresses s = A^-1 b, where s = (F~x, M~x, M~yp, M~yq,
 * M~zp, M~zq). */
#ifndef BEAMWORK_SHEET_POTENTIAL_H
#define BEAMWORK_SHEET_POTENTIAL_H

#include <string.h>

#include "elements/math/real_dense.h"
#include "elements/sheet/sheet.h"

enum { SHEET_STRESSES = 6 };

/* A term c v_a v_b, a <= b, of A_ij and A_ji (i >= j), of b_i or of P0, where v_0 = 1 and v_(1+k) =
 * x_k. */
typedef struct sheet_potential_term {
    double c;
    int i, j, a, b;
} sheet_potential_term;

enum { SHEET_TERMS_A = 96, SHEET_TERMS_B = 64, SHEET_TERMS_P0 = 12 };

typedef struct sheet_potential {
    int terms_A, terms_b, terms_P0;
    /* Indices of the first linear and the first quadratic term. Terms are ordered by degree in
     * x. */
    int linear_A, quadratic_A, linear_b, quadratic_b, linear_P0, quadratic_P0;
    sheet_potential_term A[SHEET_TERMS_A], b[SHEET_TERMS_B], P0[SHEET_TERMS_P0];
} sheet_potential;

/* Computes the terms of A, b and P0. If `printed` is 1, u_y in M_x has the sign of N Eq. 49 as
 * printed. REFUSED: the section has no torsional stiffness. */
status sheet_coefficients_prepare(const element_request *request, int printed, sheet_potential *out,
                                  fault *f);

/* Computes P[1], its gradient[8] and its Hessian[8 x 8] at x, except those that are NULL. Returns
 * SINGULAR if A is not positive definite at x. */
status sheet_potential_evaluate(const sheet_potential *p, const double x[SHEET_LOCAL_COORDINATES],
                                double *P, double *gradient, double *hessian);

/* Computes T[8 x 8], the derivative of the Hessian at x in the direction dx. Returns SINGULAR if A
 * is not positive definite at x. */
status sheet_potential_third(const sheet_potential *p, const double x[SHEET_LOCAL_COORDINATES],
                             const double dx[SHEET_LOCAL_COORDINATES],
                             double T[SHEET_LOCAL_COORDINATES * SHEET_LOCAL_COORDINATES]);

/* The potential at its stationary stresses with first and second derivatives, for one element or
 * several in lanes. The potential is a sum over a few nonzero terms, which are products of
 * components of v = (1, x). The list of terms does not depend on the state. */

enum { SHEET_STATIONARY_V = 1 + SHEET_LOCAL_COORDINATES };

/* Values at one x: v = (1, x), the Cholesky factor of A, s = A^-1 b, and W_i,a = d(b_i - (A
 * s)_i)/dv_a at constant s. Column a = 0 is not used, because v_0 is not a variable. */
typedef struct sheet_stationary {
    real v[SHEET_STATIONARY_V], L[SHEET_STRESSES * SHEET_STRESSES], b[SHEET_STRESSES],
        s[SHEET_STRESSES], W[SHEET_STRESSES][SHEET_STATIONARY_V];
} sheet_stationary;

static inline void sheet_stationary_add_A(const sheet_potential *p, sheet_stationary *at)
{
    const real *v = at->v;
    for (int k = 0; k < p->linear_A; k++)
        at->L[SHEET_STRESSES * p->A[k].i + p->A[k].j] += p->A[k].c;
    for (int k = p->linear_A; k < p->quadratic_A; k++)
        at->L[SHEET_STRESSES * p->A[k].i + p->A[k].j] += p->A[k].c * v[p->A[k].b];
    for (int k = p->quadratic_A; k < p->terms_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        at->L[SHEET_STRESSES * t->i + t->j] += t->c * v[t->a] * v[t->b];
    }
}

static inline void sheet_stationary_add_b(const sheet_potential *p, sheet_stationary *at)
{
    const real *v = at->v;
    for (int k = 0; k < p->linear_b; k++)
        at->b[p->b[k].i] += p->b[k].c;
    for (int k = p->linear_b; k < p->quadratic_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        at->b[t->i] += t->c * v[t->b];
        at->W[t->i][t->b] += t->c;
    }
    for (int k = p->quadratic_b; k < p->terms_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        const real ca = t->c * v[t->a];
        at->b[t->i] += ca * v[t->b];
        at->W[t->i][t->b] += ca;
        at->W[t->i][t->a] += t->c * v[t->b];
    }
}

/* Returns the lanes in which A is positive definite. */
static inline real_truth sheet_stationary_solve(const sheet_potential *p,
                                                const real x[SHEET_LOCAL_COORDINATES],
                                                sheet_stationary *at)
{
    memset(at, 0, sizeof *at);
    at->v[0] = real_of(1);
    memcpy(at->v + 1, x, SHEET_LOCAL_COORDINATES * sizeof *x);
    sheet_stationary_add_A(p, at);
    sheet_stationary_add_b(p, at);
    const real_truth good = real_cholesky(SHEET_STRESSES, at->L);
    memcpy(at->s, at->b, sizeof at->s);
    real_cholesky_solve(SHEET_STRESSES, at->L, at->s);
    return good;
}

/* Adds 1/2 s.W_a to g_a. */
static inline void sheet_stationary_add_half_work(const sheet_stationary *at,
                                                  real g[SHEET_STATIONARY_V])
{
    for (int i = 0; i < SHEET_STRESSES; i++) {
        const real half = at->s[i] / 2;
        for (int a = 1; a < SHEET_STATIONARY_V; a++)
            g[a] += half * at->W[i][a];
    }
}

/* Adds the derivatives of P at constant stresses, d(P0 + b.s - s^T A s/2)/dv, to g, and the second
 * derivatives with row <= column to h. Completes W. s.b,a - s^T A,a s/2 is the mean of s.W_a before
 * and after A,a s is subtracted from W. Entries with index 0 are not used, because v_0 is not a
 * variable. */
static inline void sheet_stationary_add_explicit(const sheet_potential *p, sheet_stationary *at,
                                                 real g[SHEET_STATIONARY_V], real h[])
{
    enum { V = SHEET_STATIONARY_V };
    const real *v = at->v, *s = at->s;
    sheet_stationary_add_half_work(at, g);
    for (int k = p->linear_P0; k < p->terms_P0; k++) {
        const sheet_potential_term *t = &p->P0[k];
        g[t->a] += t->c * v[t->b];
        g[t->b] += t->c * v[t->a];
        h[V * t->a + t->b] += t->a == t->b ? 2 * t->c : t->c;
    }
    for (int k = p->quadratic_b; k < p->terms_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        h[V * t->a + t->b] += (t->a == t->b ? 2 : 1) * t->c * s[t->i];
    }
    for (int k = p->linear_A; k < p->quadratic_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        at->W[t->i][t->b] -= t->c * s[t->j];
        if (t->i != t->j)
            at->W[t->j][t->b] -= t->c * s[t->i];
    }
    for (int k = p->quadratic_A; k < p->terms_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        const double c = t->i == t->j ? t->c / 2 : t->c;
        const real ci = c * s[t->i], cj = c * s[t->j];
        at->W[t->i][t->a] -= cj * v[t->b];
        at->W[t->j][t->a] -= ci * v[t->b];
        at->W[t->i][t->b] -= cj * v[t->a];
        at->W[t->j][t->b] -= ci * v[t->a];
        h[V * t->a + t->b] -= (t->a == t->b ? 2 : 1) * ci * s[t->j];
    }
    sheet_stationary_add_half_work(at, g);
}

/* Replaces W by L^-1 W, so W^T A^-1 W becomes a product of its columns. */
static inline void sheet_stationary_forward(sheet_stationary *at)
{
    for (int i = 0; i < SHEET_STRESSES; i++)
        for (int a = 1; a < SHEET_STATIONARY_V; a++) {
            real sum = at->W[i][a];
            for (int k = 0; k < i; k++)
                sum -= at->L[SHEET_STRESSES * i + k] * at->W[k][a];
            at->W[i][a] = sum / at->L[(SHEET_STRESSES + 1) * i];
        }
}

static inline real sheet_stationary_value(const sheet_potential *p, const sheet_stationary *at)
{
    real P = real_of(0);
    for (int k = 0; k < p->terms_P0; k++)
        P += p->P0[k].c * at->v[p->P0[k].a] * at->v[p->P0[k].b];
    for (int i = 0; i < SHEET_STRESSES; i++)
        P += at->b[i] * at->s[i] / 2;
    return P;
}

/* Computes P[1], its gradient[8] and its Hessian[8 x 8] at x, except those that are NULL. Returns
 * the lanes in which A is positive definite. If no lane is valid, nothing is written. P,k = P0,k +
 * s.b,k - s^T A,k s/2, and P,kl = P0,kl + s.b,kl - s^T A,kl s/2 + (b,k - A,k s)^T A^-1 (b,l - A,l
 * s). */
static inline real_truth sheet_stationary_evaluate(const sheet_potential *p,
                                                   const real x[SHEET_LOCAL_COORDINATES], real *P,
                                                   real *gradient, real *hessian)
{
    enum { N = SHEET_LOCAL_COORDINATES, V = SHEET_STATIONARY_V };
    sheet_stationary at;
    real g[V], h[V * V];
    const real_truth good = sheet_stationary_solve(p, x, &at);
    if (!real_any(good))
        return good;
    if (P != NULL)
        *P = sheet_stationary_value(p, &at);
    if (gradient == NULL && hessian == NULL)
        return good;
    memset(g, 0, sizeof g);
    memset(h, 0, sizeof h);
    sheet_stationary_add_explicit(p, &at, g, h);
    if (gradient != NULL)
        memcpy(gradient, g + 1, N * sizeof *g);
    if (hessian == NULL)
        return good;
    sheet_stationary_forward(&at);
    for (int a = 1; a < V; a++)
        for (int b = a; b < V; b++) {
            real sum = h[V * a + b];
            for (int i = 0; i < SHEET_STRESSES; i++)
                sum += at.W[i][a] * at.W[i][b];
            hessian[N * (a - 1) + b - 1] = hessian[N * (b - 1) + a - 1] = sum;
        }
    return good;
}

/* The stress function of the third-order elements as a function of the generalized strains, for one
 * element or several in lanes (N Eqs. 58-65). x = scale e + 1/2 e^T X e inverts the deformation
 * function to second order. Only u and the angles about y have terms in X. The terms of u are
 * products of e5 and e6. Those of the angles are products of e5 or e6 with e2, e7 or e8. */

enum { SHEET_INVERSE_CURVED = 3, SHEET_INVERSE_BENT = 2, SHEET_INVERSE_TWISTED = 3 };

/* Local coordinates with a quadratic inverse (N Eqs. 58, 60, 61), and the strains in their
 * quadratic terms, numbered from 0. */
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
    /* Potential and stress of the stress-free element by N Eq. 52, which are subtracted. */
    double rest_energy, rest_stress[SHEET_STRAINS]; /* [J], [N] */
} sheet_inverse_data;

static inline const sheet_inverse_data *sheet_inverse_of(const element_data *d)
{
    return (const sheet_inverse_data *)(const void *)d;
}

/* Computes the off-diagonal entries X e of a row of dx/de, and 1/2 e^T X e. Zero entries are not
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

/* Computes C = (dx/de)^T h (dx/de) + sum_k g_k d2x_k/de2, where h is symmetric. */
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

/* Computes the outputs of element_type.stress. Returns the lanes that can be evaluated. If no lane
 * is valid, nothing is written. */
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

/* Implements element_type.stress for the second-order elements, for one element or several in
 * lanes. The function is linear except for the Wagner torque. */
static inline void sheet_linear_stress(const sheet_base_data *d, const real e[SHEET_STRAINS],
                                       stress_real *out)
{
    enum { N = SHEET_STRAINS };
    real sigma[N];
    for (int i = 0; i < N; i++) {
        sigma[i] = real_of(0);
        for (int j = 0; j < N; j++)
            sigma[i] += d->S[N * i + j] * e[j];
    }
    if (out->energy != NULL) {
        *out->energy = real_of(0);
        for (int i = 0; i < N; i++)
            *out->energy += sigma[i] * e[i] / 2;
    }
    if (out->sigma != NULL)
        memcpy(out->sigma, sigma, sizeof sigma);
    if (out->C != NULL)
        for (int i = 0; i < N * N; i++)
            out->C[i] = real_of(d->S[i]);
    if (out->residual != NULL)
        *out->residual = real_of(0);
    sheet_wagner_add(&d->wagner, e, out->energy, out->sigma, out->C);
}

#endif
