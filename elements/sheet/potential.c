#include "elements/sheet/potential.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/sheet/stationary.h"

enum { N = SHEET_LOCAL_COORDINATES, V = 1 + N };

status sheet_potential_evaluate(const sheet_potential *p, const double x[N], double *P,
                                double *gradient, double *hessian)
{
    return sheet_stationary_evaluate(p, x, P, gradient, hessian) ? STATUS_OK : STATUS_SINGULAR;
}

/* With s_k = A^-1 W_k, W_k = b,k - A,k s, and d a direction:
 * P,kld = s_d.(b,kl - A,kl s) + s_l.W_k,d + s_k.W_l,d - s_k^T A,d s_l, W_k,d = b,kd - A,kd s - A,k
 * s_d. */
status sheet_potential_third(const sheet_potential *p, const double x[N], const double dx[N],
                             double T[N * N])
{
    sheet_stationary at;
    double g[V] = {0}, h[V * V] = {0}, d[V] = {0}, sd[SHEET_STRESSES] = {0}, S[SHEET_STRESSES][V],
           Wd[SHEET_STRESSES][V] = {{0}}, Ad[SHEET_STRESSES][SHEET_STRESSES] = {{0}};
    if (!sheet_stationary_solve(p, x, &at))
        return STATUS_SINGULAR;
    sheet_stationary_add_explicit(p, &at, g, h);
    memcpy(d + 1, dx, N * sizeof *d);
    memcpy(S, at.W, sizeof S);
    dense_cholesky_solve(SHEET_STRESSES, V, at.L, &S[0][0]);
    for (int i = 0; i < SHEET_STRESSES; i++)
        for (int a = 0; a < V; a++)
            sd[i] += S[i][a] * d[a];
    memset(h, 0, sizeof h);
    for (int k = 0; k < p->terms_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        h[V * t->a + t->b] += t->c * sd[t->i];
        h[V * t->b + t->a] += t->c * sd[t->i];
        Wd[t->i][t->a] += t->c * d[t->b];
        Wd[t->i][t->b] += t->c * d[t->a];
    }
    for (int k = 0; k < p->terms_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        const double c = t->i == t->j ? t->c / 2 : t->c, va = at.v[t->a], vb = at.v[t->b],
                     da = d[t->a], db = d[t->b];
        const double si = at.s[t->i], sj = at.s[t->j], di = sd[t->i], dj = sd[t->j],
                     along = c * (va * db + vb * da), work = c * (si * dj + sj * di);
        h[V * t->a + t->b] -= work;
        h[V * t->b + t->a] -= work;
        Wd[t->i][t->a] -= c * (db * sj + vb * dj);
        Wd[t->j][t->a] -= c * (db * si + vb * di);
        Wd[t->i][t->b] -= c * (da * sj + va * dj);
        Wd[t->j][t->b] -= c * (da * si + va * di);
        Ad[t->i][t->j] += along;
        Ad[t->j][t->i] += along;
    }
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) {
            double sum = h[V * (k + 1) + l + 1];
            for (int i = 0; i < SHEET_STRESSES; i++) {
                sum += S[i][k + 1] * Wd[i][l + 1] + S[i][l + 1] * Wd[i][k + 1];
                for (int j = 0; j < SHEET_STRESSES; j++)
                    sum -= S[i][k + 1] * Ad[i][j] * S[j][l + 1];
            }
            T[N * k + l] = sum;
        }
    return STATUS_OK;
}
