#include "harness/algebra/eigen.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/lanczos.h"
#include "harness/algebra/pairs.h"

enum { DENSE_UP_TO = 80, SPARE = 2, MAX_PASSES = 8 };

/* Of an eigenvalue, in parts of itself. */
static const double largest_error = 1e-6;

/* Part of the largest size of an eigenvalue below which none is looked for by iteration. */
static const double negligible = 1e-9;

static void free_side(eigen_side *s)
{
    free(s->mu);
    free(s->mode);
    free(s->residual);
    free(s->error);
}

void eigen_free(eigen_result *r)
{
    free_side(&r->positive);
    free_side(&r->negative);
    memset(r, 0, sizeof *r);
}

/* Values below are rounding errors of the largest one: n^(3/2) of them add up in a slender structure of n unknowns. */
static double least_of(int n, double scale)
{
    return 16 * n * sqrt(n) * DBL_EPSILON * scale;
}

static void fill_dense(const sparse *a, double factor_, double D[])
{
    const size_t n = (size_t)a->n;
    for (size_t j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            D[(size_t)a->row[k] * n + j] = D[j * n + (size_t)a->row[k]] = factor_ * a->value[k];
}

/* All eigenvalues mu[n], ascending, with their vectors x[n x n], one after the other. */
static status solve_dense(const eigen_problem *e, double mu[], double x[], fault *f)
{
    const int n = e->K->n;
    double *K = calloc((size_t)n * (size_t)n, sizeof *K);
    if (K == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a dense matrix of %d unknowns", n);
    fill_dense(e->A, e->sign, x);
    fill_dense(e->K, 1, K);
    const int info = LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', n, x, n, K, n, mu);
    free(K);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED, "a dense eigenvalue problem of %d unknowns: LAPACK says %d", n, info);
}

/* Candidates of both sides at once. */
static status both_dense(pairs *up, int largest, pairs *down, int smallest, fault *f)
{
    const size_t n = (size_t)up->n;
    const int from_top = largest < up->n ? largest : up->n, from_bottom = smallest < up->n ? smallest : up->n;
    double *mu = calloc(n, sizeof *mu), *x = calloc(n * n, sizeof *x);
    status outcome = mu == NULL || x == NULL ? fault_set(f, STATUS_FAULT, "out of memory for an eigenvalue problem") : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = solve_dense(up->problem, mu, x, f);
    if (outcome == STATUS_OK) {
        const double least = least_of(up->n, fmax(fabs(mu[0]), fabs(mu[n - 1])));
        outcome = pairs_add(up, from_top, x + (n - (size_t)from_top) * n, least, f);
        if (outcome == STATUS_OK)
            outcome = pairs_add(down, from_bottom, x, least, f);
    }
    free(mu);
    free(x);
    return outcome;
}

/* Candidates from one run of Lanczos, in what the present ones leave. */
static status run_lanczos(pairs *p, int wanted, double least, long *solutions, fault *f)
{
    const eigen_problem *e = p->problem;
    const lanczos_problem l = {e->K, e->A, e->K_factor, p->sign, p->count, p->x, p->Kx};
    const int room = p->n - p->count - 1, count = wanted < room ? wanted : room;
    double *mu = malloc((size_t)count * sizeof *mu), *x = malloc((size_t)count * (size_t)p->n * sizeof *x);
    status outcome = mu == NULL || x == NULL ? fault_set(f, STATUS_FAULT, "out of memory for %d eigenvectors", count) : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = lanczos_largest(&l, count, mu, x, solutions, f);
    if (outcome == STATUS_OK)
        outcome = pairs_add(p, count, x, least, f);
    free(mu);
    free(x);
    return outcome;
}

/* How many eigenvalues exist, as far as `enough`: counted above ever smaller values. Far down, where K is small beside A/s, the
 * count may fail for want of pivoting: what is known by then stands. */
static status count_existing(pairs *p, int enough, double scale, double least, int *exist, eigen_result *r, fault *f)
{
    const double step = 30;
    *exist = 0;
    for (double s = scale; *exist < enough && s > least;) {
        int above = 0;
        s = fmax(s / step, least);
        const status outcome = pairs_above(p, s, &above, r, f);
        if (outcome == STATUS_FAULT)
            return outcome;
        if (outcome == STATUS_OK && above > *exist)
            *exist = above;
    }
    return STATUS_OK;
}

/* Candidates of one side, until the inertia says that no eigenvalue above the last wanted one is missing. */
static status one_sparse(pairs *p, int wanted, eigen_result *r, fault *f)
{
    const double scale = wanted > 0 ? pairs_scale(p, &r->solutions) : 0;
    if (scale == 0)
        return STATUS_OK;
    const double least = fmax(negligible * scale, least_of(p->n, scale));
    int exist;
    status outcome = count_existing(p, wanted + SPARE, scale, least, &exist, r, f);
    const int asked = wanted < exist ? wanted : exist;
    int missing = wanted + SPARE < exist ? wanted + SPARE : exist;
    for (int pass = 0; outcome == STATUS_OK && missing > 0; pass++) {
        if (pass == MAX_PASSES || p->count + missing >= p->n)
            return fault_set(f, STATUS_NOT_CONVERGED, "%d of %d eigenvalues are missing after %d attempts", missing, asked, pass);
        outcome = run_lanczos(p, missing, least, &r->solutions, f);
        missing = asked - p->count;
        if (outcome == STATUS_OK && missing <= 0)
            outcome = pairs_missing(p, asked, &missing, r, f);
    }
    return outcome;
}

/* The best of the candidates become the result. */
static status hand_over(pairs *p, int wanted, eigen_side *out, long *solutions, fault *f)
{
    const size_t n = (size_t)p->n;
    const int count = p->count < wanted ? p->count : wanted;
    out->residual = calloc((size_t)count + 1, sizeof *out->residual);
    out->error = calloc((size_t)count + 1, sizeof *out->error);
    if (out->residual == NULL || out->error == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %d eigenvalues", count);
    for (int i = 0; i < count; i++, (*solutions)++) {
        pairs_judge(p, i, &out->residual[i], &out->error[i]);
        if (!(out->error[i] <= largest_error))
            return fault_set(f, STATUS_NOT_CONVERGED, "eigenvalue %d of %d unknowns is lost in round-off (error %.1e): refine less",
                             i + 1, p->n, out->error[i]);
    }
    for (int i = 0; i < count; i++) {
        for (size_t k = 0; k < n; k++)
            p->x[(size_t)i * n + k] /= sqrt(p->stiffness[i]);
        p->mu[i] *= p->sign * p->problem->sign;
    }
    out->count = count;
    out->mu = p->mu;
    out->mode = p->x;
    p->mu = p->x = NULL;
    return STATUS_OK;
}

static status solve(const eigen_problem *e, pairs *up, pairs *down, eigen_result *r, fault *f)
{
    const int most = (e->largest > e->smallest ? e->largest : e->smallest) + SPARE + 1;
    status outcome;
    if ((r->n <= DENSE_UP_TO && !e->iterate) || most >= r->n) {
        outcome = both_dense(up, e->largest, down, e->smallest, f);
    } else {
        outcome = one_sparse(up, e->largest, r, f);
        if (outcome == STATUS_OK)
            outcome = one_sparse(down, e->smallest, r, f);
    }
    if (outcome == STATUS_OK)
        outcome = hand_over(up, e->largest, &r->positive, &r->solutions, f);
    if (outcome == STATUS_OK)
        outcome = hand_over(down, e->smallest, &r->negative, &r->solutions, f);
    return outcome;
}

status eigen_solve(const eigen_problem *e, eigen_result *r, fault *f)
{
    const int negative = factor_count(e->K_factor).negative_pivots;
    memset(r, 0, sizeof *r);
    r->n = e->K->n;
    if (negative != 0)
        return fault_set(f, STATUS_REFUSED, "eigenvalues need a positive definite stiffness: this one has %d negative pivots%s",
                         negative, negative > 0 ? ", the structure is beyond a critical point" : " (it is not symmetric)");
    if (r->n == 0)
        return STATUS_OK;
    pairs up, down;
    status outcome = pairs_alloc(&up, e, e->sign, f);
    const status other = pairs_alloc(&down, e, -e->sign, f);
    outcome = outcome == STATUS_OK ? other : outcome;
    if (outcome == STATUS_OK)
        outcome = solve(e, &up, &down, r, f);
    pairs_free(&up);
    pairs_free(&down);
    return outcome;
}
