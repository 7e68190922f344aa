#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

enum { SPARE = 3, MAX_PASSES = 30, MAX_STARTS = 4, ROOM_PER_MODE = 16 };

/* limits of the residual sqrt(r^H S^-1 r) with x^H S x = 1; the relative error of a frequency is of
 * the order of its square */
static const double good_residual = 1e-8, acceptable_residual = 1e-5;
/* A pair need not converge if rounding changes lambda^2 by more than this fraction. */
static const double no_digits = 1e-7;
/* K counts as nearly singular if the smallest magnitude of the eigenvalues of (K, M) is below
 * near_zero times a scale: the square of the rate of G or, if it is smaller and all requested
 * eigenvalues are known, their largest magnitude. The shift is then away_from_zero times the
 * scale. */
static const double near_zero = 1e-4, away_from_zero = 1e-2;
/* If there are no pairs beyond those found, frequencies are counted below this number times the
 * last one. */
static const double far = 1e3;

typedef struct gyroscopic_solver {
    const gyroscopic_problem *p;
    gyroscopic_result *out;
    double shift;
    double least;
    double nearest,
        furthest; /* smallest and largest magnitudes of the eigenvalues of (K, M) at the start */
    double softest;
    int all_known;
    const sparse *S;
    sparse shifted;
    subspace basis;
    ritz pairs;
    double *re, *im, *work, *product;
    int found; /* number of requested pairs with significant digits */
} gyroscopic_solver;

void gyroscopic_free(gyroscopic_result *r)
{
    free(r->frequency);
    free(r->growth);
    free(r->error);
    free(r->mode);
    memset(r, 0, sizeof *r);
}

static void basis_product(void *context, const double x[], double y[])
{
    const gyroscopic_solver *s = context;
    estimate_stiffness(s->p, x, y);
    if (s->shift == 0)
        return;
    sparse_mul(s->p->M, x, s->product);
    for (int i = 0; i < s->out->n; i++)
        y[i] += s->shift * s->product[i];
}

/* Adds the combination sum_k c_k vector_k, multiplied by `times`, to re + i im. */
static void accumulate(const gyroscopic_solver *s, const double *vectors, const double complex c[],
                       double complex times)
{
    const size_t n = (size_t)s->basis.n;
    for (int k = 0; k < s->pairs.size; k++) {
        const double complex a = times * c[k];
        for (size_t i = 0; i < n; i++) {
            s->re[i] += creal(a) * vectors[(size_t)k * n + i];
            s->im[i] += cimag(a) * vectors[(size_t)k * n + i];
        }
    }
}

static void clear(const gyroscopic_solver *s)
{
    memset(s->re, 0, (size_t)s->basis.n * sizeof *s->re);
    memset(s->im, 0, (size_t)s->basis.n * sizeof *s->im);
}

static double solve_half(gyroscopic_solver *s, double half[])
{
    memcpy(s->work, half, (size_t)s->basis.n * sizeof *half);
    factor_solve(s->p->K_factor, half);
    return fmax(0, dense_dot(s->basis.n, s->work, half));
}

static double improve(gyroscopic_solver *s, int i, int *grown)
{
    const double complex lambda = s->pairs.lambda[i],
                         *c = s->pairs.c + (size_t)i * (size_t)s->basis.room;
    clear(s);
    accumulate(s, s->basis.SV, c, 1);
    accumulate(s, s->basis.MV, c, lambda * lambda - s->shift);
    accumulate(s, s->basis.GV, c, lambda);
    const double size = sqrt(solve_half(s, s->re) + solve_half(s, s->im));
    if (size > good_residual) {
        *grown += subspace_add(&s->basis, s->re);
        *grown += subspace_add(&s->basis, s->im);
    }
    return size;
}

/* Returns the relative change of lambda^2 of pair i due to rounding, estimated from its mass
 * relative to the largest mass. */
static double noise(const gyroscopic_solver *s, int i)
{
    const double size = cabs(s->pairs.lambda[i]);
    double mass = 0;
    for (int k = 0; k < s->basis.count; k++)
        mass = fmax(mass, s->basis.Mp[k * s->basis.room + k]);
    return size * size * mass * DBL_EPSILON;
}

