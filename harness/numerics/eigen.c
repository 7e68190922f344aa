#include "harness/numerics/numerics_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Adds the first wanted[i] vectors of each side to its candidates: the most positive eigenvalues
 * (0) and the most negative eigenvalues (1). side[i] NULL: this side is not requested. */
static status eigen_dense_add(candidates *const side[2], const int wanted[2], fault *f);

enum { DENSE_UP_TO = 80, SPARE = 2, MAX_PASSES = 8 };
enum {
    DENSE_AT_LAST_UP_TO = 700
}; /* largest size at which dense matrices are used after an iteration that ended early; such a
    * solution takes seconds */

/* The iteration ignores eigenvalues below this fraction of the largest eigenvalue. */
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

/* What the iterations have found out about all eigenvalues of a problem. */
typedef struct spectrum {
    double scale;   /* largest magnitude */
    double least;   /* eigenvalues up to this value count as zero */
    int is_nothing; /* 1: A is zero or a rounding error */
} spectrum;

/* Adds candidates from a Lanczos run in the complement of the current candidates.
 * Kx[candidates x n]. certain 1: so many eigenvalues exist. */
static status take_lanczos(candidates *p, int count, int certain, const double Kx[], spectrum *s,
                           fault *f)
{
    const eigen_problem *e = p->problem;
    const int first = p->count == 0;
    const double least = fmax(negligible, candidates_least(p->n, 1));
    const lanczos_problem l = {.K = e->K,
                               .A = e->A,
                               .K_factor = e->K_factor,
                               .sign = p->sign,
                               .known = p->count,
                               .KX = Kx,
                               .scale = s->scale,
                               .least = least,
                               .certain = certain,
                               .spare = first ? SPARE : 0};
    lanczos_result found;
    TRY(lanczos_largest(&l, count, &found, f));
    s->scale = found.scale;
    s->least = least * found.scale;
    if (found.found == 0) {
        s->is_nothing =
            first && (found.scale == 0 || candidates_is_rounding(p, found.scale, found.x));
        free(found.x);
        return STATUS_OK;
    }
    TRY(candidates_take(p, found.found, found.x, s->least, f));
    s->is_nothing =
        first && p->count > 0 && candidates_is_rounding(p, p->mu[0] * p->stiffness[0], p->x);
    p->certain = p->count > 0;
    return STATUS_OK;
}

static status run_lanczos(candidates *p, int wanted, int certain, spectrum *s, fault *f)
{
    const int room = p->n - p->count - 1, count = wanted < room ? wanted : room;
    double *Kx = candidates_products(p);
    const status outcome = Kx != NULL ? take_lanczos(p, count, certain, Kx, s, f)
                                      : fault_memory(f, "%d eigenvectors", p->count);
    free(Kx);
    return outcome;
}

/* Reduces *requested to the number of existing eigenvalues. They are counted above smaller and
 * smaller values until their number suffices or the value is the smallest one that counts. */
static status count_existing(candidates *p, const spectrum *of, int *requested, eigen_result *r,
                             fault *f)
{
    const double step = 30;
    int exist = 0;
    for (double s = of->scale; exist < *requested && s > of->least;) {
        int above = 0;
        s = fmax(s / step, of->least);
        const status outcome = candidates_count_above(p, s, &above, r, f);
        if (outcome == STATUS_FAULT)
            return outcome;
        if (outcome == STATUS_OK && above > exist)
            exist = above;
    }
    *requested = exist < *requested ? exist : *requested;
    return STATUS_OK;
}

static status solve_densely(candidates *up, candidates *down, const int wanted[2], eigen_result *r,
                            fault *f)
{
    numerics_work_add_dense(r->n);
    return eigen_dense_add((candidates *[]){up, down}, wanted, f);
}

/* Finds the wanted candidates and proves that none is missing. Several runs find vectors of nearly
 * equal eigenvalues one after the other, as any combinations, which are separated at the end. */
static status fill(candidates *p, int wanted, spectrum *s, eigen_result *r, fault *f)
{
    int requested = wanted, missing = wanted + SPARE, pass = 0;
    for (; missing > 0; pass++) {
        if (pass == MAX_PASSES + requested || p->count + missing >= p->n)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "%d of %d eigenvalues were not found in %d attempts; use another "
                             "number of elements",
                             missing, requested, pass);
        candidates_count_rest(p);
        p->count = p->count < wanted ? p->count : wanted; /* the spare vectors are inaccurate */
        TRY(run_lanczos(p, missing, pass > 0, s, f));
        if (s->is_nothing)
            return STATUS_OK;
        if (pass == 0 && p->count < wanted)
            TRY(count_existing(p, s, &requested, r, f));
        missing = requested - p->count;
        if (missing <= 0 && requested > 0)
            TRY(candidates_count_missing(p, requested, &missing, r, f));
    }
    return pass > 1 ? polish(p, f) : STATUS_OK;
}

