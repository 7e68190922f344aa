#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

enum { FIRST = 16, MORE = 12, MAX_STARTS = 5, MAX_VECTORS = 400 };

/* Limits of a residual relative to its eigenvalue. rounding_residual is relative to the largest
 * eigenvalue, whose rounding error affects all eigenvalues. */
static const double good_residual = 1e-12, rounding_residual = 1e-14, stalled_residual = 1e-8,
                    acceptable_residual = 1e-5;
/* Eigenvalues with a smaller relative difference count as equal. */
static const double same = 1e-6;
/* An orthogonalised vector counts as zero if its remainder, relative to its former length, is not
 * above this limit. */
static const double nothing = 1e-14;

typedef struct solver {
    const arnoldi_problem *p;
    arnoldi_result *out;
    /* room: capacity; count: number of vectors; chain 1: the last vector belongs to the current
     * start vector */
    int room, count, chain;
    double *Q, *TQ, *H; /* [room x n] basis Q, [room x n] T Q, [room x room] Q^T T Q */
    int whole;          /* 1: Q is the identity */
    double *work, *A, *z, *left, *re, *im; /* left: NULL if left vectors are not requested */
    int *order;
    unsigned long long seed;
    int found;
    double *last;
    double complex *x; /* [n] */
} solver;

void arnoldi_free(arnoldi_result *r)
{
    free(r->theta);
    free(r->mode);
    free(r->residual);
    memset(r, 0, sizeof *r);
}

static void fill_start(solver *s, double x[])
{
    for (int i = 0; i < s->p->n; i++) {
        s->seed = s->seed * 6364136223846793005ull + 1442695040888963407ull;
        x[i] = (double)(s->seed >> 11) / 9007199254740992.0 - 0.5;
    }
}

/* Subtracts the component in the span of the basis from x. Returns the relative length of the
 * remainder. */
static double orthogonalise(const solver *s, double x[])
{
    const int n = s->p->n;
    const double before = sqrt(dense_dot(n, x, x));
    for (int twice = 0; twice < 2; twice++)
        for (int k = 0; k < s->count; k++) {
            const double *q = s->Q + (size_t)k * (size_t)n, part = dense_dot(n, q, x);
            for (int i = 0; i < n; i++)
                x[i] -= part * q[i];
        }
    return before > 0 ? sqrt(dense_dot(n, x, x)) / before : 0;
}

static void take(solver *s, double x[])
{
    const int n = s->p->n, k = s->count++;
    double *q = s->Q + (size_t)k * (size_t)n, *Tq = s->TQ + (size_t)k * (size_t)n;
    const double length = sqrt(dense_dot(n, x, x));
    for (int i = 0; i < n; i++)
        q[i] = x[i] / length;
    s->p->apply(s->p->context, q, Tq);
    for (int i = 0; i <= k; i++) {
        s->H[i * s->room + k] = dense_dot(n, s->Q + (size_t)i * (size_t)n, Tq);
        s->H[k * s->room + i] = dense_dot(n, q, s->TQ + (size_t)i * (size_t)n);
    }
}

/* Adds a vector of the current chain, or a new start vector if the chain has ended. */
static int grow(solver *s)
{
    const int n = s->p->n;
    if (s->count == s->room)
        return 0;
    if (s->chain) {
        memcpy(s->work, s->TQ + (size_t)(s->count - 1) * (size_t)n, (size_t)n * sizeof *s->work);
        s->chain = orthogonalise(s, s->work) > nothing;
    }
    if (!s->chain) {
        fill_start(s, s->work);
        if (!(orthogonalise(s, s->work) > nothing))
            return 0;
    }
    s->chain = 1;
    orthogonalise(s, s->work);
    take(s, s->work);
    return 1;
}

/* Makes Q the identity. */
static void span(solver *s)
{
    const int n = s->p->n;
    s->whole = 1;
    memset(s->Q, 0, (size_t)n * (size_t)n * sizeof *s->Q);
    for (int k = 0; k < n; k++) {
        double *q = s->Q + (size_t)k * (size_t)n, *Tq = s->TQ + (size_t)k * (size_t)n;
        q[k] = 1;
        s->p->apply(s->p->context, q, Tq);
        for (int i = 0; i < n; i++)
            s->H[i * s->room + k] = Tq[i];
    }
    s->count = n;
}