static status iterate(gyroscopic_solver *s, int wanted, fault *f)
{
    for (int pass = 0;; pass++) {
        TRY(s->shift > 0 ? ritz_general(&s->basis, s->shift, &s->pairs, f)
                         : ritz_hermitian(&s->basis, &s->pairs, f));
        const int count = s->pairs.count < wanted ? s->pairs.count : wanted;
        double worst = 0, beyond = 0;
        int grown = 0;
        s->found = count;
        for (int i = 0; i < count; i++) {
            const double size = improve(s, i, &grown);
            if (size > acceptable_residual && s->found == count && noise(s, i) > no_digits)
                s->found = i;
            worst = fmax(worst, i < s->found ? size : 0);
            beyond = fmax(beyond, size);
        }
        if (beyond <= good_residual)
            return STATUS_OK;
        if (grown > 0 && pass < MAX_PASSES)
            continue;
        return worst <= acceptable_residual
                   ? STATUS_OK
                   : fault_set(f, STATUS_NOT_CONVERGED,
                               "frequencies in a rotating frame did not converge: the residual is "
                               "%.1e with %d vectors; use fewer elements, or request fewer modes",
                               worst, s->basis.count);
    }
}

static status start(gyroscopic_solver *s, int count, fault *f)
{
    eigen_result e = {0};
    const eigen_problem problem = {
        .K = s->S, .A = s->p->M, .K_factor = s->p->K_factor, .sign = 1, .largest = count};
    const status outcome = eigen_solve(&problem, &e, f);
    s->nearest = s->furthest = s->softest = NAN;
    s->all_known = outcome == STATUS_OK && e.positive.count >= count;
    for (int i = 0; i < e.positive.count; i++) {
        const double size = fabs(1 / e.positive.mu[i] - s->shift);
        s->nearest = fmin(s->nearest, size);
        s->softest = fmin(s->softest, 1 / e.positive.mu[i]);
        s->furthest = fmax(s->furthest, size);
        subspace_add(&s->basis, e.positive.mode + (size_t)i * (size_t)s->basis.n);
    }
    s->out->factorisations += e.factorisations;
    eigen_free(&e);
    return outcome == STATUS_NOT_CONVERGED && isfinite(s->softest) ? STATUS_OK : outcome;
}

/* Returns the number of negative eigenvalues of K that the pairs do not explain. */
static int unaccounted(const gyroscopic_solver *s)
{
    return s->out->negative -
           gyroscopic_index_of(&s->pairs, &s->basis, s->shift, s->found).negative;
}

static status prove(gyroscopic_solver *s, int last, status counted, int below, int *number)
{
    const gyroscopic_index found = gyroscopic_index_of(&s->pairs, &s->basis, s->shift, last);
    const int negative = s->out->negative;
    if (counted == STATUS_OK)
        *number = abs(below - negative - found.crossed);
    else if (s->out->unproven == 0)
        s->out->unproven = negative;
    return counted == STATUS_FAULT ? counted : STATUS_OK;
}

/* Returns the largest relative change of x^H S x, over the pairs found, due to the assembly of
 * S. */
static double departure(gyroscopic_solver *s)
{
    double largest = 0;
    for (int i = 0; i < s->found; i++) {
        clear(s);
        accumulate(s, s->basis.V, s->pairs.c + (size_t)i * (size_t)s->basis.room, 1);
        sparse_mul(s->S, s->re, s->work);
        double sum = dense_dot(s->basis.n, s->re, s->work);
        sparse_mul(s->S, s->im, s->work);
        sum += dense_dot(s->basis.n, s->im, s->work);
        largest = fmax(largest, fabs(sum - 1));
    }
    return largest;
}

