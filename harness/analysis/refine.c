/* Poles from the dynamic stiffness D(s) = K + s C + s^2 M by inverse iteration, because slow poles
 * next to a shift have few digits. */
#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct refinement {
    const sparse *K, *M, *C; /* same pattern */
    int n;
    double complex *D, *x, *u, *w; /* [n x n] D and its factors; [n] vectors */
    lapack_int *order;             /* [n] */
} refinement;

/* Computes y = dD/ds x. absolute 1: computes the sums of the absolute values of the terms of D(s)
 * x. */
static void multiply(const refinement *t, double complex s, int absolute, const double complex x[],
                     double complex y[])
{
    const sparse *K = t->K;
    memset(y, 0, (size_t)t->n * sizeof *y);
    for (int j = 0; j < t->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++) {
            const double c = t->C->value[k], m = t->M->value[k], size = cabs(s);
            if (absolute)
                y[K->row[k]] +=
                    (fabs(K->value[k]) + size * (fabs(c) + size * fabs(m))) * cabs(x[j]);
            else
                y[K->row[k]] += (c + 2 * s * m) * x[j];
        }
}

/* Factors D(s). Returns 0 if D(s) is exactly singular. */
static int factor_just_at(refinement *t, double complex s)
{
    const sparse *K = t->K;
    const size_t n = (size_t)t->n;
    memset(t->D, 0, n * n * sizeof *t->D);
    for (size_t j = 0; j < n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            t->D[j * n + (size_t)K->row[k]] =
                K->value[k] + s * (t->C->value[k] + s * t->M->value[k]);
    return LAPACKE_zgetrf(LAPACK_COL_MAJOR, t->n, t->n, t->D, t->n, t->order) == 0;
}

static int factor_at(refinement *t, double complex s)
{
    return factor_just_at(t, s) || factor_just_at(t, s * (1 + 8 * DBL_EPSILON));
}

static void solve(const refinement *t, char how, double complex x[])
{
    LAPACKE_zgetrs(LAPACK_COL_MAJOR, how, t->n, 1, t->D, t->n, t->order, x, t->n);
}

static void normalise(int n, double complex x[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += creal(x[i]) * creal(x[i]) + cimag(x[i]) * cimag(x[i]);
    for (int i = 0; i < n && sum > 0; i++)
        x[i] /= sqrt(sum);
}

static double complex product(int n, const double complex a[], const double complex b[])
{
    double complex sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Returns the rounding error of s. Rounding of all entries changes s by w^T |dD| x/(w^T dD/ds x).
 */
static double rounding_at(refinement *t, double complex s)
{
    memcpy(t->w, t->x, (size_t)t->n * sizeof *t->w);
    for (int pass = 0; pass < 2; pass++) {
        solve(t, 'T', t->w);
        normalise(t->n, t->w);
    }
    multiply(t, s, 0, t->x, t->u);
    const double slope = cabs(product(t->n, t->w, t->u));
    multiply(t, s, 1, t->x, t->u);
    double sum = 0;
    for (int i = 0; i < t->n; i++)
        sum += cabs(t->w[i]) * creal(t->u[i]);
    return DBL_EPSILON * sum / slope;
}

/* Iterates, and returns the error relative to the pole *s; INFINITY: no convergence. Convergence is
 * quadratic. The iteration ends early, because further steps mix the vectors of double poles. */
static double iterate(refinement *t, double complex *s)
{
    enum { PASSES = 30 };
    const double last = 1e-8; /* step, relative to *s */
    for (int pass = 0; pass < PASSES; pass++) {
        if (!factor_at(t, *s))
            return INFINITY;
        multiply(t, *s, 0, t->x, t->u);
        solve(t, 'N', t->u);
        const double complex change = product(t->n, t->x, t->x) / product(t->n, t->x, t->u);
        if (!isfinite(cabs(change)))
            return INFINITY;
        *s -= change;
        normalise(t->n, t->u);
        memcpy(t->x, t->u, (size_t)t->n * sizeof *t->x);
        if (cabs(change) <= last * cabs(*s))
            return rounding_at(t, *s) / cabs(*s);
    }
    return INFINITY;
}

status refine_pole(const sparse of[], double complex *s, double mode[], double *error, fault *f)
{
    enum { DENSE = 1200 }; /* largest n */
    const size_t n = (size_t)of[0].n;
    *error = INFINITY;
    if (n > DENSE)
        return STATUS_OK;
    refinement t = {.K = &of[0], .M = &of[1], .C = &of[2], .n = of[0].n};
    t.D = calloc(n * n + 3 * n + 1, sizeof *t.D);
    t.order = calloc(n + 1, sizeof *t.order);
    const int room = t.D != NULL && t.order != NULL;
    if (room) {
        t.x = t.D + n * n;
        t.u = t.x + n;
        t.w = t.u + n;
        for (size_t i = 0; i < n; i++)
            t.x[i] = mode[i];
        normalise(t.n, t.x);
        *error = iterate(&t, s);
        for (size_t i = 0; i < n; i++)
            mode[i] = creal(t.x[i]);
    }
    free(t.D);
    free(t.order);
    return room ? STATUS_OK : fault_memory(f, "a pole");
}