static double size_of(const solver *s, int i)
{
    return hypot(s->re[s->order[i]], s->im[s->order[i]]);
}

static void sort(solver *s)
{
    const int k = s->count;
    for (int i = 0; i < k; i++) {
        int at = i;
        const double size = hypot(s->re[i], s->im[i]);
        for (; at > 0 && size > size_of(s, at - 1); at--)
            s->order[at] = s->order[at - 1];
        s->order[at] = i;
    }
}

static int has_modes(const solver *s)
{
    return !(s->p->values_only && s->whole);
}

static status ritz(solver *s, fault *f)
{
    const int k = s->count;
    for (int j = 0; j < k; j++)
        for (int i = 0; i < k; i++)
            s->A[j * k + i] = s->H[i * s->room + j];
    numerics_work_add_dense(k);
    if (LAPACKE_dgeev(LAPACK_COL_MAJOR, s->left != NULL && s->whole ? 'V' : 'N',
                      has_modes(s) ? 'V' : 'N', k, s->A, k, s->re, s->im, s->left, k, s->z, k) != 0)
        return fault_set(
            f, STATUS_NOT_CONVERGED,
            "an eigenvalue problem of %d unknowns was not solved; use another number of elements",
            k);
    sort(s);
    s->found = 0;
    while (s->found < k && size_of(s, s->found) > 16 * k * DBL_EPSILON * size_of(s, 0))
        s->found++;
    if (s->found > s->p->wanted) {
        s->found = s->p->wanted;
        const int last = s->order[s->found - 1];
        if (s->im[last] > 0 && s->found < k && s->order[s->found] == last + 1)
            s->found++;
    }
    return STATUS_OK;
}

/* Returns component j of the eigenvector z of eigenvalue i in the basis. */
static double complex component(const solver *s, const double z[], int i, int j)
{
    const int at = s->order[i], second = s->im[at] < 0;
    const double *re = z + (size_t)(second ? at - 1 : at) * (size_t)s->count, *im = re + s->count;
    const double part = s->im[at] != 0 ? im[j] : 0;
    return re[j] + I * (second ? -part : part);
}

/* Stores the eigenvector of eigenvalue i in x, and returns its residual relative to the
 * eigenvalue. */
static double vector_of(const solver *s, int i, double complex x[])
{
    const int k = s->count, n = s->p->n, at = s->order[i];
    const double complex theta = s->re[at] + I * s->im[at];
    double residual = 0, length = 0;
    for (int row = 0; row < n; row++) {
        double complex value = s->whole ? component(s, s->z, i, row) : 0, image = 0;
        for (int j = 0; j < k; j++) {
            const double complex c = component(s, s->z, i, j);
            if (!s->whole)
                value += c * s->Q[(size_t)j * (size_t)n + (size_t)row];
            image += c * s->TQ[(size_t)j * (size_t)n + (size_t)row];
        }
        x[row] = value;
        image -= theta * value;
        length += creal(value) * creal(value) + cimag(value) * cimag(value);
        residual += creal(image) * creal(image) + cimag(image) * cimag(image);
    }
    return sqrt(residual / length) / cabs(theta);
}

static int converged(solver *s, double *worst)
{
    int good = 1;
    *worst = 0;
    for (int i = 0; i < s->found; i++) {
        const double residual = vector_of(s, i, s->x);
        *worst = fmax(*worst, residual);
        good &= residual <= good_residual + rounding_residual * size_of(s, 0) / size_of(s, i);
    }
    return good;
}

/* Returns 1 if the magnitude of a requested eigenvalue has changed since the last convergence. */
static int changed(solver *s)
{
    int different = 0;
    for (int i = 0; i < s->p->wanted; i++) {
        const double size = i < s->found ? size_of(s, i) : 0;
        different |= fabs(size - s->last[i]) > same * size;
        s->last[i] = size;
    }
    return different;
}

static status iterate(solver *s, int vectors, fault *f)
{
    for (double best = INFINITY, worst;; vectors = s->count / 3 > MORE ? s->count / 3 : MORE) {
        int grown = 0;
        while (grown < vectors && grow(s))
            grown++;
        TRY(ritz(s, f));
        if (converged(s, &worst) || grown == 0 || (worst > best / 2 && worst < stalled_residual))
            return worst <= acceptable_residual || s->count == s->p->n
                       ? STATUS_OK
                       : fault_set(
                             f, STATUS_NOT_CONVERGED,
                             "the unsymmetric eigenvalue problem did not converge: the residual is "
                             "%.1e with %d vectors; use fewer elements, or request fewer modes",
                             worst, s->count);
        best = fmin(best, worst);
    }
}