static status missing(gyroscopic_solver *s, int wanted, int *number, fault *f)
{
    const double gap = fmax(1e-6, 4 * departure(s));
    int last = s->found, below = 0;
    *number = 0;
    s->out->unproven = s->out->negative > 0 ? unaccounted(s) : 0;
    if (last == s->pairs.count && last == wanted)
        last--;
    while (last > 0 && last < s->pairs.count &&
           !(cabs(s->pairs.lambda[last]) >
             (1 + fmax(gap, fmin(1, 4 * noise(s, last)))) * cabs(s->pairs.lambda[last - 1])))
        last--;
    if (last <= 0)
        return STATUS_OK;
    const double size = cabs(s->pairs.lambda[last - 1]),
                 next = last < s->pairs.count ? cabs(s->pairs.lambda[last]) : far * far * size;
    const double omega = sqrt(size * next);
    const status outcome = gyroscopic_count(s->p->K, s->p->M, s->p->G, omega, &below, f);
    s->out->factorisations++;
    if (s->out->negative > 0)
        return prove(s, last, outcome, below, number);
    TRY(outcome);
    *number = below > last ? below - last : 0;
    return STATUS_OK;
}

/* Returns the rate of G [1/s]: its largest entry relative to the masses of the row and the
 * column. */
static double rate_of_turning(const sparse *G, const sparse *M)
{
    double rate = 0;
    for (int j = 0; j < G->n; j++)
        for (int k = G->column[j]; k < G->column[j + 1]; k++) {
            const double mass = sqrt(sparse_diagonal(M, j) * sparse_diagonal(M, G->row[k]));
            if (mass > 0)
                rate = fmax(rate, fabs(G->value[k]) / mass);
        }
    return rate;
}

static status find_shift(gyroscopic_solver *s, fault *f)
{
    const sparse *K = s->p->K, *M = s->p->M;
    double k = 0, mass = 0;
    if (s->shifted.value == NULL)
        TRY(sparse_alloc_like(K, &s->shifted, f));
    s->S = &s->shifted;
    for (int j = 0; j < K->n; j++) {
        k += fabs(sparse_diagonal(K, j));
        mass += sparse_diagonal(M, j);
    }
    for (s->shift = fmax(1e-12 * k / mass, s->least);; s->shift *= 10) {
        if (!(s->shift < 1e3 * k / mass))
            return fault_set(f, STATUS_REFUSED,
                             "the stiffness of coordinates without mass is indefinite, so the "
                             "motion is not defined; elements may be too long for their axial "
                             "force; use more elements, or another formulation");
        for (int i = 0; i < K->column[K->n]; i++)
            s->shifted.value[i] = K->value[i] + s->shift * M->value[i];
        const status factored = factor_numeric(s->p->K_factor, &s->shifted, f);
        s->out->factorisations++;
        if (factored == STATUS_SINGULAR)
            continue;
        TRY(factored);
        if (factor_count(s->p->K_factor).negative_pivots == 0)
            return STATUS_OK;
    }
}

/* Returns the shift that the first start shows to be necessary because K or K + shift M is nearly
 * singular, as at a critical speed; 0: the current shift is sufficient. */
static double shift_after(const gyroscopic_solver *s, status started)
{
    const double rate = rate_of_turning(s->p->G, s->p->M);
    const double scale = s->all_known ? fmin(rate * rate, s->furthest) : rate * rate;
    const int nearly = started != STATUS_OK || s->nearest < near_zero * scale;
    if (s->shift > 0 && (started != STATUS_OK || s->softest < near_zero * s->shift))
        return fmax(2 * s->shift, away_from_zero * scale);
    return nearly ? away_from_zero * scale : 0;
}

static status begin(gyroscopic_solver *s, int count, fault *f)
{
    const status outcome = start(s, count, f);
    if (outcome != STATUS_OK && outcome != STATUS_NOT_CONVERGED)
        return outcome;
    s->least = shift_after(s, outcome);
    if (!(s->least > s->shift))
        return outcome;
    TRY(find_shift(s, f));
    s->basis.count = 0;
    return start(s, count, f);
}

static void turn_phase(const gyroscopic_solver *s)
{
    double complex square = 0;
    for (int i = 0; i < s->basis.n; i++)
        square += (s->re[i] + I * s->im[i]) * (s->re[i] + I * s->im[i]);
    const double complex phase = cexp(-I * carg(square) / 2);
    for (int i = 0; i < s->basis.n; i++) {
        const double complex x = phase * (s->re[i] + I * s->im[i]);
        s->re[i] = creal(x);
        s->im[i] = cimag(x);
    }
}