static status keep_first(candidates *p, eigen_result *r, fault *f)
{
    int missing = 1;
    while (p->count > 0) {
        const status outcome = candidates_count_missing(p, p->count, &missing, r, f);
        if (outcome == STATUS_FAULT || (outcome == STATUS_OK && missing == 0))
            return outcome;
        p->count--;
    }
    return STATUS_OK;
}

static status one_sparse(candidates *p, int side, int wanted, eigen_side *out, eigen_result *r,
                         fault *f)
{
    fault why = {""};
    spectrum s = {0};
    if (wanted == 0)
        return STATUS_OK;
    out->status = fill(p, wanted, &s, r, &why);
    if (out->status == STATUS_OK && s.is_nothing) {
        out->rounding++;
        p->count = 0;
    }
    if (out->status == STATUS_NOT_CONVERGED && p->n <= DENSE_AT_LAST_UP_TO) {
        p->count = p->certain = 0;
        out->status = solve_densely(side == 0 ? p : NULL, side == 0 ? NULL : p,
                                    (int[]){wanted, wanted}, r, &why);
    }
    if (out->status == STATUS_OK)
        return STATUS_OK;
    snprintf(out->reason, sizeof out->reason, "%s", why.text);
    return out->status == STATUS_FAULT ? fault_set(f, STATUS_FAULT, "%s", why.text)
                                       : keep_first(p, r, f);
}

/* Removes values that are rounding errors of A. If a value is a rounding error, all smaller values
 * are also rounding errors. */
static void drop_rounding(candidates *p, eigen_side *out)
{
    const double uncertain_below = 1e-6;
    for (int i = 0; i < p->count; i++)
        if ((i == 0 ? !p->certain : p->mu[i] < uncertain_below * p->mu[0]) &&
            candidates_is_rounding(p, p->mu[i] * p->stiffness[i],
                                   p->x + (size_t)i * (size_t)p->n)) {
            out->rounding = p->count - i;
            p->count = i;
        }
}

static double evaluate(candidates *p, int count, eigen_side *out)
{
    double largest = 0;
    for (int i = 0; i < count; i++) {
        candidates_evaluate(p, i, &out->residual[i], &out->error[i]);
        largest = fmax(largest, out->error[i]);
    }
    return largest;
}

/* Computes residuals and errors. If the assembly of K has noticeably changed x^T K x of a candidate
 * and K_product is available, improves the vectors first, which are also affected. */
static status improve(candidates *p, int count, eigen_side *out, fault *f)
{
    enum { SWEEPS = 3 };
    const double acceptable = 1e-6;
    const double good = 1e-8;
    if (p->problem->K_product == NULL || candidates_departure(p, count) <= acceptable) {
        evaluate(p, count, out);
        return STATUS_OK;
    }
    TRY(candidates_refine(p, count, f));
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        TRY(polish(p, f));
        if (evaluate(p, count, out) <= good)
            break;
    }
    return STATUS_OK;
}

static void drop_lost(candidates *p, int count, eigen_side *out)
{
    const double noticeable = 1e-9;
    const int rounded =
        p->problem->K_rounding != NULL && candidates_departure(p, count) > noticeable;
    for (int i = 0; i < count; i++) {
        const double *x = p->x + (size_t)i * (size_t)p->n;
        if (rounded)
            out->error[i] += p->problem->K_rounding(p->problem->context, x) / p->stiffness[i];
        if (out->error[i] <= EIGEN_LARGEST_ERROR)
            continue;
        p->mu[i] = NAN;
        if (out->status == STATUS_OK)
            snprintf(out->reason, sizeof out->reason,
                     "eigenvalue %d (with %d unknowns) is lost in round-off (error %.1e); use "
                     "fewer elements",
                     i + 1, p->n, out->error[i]);
        out->status = STATUS_NOT_CONVERGED;
    }
}

