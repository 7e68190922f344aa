/* Written as products of v = (1, x), the potential and its derivatives are sums over the few terms
 * that are not zero. */
#include "elements/sheet/potential.h"

#include <string.h>

#include "elements/math/dense.h"

enum { N = SHEET_LOCAL_COORDINATES, V = 1 + N };

/* Everything at one x: v = (1, x), Cholesky factor of A, s = A^-1 b, W_i,a = d(b_i - (A s)_i)/dv_a
 * at fixed s. */
typedef struct point {
    double v[V], L[SHEET_STRESSES * SHEET_STRESSES], b[SHEET_STRESSES], s[SHEET_STRESSES],
        W[SHEET_STRESSES][V];
} point;

static void set_variables(const double x[N], double v[V])
{
    v[0] = 1;
    memcpy(v + 1, x, N * sizeof(double));
}

static status solve(const sheet_potential *p, const double x[N], point *at)
{
    memset(at, 0, sizeof *at);
    set_variables(x, at->v);
    const double *v = at->v;
    for (int k = 0; k < p->terms_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        at->L[SHEET_STRESSES * t->i + t->j] += t->c * v[t->a] * v[t->b];
    }
    for (int k = 0; k < p->terms_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        const double ca = t->c * v[t->a];
        at->b[t->i] += ca * v[t->b];
        at->W[t->i][t->b] += ca;
        at->W[t->i][t->a] += t->c * v[t->b];
    }
    if (dense_cholesky(SHEET_STRESSES, at->L) != 0)
        return STATUS_SINGULAR;
    memcpy(at->s, at->b, sizeof at->s);
    dense_cholesky_solve(SHEET_STRESSES, 1, at->L, at->s);
    return STATUS_OK;
}

/* g_a += 1/2 s.W_a */
static void add_half_work(const point *at, double g[V])
{
    for (int i = 0; i < SHEET_STRESSES; i++)
        for (int a = 0; a < V; a++)
            g[a] += at->s[i] / 2 * at->W[i][a];
}

/* Terms of P at fixed stresses: g = d(P0 + b.s - s^T A s/2)/dv, h its second derivatives with row
 * <= column; W completed. s.b,a - s^T A,a s/2 is half of s.W_a before and after A,a s is taken from
 * W. Index 0 is no variable: its entries are not used. */
static void add_explicit(const sheet_potential *p, point *at, double g[V], double h[V * V])
{
    const double *v = at->v, *s = at->s;
    add_half_work(at, g);
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
        const double c = t->i == t->j ? t->c / 2 : t->c, ci = c * s[t->i], cj = c * s[t->j];
        at->W[t->i][t->a] -= cj * v[t->b];
        at->W[t->j][t->a] -= ci * v[t->b];
        at->W[t->i][t->b] -= cj * v[t->a];
        at->W[t->j][t->b] -= ci * v[t->a];
        h[V * t->a + t->b] -= (t->a == t->b ? 2 : 1) * ci * s[t->j];
    }
    add_half_work(at, g);
}

/* Rows of L^-1 W: their products are W^T A^-1 W. */
static void forward(const double L[SHEET_STRESSES * SHEET_STRESSES], double W[SHEET_STRESSES][V])
{
    for (int i = 0; i < SHEET_STRESSES; i++) {
        for (int k = 0; k < i; k++)
            for (int a = 0; a < V; a++)
                W[i][a] -= L[SHEET_STRESSES * i + k] * W[k][a];
        for (int a = 0; a < V; a++)
            W[i][a] /= L[(SHEET_STRESSES + 1) * i];
    }
}

static double value(const sheet_potential *p, const point *at)
{
    double P = 0;
    for (int k = 0; k < p->terms_P0; k++)
        P += p->P0[k].c * at->v[p->P0[k].a] * at->v[p->P0[k].b];
    for (int i = 0; i < SHEET_STRESSES; i++)
        P += at->b[i] * at->s[i] / 2;
    return P;
}

/* P,k = P0,k + s.b,k - s^T A,k s/2,
 * P,kl = P0,kl + s.b,kl - s^T A,kl s/2 + (b,k - A,k s)^T A^-1 (b,l - A,l s). */
status sheet_potential_evaluate(const sheet_potential *p, const double x[N], double *P,
                                double *gradient, double *hessian)
{
    point at;
    double g[V] = {0}, h[V * V] = {0};
    TRY(solve(p, x, &at));
    if (P != NULL)
        *P = value(p, &at);
    if (gradient == NULL && hessian == NULL)
        return STATUS_OK;
    add_explicit(p, &at, g, h);
    if (gradient != NULL)
        memcpy(gradient, g + 1, N * sizeof(double));
    if (hessian == NULL)
        return STATUS_OK;
    forward(at.L, at.W);
    for (int a = 1; a < V; a++)
        for (int b = a; b < V; b++) {
            double sum = h[V * a + b];
            for (int i = 0; i < SHEET_STRESSES; i++)
                sum += at.W[i][a] * at.W[i][b];
            hessian[N * (a - 1) + b - 1] = hessian[N * (b - 1) + a - 1] = sum;
        }
    return STATUS_OK;
}

/* With s_k = A^-1 W_k, W_k = b,k - A,k s, and d a direction:
 * P,kld = s_d.(b,kl - A,kl s) + s_l.W_k,d + s_k.W_l,d - s_k^T A,d s_l, W_k,d = b,kd - A,kd s - A,k
 * s_d. */
status sheet_potential_third(const sheet_potential *p, const double x[N], const double dx[N],
                             double T[N * N])
{
    point at;
    double g[V] = {0}, h[V * V] = {0}, d[V], sd[SHEET_STRESSES] = {0}, S[SHEET_STRESSES][V],
           Wd[SHEET_STRESSES][V] = {{0}}, Ad[SHEET_STRESSES][SHEET_STRESSES] = {{0}};
    TRY(solve(p, x, &at));
    add_explicit(p, &at, g, h);
    set_variables(dx, d);
    d[0] = 0;
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