static void take_pair(gyroscopic_solver *s, int i, motion_estimate *e)
{
    gyroscopic_result *r = s->out;
    double complex lambda = s->pairs.lambda[i];
    const int grows = r->negative > 0 && gyroscopic_index_grows(&s->pairs, &s->basis, s->shift, i);
    clear(s);
    accumulate(s, s->basis.V, s->pairs.c + (size_t)i * (size_t)s->basis.room, 1);
    turn_phase(s);
    estimate_pair(e, i, s->re, s->im, grows, &lambda, &r->error[i]);
    r->frequency[i] = cimag(lambda);
    if (grows)
        r->growth[i] = creal(lambda);
    memcpy(r->mode + (size_t)i * (size_t)r->n, s->re, (size_t)r->n * sizeof(double));
}

static status store_results(gyroscopic_solver *s, fault *f)
{
    gyroscopic_result *r = s->out;
    motion_estimate e;
    r->count = s->found;
    r->frequency = calloc((size_t)r->count + 1, sizeof(double));
    r->growth = calloc((size_t)r->count + 1, sizeof(double));
    r->error = calloc((size_t)r->count + 1, sizeof(double));
    r->mode = calloc((size_t)r->count * (size_t)r->n + 1, sizeof(double));
    if (r->frequency == NULL || r->growth == NULL || r->error == NULL || r->mode == NULL)
        return fault_memory(f, "%d modes", r->count);
    TRY(estimate_alloc(r->n, &e, f));
    e.p = s->p;
    e.basis = &s->basis;
    e.S_factor = s->p->K_factor;
    e.pairs = &s->pairs;
    e.shift = s->shift;
    e.found = s->found;
    for (int i = 0; i < r->count; i++)
        take_pair(s, i, &e);
    estimate_free(&e);
    return STATUS_OK;
}

static status find(gyroscopic_solver *s, fault *f)
{
    const int n = s->out->n;
    int first = s->p->wanted + SPARE, lost = 1;
    for (int attempt = 0; lost > 0; attempt++) {
        if (attempt == MAX_STARTS)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "number of frequencies in a rotating frame that were not found: %d; "
                             "request another number of modes",
                             lost);
        TRY((attempt == 0 ? begin : start)(s, first < n ? first : n, f));
        TRY(iterate(s, s->p->wanted, f));
        TRY(missing(s, s->p->wanted, &lost, f));
        first += 2 * lost + SPARE;
    }
    return store_results(s, f);
}

static status solve(gyroscopic_solver *s, fault *f)
{
    const gyroscopic_problem *p = s->p;
    const int vectors = p->wanted + SPARE;
    if (s->re == NULL)
        return fault_memory(f, "modes");
    if (s->out->negative < 0)
        return fault_set(f, STATUS_REFUSED,
                         "frequencies in a rotating frame require a symmetric stiffness; remove "
                         "moments about fixed axes");
    if (s->out->negative > 0)
        TRY(find_shift(s, f));
    TRY(subspace_alloc(&s->basis, basis_product, s, p->M, p->G, ROOM_PER_MODE * vectors, f));
    TRY(ritz_alloc(&s->pairs, vectors, &s->basis, f));
    return s->out->n > 0 ? find(s, f) : STATUS_OK;
}

status gyroscopic_solve(const gyroscopic_problem *p, gyroscopic_result *r, fault *f)
{
    const size_t n = (size_t)p->K->n;
    gyroscopic_solver s = {.p = p, .out = r, .S = p->K, .re = calloc(4 * n + 1, sizeof(double))};
    memset(r, 0, sizeof *r);
    r->n = (int)n;
    r->negative = factor_count(p->K_factor).negative_pivots;
    s.im = s.re + n;
    s.work = s.im + n;
    s.product = s.work + n;
    const status outcome = solve(&s, f);
    subspace_free(&s.basis);
    ritz_free(&s.pairs);
    sparse_free_values(&s.shifted);
    free(s.re);
    return outcome;
}
