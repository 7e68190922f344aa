/* Poles of matrices with closed loops of feedback, whose integrals may have slow poles. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "poles of closed loops");
}

int poles_integrals(const vibration *v)
{
    int count = 0;
    for (int i = 0; i < v->loops; i++)
        count += v->loop[i].integrates;
    return count;
}

static double diagonal(const sparse *a, int j)
{
    for (int k = a->column[j]; k < a->column[j + 1]; k++)
        if (a->row[k] == j)
            return fabs(a->value[k]);
    return 0;
}

/* Returns the square root of the largest quotient of diagonal entries, which approximates the
 * highest circular frequency. */
static double highest(const unsymmetric_problem *p)
{
    double square = 0;
    for (int j = 0; j < p->K->n; j++)
        if (diagonal(p->M, j) > 0)
            square = fmax(square, diagonal(p->K, j) / diagonal(p->M, j));
    return sqrt(square);
}

/* Estimates the lowest circular frequency of the structure from K^-1 M, with the motions measured
 * by integrals held at 0. x, y [n]: work space. */
static double slowest(const unsymmetric_problem *p, double x[], double y[])
{
    enum { PASSES = 5 };
    const int n = p->K->n;
    double most = 0;
    for (int i = 0; i < n; i++)
        x[i] = 1 + 0.1 * (i % 7);
    for (int pass = 0; pass <= PASSES; pass++) {
        sparse_mul(p->M, x, y);
        const double size = sqrt(fabs(dense_dot(n, x, y)));
        if (pass > 0)
            most = size;
        for (int i = 0; i < n && size > 0; i++)
            y[i] /= size;
        memcpy(x, y, (size_t)n * sizeof *x);
        factor_solve(p->K_factor, x);
    }
    return most > 0 ? fmin(highest(p), 1 / sqrt(most)) : highest(p);
}

static double size_of(const unsymmetric_result *r, int i)
{
    return hypot(r->growth[i], r->frequency[i]);
}

/* Ratio of the shift to the magnitude of the slowest mode. */
static const double small = 1e-3;

/* Returns 1 if the slow pole of an integral hides other modes in rounding errors. */
static int hides(const unsymmetric_problem *p, const unsymmetric_result *r)
{
    const double digits = 1e-10, some = 1e-7, acceptable = 1e-6;
    int hidden = r->count == 0 || size_of(r, 0) < digits * highest(p) ||
                 size_of(r, 0) < some * size_of(r, r->count - 1);
    for (int i = 0; i < r->count; i++)
        hidden |= !(r->error[i] <= acceptable);
    return hidden;
}

/* Sets K to K + shift C + shift^2 M, and C to C + 2 shift M. own: values of K and then of C without
 * the shift. */
static void shift_by(sparse closed[], const double own[], double shift)
{
    sparse *K = &closed[0], *M = &closed[1], *C = &closed[2];
    for (int k = 0, entries = K->column[K->n]; k < entries; k++) {
        K->value[k] = own[k] + shift * own[entries + k] + shift * shift * M->value[k];
        C->value[k] = own[entries + k] + 2 * shift * M->value[k];
    }
}

/* Solves with a shift that is a small fraction of the slowest mode that is not a pole of an
 * integral. A first shift is used to find this mode. */
static status solve_shifted(vibration *v, unsymmetric_problem *p, int integrals, sparse closed[],
                            const double own[], double first, unsymmetric_result *r, fault *f)
{
    for (double shift = first; shift > 0;) {
        shift_by(closed, own, shift);
        p->shift = shift;
        TRY(factor_numeric(p->K_factor, p->K, f));
        v->c->run->counters.factorisations++;
        unsymmetric_free(r);
        TRY(unsymmetric_solve(p, r, f));
        const double other = r->count > integrals ? size_of(r, integrals) : 0;
        shift = shift > 10 * small * other ? small * other : 0;
    }
    return STATUS_OK;
}

/* Returns 1 if the results i and k are the same pole, which was found twice, and not a double
 * pole. */
static int is_same(const unsymmetric_result *r, int i, int k)
{
    const double same = 1e-6, *a = r->mode + (size_t)i * (size_t)r->n,
                 *b = r->mode + (size_t)k * (size_t)r->n;
    const double part = fabs(dense_dot(r->n, a, b)),
                 size = sqrt(dense_dot(r->n, a, a) * dense_dot(r->n, b, b));
    return hypot(r->growth[k] - r->growth[i], r->frequency[k] - r->frequency[i]) <
               same * size_of(r, i) &&
           part > (1 - same) * size;
}

static status refine_slow(const sparse closed[], double shift, unsymmetric_result *r, fault *f)
{
    const double slow = 1e-2 * shift;
    for (int i = 0; i < r->count && size_of(r, i) < slow; i++) {
        const int is_real = r->frequency[i] == 0;
        double complex s = r->growth[i] + I * r->frequency[i];
        double *mode = r->mode + (size_t)i * (size_t)r->n;
        TRY(refine_pole(closed, &s, mode, &r->error[i], f));
        if (is_real != (cimag(s) == 0) || cabs(s) >= slow)
            r->error[i] = INFINITY;
        r->frequency[i] = fabs(cimag(s));
        r->growth[i] = fabs(creal(s)) > 10 * r->error[i] * cabs(s) ? creal(s) : 0;
        for (int k = 0; k < i; k++)
            if (is_same(r, i, k))
                r->error[k] = r->error[i] = INFINITY;
    }
    for (int i = 0; i < r->count && size_of(r, i) < slow; i++)
        r->lost += !(r->error[i] < INFINITY);
    return STATUS_OK;
}

status poles_solve(vibration *v, unsymmetric_problem *p, sparse closed[], unsymmetric_result *r,
                   fault *f)
{
    const int integrals = poles_integrals(v);
    const status first = unsymmetric_solve(p, r, f);
    if (first == STATUS_FAULT || integrals == 0 || (first == STATUS_OK && !hides(p, r)))
        return first;
    const size_t entries = (size_t)p->K->column[p->K->n];
    const size_t n = (size_t)p->K->n;
    double *own = malloc((2 * entries + 2 * n + 1) * sizeof *own);
    if (own == NULL)
        return no_memory(f);
    memcpy(own, closed[0].value, entries * sizeof *own);
    memcpy(own + entries, closed[2].value, entries * sizeof *own);
    p->wanted += integrals;
    const double from = small * slowest(p, own + 2 * entries, own + 2 * entries + n);
    status outcome = solve_shifted(v, p, integrals, closed, own, from, r, f);
    memcpy(closed[0].value, own, entries * sizeof *own);
    memcpy(closed[2].value, own + entries, entries * sizeof *own);
    free(own);
    if (outcome == STATUS_OK)
        outcome = refine_slow(closed, p->shift, r, f);
    v->c->run->counters.factorisations++;
    return outcome == STATUS_OK ? factor_numeric(p->K_factor, p->K, f) : outcome;
}
