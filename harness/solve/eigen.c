#include "harness/solve/eigen.h"

#include <arpack/arpack.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DENSE_UP_TO = 120 };

static status alloc_result(eigen_result *r, int n, int positive, int negative, fault *f)
{
    memset(r, 0, sizeof *r);
    r->n = n;
    r->mu_positive = calloc((size_t)positive + 1, sizeof(double));
    r->mu_negative = calloc((size_t)negative + 1, sizeof(double));
    r->mode_positive = calloc((size_t)(positive + 1) * (size_t)n, sizeof(double));
    r->mode_negative = calloc((size_t)(negative + 1) * (size_t)n, sizeof(double));
    if (r->mu_positive == NULL || r->mu_negative == NULL || r->mode_positive == NULL || r->mode_negative == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for eigenvectors");
    return STATUS_OK;
}

void eigen_free(eigen_result *r)
{
    free(r->mu_positive);
    free(r->mu_negative);
    free(r->mode_positive);
    free(r->mode_negative);
    memset(r, 0, sizeof *r);
}

static void fill_dense(const sparse *a, double factor_, double D[])
{
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            D[(size_t)a->row[k] * (size_t)a->n + (size_t)j] = factor_ * a->value[k];
            if (a->symmetric)
                D[(size_t)j * (size_t)a->n + (size_t)a->row[k]] = factor_ * a->value[k];
        }
}

/* Takes over pair (mu, x) when it is on the wanted side and not a rounding error. */
static void take(eigen_result *r, double mu, double scale, const double x[], int stride, int positive, int negative)
{
    if (fabs(mu) <= 1e-13 * scale)
        return;
    const int up = mu > 0;
    int *count = up ? &r->positive : &r->negative;
    if (*count >= (up ? positive : negative))
        return;
    double *mode = (up ? r->mode_positive : r->mode_negative) + (size_t)*count * (size_t)r->n;
    (up ? r->mu_positive : r->mu_negative)[(*count)++] = mu;
    for (int i = 0; i < r->n; i++)
        mode[i] = x[(size_t)i * (size_t)stride];
}

static status solve_dense(const eigen_problem *p, eigen_result *r, fault *f)
{
    const size_t n = (size_t)p->K->n;
    double *A = calloc(n * n + 1, sizeof *A), *K = calloc(n * n + 1, sizeof *K), *mu = calloc(n + 1, sizeof *mu);
    status outcome = STATUS_OK;
    if (A == NULL || K == NULL || mu == NULL) {
        outcome = fault_set(f, STATUS_FAULT, "out of memory for an eigenvalue problem");
    } else {
        fill_dense(p->A, p->sign, A);
        fill_dense(p->K, 1, K);
        const int info = LAPACKE_dsygv(LAPACK_ROW_MAJOR, 1, 'V', 'U', (int)n, A, (int)n, K, (int)n, mu);
        if (info != 0)
            outcome = fault_set(f, STATUS_SINGULAR, "the stiffness matrix is not positive definite: something is not held");
        const double scale = n > 0 ? fmax(fabs(mu[0]), fabs(mu[n - 1])) : 0;
        for (size_t i = 0; i < n && outcome == STATUS_OK; i++)
            take(r, mu[n - 1 - i], scale, &A[n - 1 - i], (int)n, p->largest, 0);
        for (size_t i = 0; i < n && outcome == STATUS_OK; i++)
            take(r, mu[i], scale, &A[i], (int)n, 0, p->smallest);
    }
    free(A);
    free(K);
    free(mu);
    return outcome;
}

typedef struct arnoldi {
    int n, nev, ncv, lworkl;
    double *resid, *v, *workd, *workl, *d;
    int *select;
} arnoldi;

static void arnoldi_free(arnoldi *a)
{
    free(a->resid);
    free(a->v);
    free(a->workd);
    free(a->workl);
    free(a->d);
    free(a->select);
}

