/* The potential at its stationary stresses with two derivatives, of one element or of several in
 * lanes.  Written as products of v = (1, x), it is a sum over the few terms that are not zero;
 * these are the same in all states. */
#ifndef BEAMWORK_SHEET_STATIONARY_H
#define BEAMWORK_SHEET_STATIONARY_H

#include <string.h>

#include "elements/math/real_dense.h"
#include "elements/sheet/potential.h"

enum { SHEET_STATIONARY_V = 1 + SHEET_LOCAL_COORDINATES };

/* Everything at one x: v = (1, x), Cholesky factor of A, s = A^-1 b, W_i,a = d(b_i - (A s)_i)/dv_a
 * at fixed s, whose index 0 is no variable and not used. */
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

/* Returns where A is positive definite. */
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

/* g_a += 1/2 s.W_a */
static inline void sheet_stationary_add_half_work(const sheet_stationary *at,
                                                  real g[SHEET_STATIONARY_V])
{
    for (int i = 0; i < SHEET_STRESSES; i++) {
        const real half = at->s[i] / 2;
        for (int a = 1; a < SHEET_STATIONARY_V; a++)
            g[a] += half * at->W[i][a];
    }
}

/* Terms of P at fixed stresses: g += d(P0 + b.s - s^T A s/2)/dv, h += its second derivatives with
 * row <= column; W completed.  s.b,a - s^T A,a s/2 is half of s.W_a before and after A,a s is taken
 * from W.  Index 0 is no variable: its entries are not used. */
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

/* Rows of L^-1 W: their products are W^T A^-1 W. */
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

/* P[1], its gradient[8] and Hessian[8 x 8] at x; NULL: not wanted.  Returns where A is positive
 * definite; where it is nowhere, nothing is written.
 * P,k = P0,k + s.b,k - s^T A,k s/2,
 * P,kl = P0,kl + s.b,kl - s^T A,kl s/2 + (b,k - A,k s)^T A^-1 (b,l - A,l s). */
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

#endif