static status allocate_results(const solver *s, int modes, arnoldi_result *r, fault *f)
{
    const size_t n = (size_t)s->p->n, count = (size_t)s->found;
    r->theta = calloc(count + 1, sizeof *r->theta);
    r->mode = modes ? calloc(count * n + 1, sizeof *r->mode) : NULL;
    r->residual = calloc(count + 1, sizeof *r->residual);
    if (r->theta == NULL || (modes && r->mode == NULL) || r->residual == NULL)
        return fault_memory(f, "%d modes", s->found);
    r->count = s->found;
    for (int i = 0; i < s->found; i++)
        r->theta[i] = s->re[s->order[i]] + I * s->im[s->order[i]];
    return STATUS_OK;
}

/* Stores the eigenvectors of the transpose of T. */
static status store_left(const solver *s, fault *f)
{
    const size_t n = (size_t)s->p->n;
    arnoldi_result *r = s->p->left;
    TRY(allocate_results(s, 1, r, f));
    for (int i = 0; i < s->found; i++)
        for (int k = 0; k < s->p->n; k++)
            r->mode[(size_t)i * n + (size_t)k] = conj(component(s, s->left, i, k));
    return STATUS_OK;
}

static status store_results(solver *s, fault *f)
{
    arnoldi_result *r = s->out;
    TRY(allocate_results(s, has_modes(s), r, f));
    for (int i = 0; has_modes(s) && i < s->found; i++)
        r->residual[i] = vector_of(s, i, r->mode + (size_t)i * (size_t)s->p->n);
    return s->left != NULL && s->whole ? store_left(s, f) : STATUS_OK;
}

static status find(solver *s, fault *f)
{
    int vectors = FIRST + 2 * s->p->wanted;
    if (s->p->n <= vectors) {
        span(s);
        TRY(ritz(s, f));
        return store_results(s, f);
    }
    for (int start = 0; start < MAX_STARTS; start++) {
        s->chain = 0;
        TRY(iterate(s, vectors, f));
        const int news = changed(s);
        if (start > 0 && !news)
            return store_results(s, f);
        if (s->count == s->p->n)
            return store_results(s, f);
        vectors = MORE + s->p->wanted;
    }
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "modes may be missing, because start vector %d still yields new eigenvalues; "
                     "if the structure has many equal parts, make them slightly different",
                     MAX_STARTS);
}

static status allocate(solver *s, fault *f)
{
    const size_t n = (size_t)s->p->n, room = (size_t)s->room;
    s->Q = malloc((2 * room + 1) * n * sizeof *s->Q);
    s->H = calloc(4 * room * room + 2 * room + (size_t)s->p->wanted + 1, sizeof *s->H);
    s->order = calloc(room + 1, sizeof *s->order);
    s->x = calloc(n + 1, sizeof *s->x);
    if (s->Q == NULL || s->H == NULL || s->order == NULL || s->x == NULL)
        return fault_memory(f, "%d vectors", s->room);
    s->TQ = s->Q + room * n;
    s->work = s->TQ + room * n;
    s->A = s->H + room * room;
    s->z = s->A + room * room;
    s->left = s->p->left != NULL ? s->z + room * room : NULL;
    s->re = s->z + 2 * room * room;
    s->im = s->re + room;
    s->last = s->im + room;
    return STATUS_OK;
}

status arnoldi_solve(const arnoldi_problem *p, arnoldi_result *r, fault *f)
{
    solver s = {.p = p, .out = r, .seed = 0x9E3779B97F4A7C15ull};
    memset(r, 0, sizeof *r);
    s.room = p->n < MAX_VECTORS ? p->n : MAX_VECTORS;
    status outcome = STATUS_OK;
    if (p->n > 0 && p->wanted > 0) {
        outcome = allocate(&s, f);
        if (outcome == STATUS_OK)
            outcome = find(&s, f);
    }
    free(s.Q);
    free(s.H);
    free(s.order);
    free(s.x);
    return outcome;
}