static status store_results(candidates *p, int wanted, eigen_side *out, fault *f)
{
    const size_t n = (size_t)p->n;
    drop_rounding(p, out);
    const int count = p->count < wanted ? p->count : wanted;
    out->residual = calloc((size_t)count + 1, sizeof *out->residual);
    out->error = calloc((size_t)count + 1, sizeof *out->error);
    if (out->residual == NULL || out->error == NULL)
        return fault_memory(f, "%d eigenvalues", count);
    TRY(improve(p, count, out, f));
    drop_lost(p, count, out);
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

static status find(const eigen_problem *e, candidates *up, candidates *down, eigen_result *r,
                   fault *f)
{
    const int most = (e->largest > e->smallest ? e->largest : e->smallest) + SPARE + 1;
    if ((r->n <= DENSE_UP_TO && !e->iterate) || most >= r->n)
        return solve_densely(up, down, (int[]){e->largest, e->smallest}, r, f);
    TRY(one_sparse(up, 0, e->largest, &r->positive, r, f));
    return one_sparse(down, 1, e->smallest, &r->negative, r, f);
}

static status solve(const eigen_problem *e, candidates *up, candidates *down, eigen_result *r,
                    fault *f)
{
    TRY(candidates_alloc(up, e, e->sign, f));
    TRY(candidates_alloc(down, e, -e->sign, f));
    TRY(find(e, up, down, r, f));
    TRY(store_results(up, e->largest, &r->positive, f));
    TRY(store_results(down, e->smallest, &r->negative, f));
    const eigen_side *worse = r->positive.status != STATUS_OK ? &r->positive : &r->negative;
    return worse->status == STATUS_OK ? STATUS_OK
                                      : fault_set(f, worse->status, "%s", worse->reason);
}

/* Uses the upper triangle of a matrix of which all entries are stored. K - A/mu, of which few
 * digits may remain, is then symmetric, even if K and A are unsymmetric because of rounding. */
static status take_upper(const sparse **a, by_numbers **whole, fault *f)
{
    if ((*a)->symmetric)
        return STATUS_OK;
    TRY(by_numbers_alloc(*a, whole, f));
    by_numbers_take(*whole, *a);
    *a = by_numbers_upper(*whole);
    return STATUS_OK;
}

static status solve_upper(const eigen_problem *e, eigen_result *r, fault *f)
{
    eigen_problem upper = *e;
    by_numbers *K = NULL, *A = NULL;
    candidates up = {0}, down = {0};
    status outcome = take_upper(&upper.K, &K, f);
    if (outcome == STATUS_OK)
        outcome = take_upper(&upper.A, &A, f);
    if (outcome == STATUS_OK)
        outcome = solve(&upper, &up, &down, r, f);
    candidates_free(&up);
    candidates_free(&down);
    by_numbers_free(K);
    by_numbers_free(A);
    return outcome;
}

status eigen_solve(const eigen_problem *e, eigen_result *r, fault *f)
{
    const int negative = factor_count(e->K_factor).negative_pivots;
    memset(r, 0, sizeof *r);
    r->n = e->K->n;
    if (negative != 0)
        return fault_set(f, STATUS_REFUSED,
                         "the eigenvalue solver requires a positive definite stiffness matrix; "
                         "this one %s",
                         negative > 0
                             ? "has negative pivots, because the structure is beyond a critical "
                               "point"
                             : "is not symmetric");
    if (r->n == 0)
        return STATUS_OK;
    return solve_upper(e, r, f);
}

static void fill_dense(const sparse *a, double factor_, double D[])
{
    const size_t n = (size_t)a->n;
    for (size_t j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            D[(size_t)a->row[k] * n + j] = D[j * n + (size_t)a->row[k]] = factor_ * a->value[k];
}

/* Computes all eigenvalues mu[n] in ascending order, and their vectors x[n x n], one after the
 * other. */
static status solve_dense(const eigen_problem *e, double mu[], double x[], fault *f)
{
    const int n = e->K->n;
    double *K = calloc((size_t)n * (size_t)n, sizeof *K);
    if (K == NULL)
        return fault_memory(f, "a dense matrix of %d unknowns", n);
    fill_dense(e->A, e->sign, x);
    fill_dense(e->K, 1, K);
    const int info = LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', n, x, n, K, n, mu);
    free(K);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "a dense eigenvalue problem of %d unknowns was not solved (LAPACK "
                                 "returned %d); use another number of elements",
                                 n, info);
}

static status take_dense(candidates *const side[2], const int wanted[2], double mu[], double x[],
                         fault *f)
{
    const candidates *any = side[0] != NULL ? side[0] : side[1];
    const size_t n = (size_t)any->n;
    TRY(solve_dense(any->problem, mu, x, f));
    const double least = candidates_least(any->n, fmax(fabs(mu[0]), fabs(mu[n - 1])));
    for (int i = 0; i < 2; i++) {
        const size_t count = (size_t)(wanted[i] < any->n ? wanted[i] : any->n);
        if (side[i] != NULL)
            TRY(candidates_add(side[i], (int)count, i == 0 ? x + (n - count) * n : x, least, f));
    }
    return STATUS_OK;
}

static status eigen_dense_add(candidates *const side[2], const int wanted[2], fault *f)
{
    const size_t n = (size_t)(side[0] != NULL ? side[0] : side[1])->n;
    double *mu = calloc(n, sizeof *mu), *x = calloc(n * n, sizeof *x);
    const status outcome = mu != NULL && x != NULL ? take_dense(side, wanted, mu, x, f)
                                                   : fault_memory(f, "an eigenvalue problem");
    free(mu);
    free(x);
    return outcome;
}