static status arnoldi_alloc(arnoldi *a, int n, int wanted, int subspace, fault *f)
{
    memset(a, 0, sizeof *a);
    a->n = n;
    a->nev = wanted < n - 1 ? wanted : n - 1;
    a->ncv = subspace < n ? subspace : n;
    a->lworkl = a->ncv * (a->ncv + 8);
    a->resid = malloc((size_t)n * sizeof(double));
    a->v = malloc((size_t)n * (size_t)a->ncv * sizeof(double));
    a->workd = malloc(3 * (size_t)n * sizeof(double));
    a->workl = malloc((size_t)a->lworkl * sizeof(double));
    a->d = malloc((size_t)a->ncv * sizeof(double));
    a->select = malloc((size_t)a->ncv * sizeof(int));
    if (a->resid == NULL || a->v == NULL || a->workd == NULL || a->workl == NULL || a->d == NULL || a->select == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for an eigenvalue problem");
    unsigned long long seed = 0x9E3779B97F4A7C15ull; /* the same start every time */
    for (int i = 0; i < n; i++) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        a->resid[i] = (double)(seed >> 11) / 9007199254740992.0 - 0.5;
    }
    return STATUS_OK;
}

/* OP = K^-1 A in the inner product of K (ARPACK's mode 2). */
static int arnoldi_iterate(const eigen_problem *p, arnoldi *a, const char *which, int *param, int *pointer, long *solutions)
{
    int ido = 0, info = 1;
    memset(param, 0, 11 * sizeof *param);
    param[0] = 1;
    param[2] = 3000;
    param[6] = 2;
    for (;;) {
        dsaupd_c(&ido, "G", a->n, which, a->nev, 0, a->resid, a->ncv, a->v, a->n, param, pointer, a->workd, a->workl, a->lworkl,
                 &info);
        double *x = a->workd + pointer[0] - 1, *y = a->workd + pointer[1] - 1;
        if (ido == 2) {
            sparse_mul(p->K, x, y);
            continue;
        }
        if (ido != 1 && ido != -1)
            return info;
        sparse_mul(p->A, x, y);
        for (int i = 0; i < a->n; i++)
            y[i] *= p->sign;
        memcpy(x, y, (size_t)a->n * sizeof *x);
        factor_solve(p->K_factor, y);
        (*solutions)++;
    }
}

static int descending_size(const double *d, int n, int *order)
{
    for (int i = 0; i < n; i++)
        order[i] = i;
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && fabs(d[order[k]]) > fabs(d[order[k - 1]]); k--) {
            const int swap = order[k];
            order[k] = order[k - 1];
            order[k - 1] = swap;
        }
    return n;
}

static status solve_end(const eigen_problem *p, const char *which, int wanted, eigen_result *r, double *scale, fault *f)
{
    arnoldi a;
    int param[11], pointer[14], info = 0;
    status outcome = arnoldi_alloc(&a, p->K->n, wanted, 2 * wanted + 20, f);
    if (outcome == STATUS_OK) {
        info = arnoldi_iterate(p, &a, which, param, pointer, &r->solutions);
        const int found = param[4];
        if (info < 0 || (info != 0 && found < a.nev))
            outcome = fault_set(f, STATUS_NOT_CONVERGED, "%d of %d eigenvalues found (ARPACK says %d)", found, a.nev, info);
    }
    if (outcome == STATUS_OK) {
        int order[256];
        dseupd_c(1, "A", a.select, a.d, a.v, a.n, 0, "G", a.n, which, a.nev, 0, a.resid, a.ncv, a.v, a.n, param, pointer, a.workd,
                 a.workl, a.lworkl, &info);
        const int count = descending_size(a.d, a.nev < 256 ? a.nev : 256, order);
        *scale = fmax(*scale, count > 0 ? fabs(a.d[order[0]]) : 0);
        for (int i = 0; i < count && info == 0; i++)
            take(r, a.d[order[i]], *scale, a.v + (size_t)order[i] * (size_t)a.n, 1, which[0] == 'L' ? p->largest : 0,
                 which[0] == 'S' ? p->smallest : 0);
        if (info != 0)
            outcome = fault_set(f, STATUS_NOT_CONVERGED, "the eigenvectors were not found (ARPACK says %d)", info);
    }
    arnoldi_free(&a);
    return outcome;
}

status eigen_solve(const eigen_problem *p, eigen_result *r, fault *f)
{
    status outcome = alloc_result(r, p->K->n, p->largest, p->smallest, f);
    double scale = 0;
    if (outcome != STATUS_OK || p->K->n == 0)
        return outcome;
    if (p->K->n <= DENSE_UP_TO || p->largest + p->smallest + 2 >= p->K->n)
        return solve_dense(p, r, f);
    if (p->largest > 0)
        outcome = solve_end(p, "LA", p->largest, r, &scale, f);
    if (outcome == STATUS_OK && p->smallest > 0)
        outcome = solve_end(p, "SA", p->smallest, r, &scale, f);
    return outcome;
}
