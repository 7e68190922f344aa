/* Eigenvalues of a projection on several Krylov spaces. Every space is a chain of orthonormal
 * vectors: T times a vector is a combination of the vectors up to the next one. T times the last
 * vector of a chain has a rest outside the basis; these rests determine the residuals. */
#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/real.h"

enum { FIRST = 16, MORE = 12, MAX_STARTS = 5, MAX_VECTORS = 400 };

/* Limits of a residual relative to its eigenvalue. rounding_residual is relative to the largest
 * eigenvalue, whose rounding error affects all eigenvalues. */
static const double good_residual = 1e-12, rounding_residual = 1e-14, stalled_residual = 1e-8,
                    acceptable_residual = 1e-5;
/* Limit of the residual of a real eigenvalue that need not be accurate, and its ratio to the square
 * of the relative distance to the nearest other one. Two real eigenvalues with this distance d can
 * be a perturbed complex pair only if the perturbation, which is the residual, is of the order
 * d^2/4. */
static const double rough_residual = 1e-7, rough_part = 1e-4;
/* Eigenvalues with a smaller relative difference count as equal. */
static const double same = 1e-6;
/* An orthogonalised vector counts as zero if its remainder, relative to its former length, is not
 * above this limit. */
static const double nothing = 1e-14;

typedef struct solver {
    const arnoldi_problem *p;
    arnoldi_result *out;
    /* room: capacity; count: number of vectors; chain 1: the current chain can be continued */
    int room, count, chain;
    int ends, last_of[MAX_STARTS]; /* number of ended chains; index of the last vector of a chain */
    double *Q;                     /* [room x n] basis */
    double *rest;  /* [MAX_STARTS x n] rests of the ended chains and of the current chain */
    double length; /* of the rest of the current chain */
    double *work;  /* [2 x n] */
    double *H;     /* [room x room] Q^T T Q, column-major */
    int whole;     /* 1: the basis is the identity, which Q does not contain */
    double *part, *A, *z, *left, *re, *im; /* left: NULL if left vectors are not requested */
    int *order;
    unsigned long long seed;
    int found;
    double *last;
    double *residual;  /* [room] */
    double complex *x; /* [room] */
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

static double norm(int n, const double x[])
{
    double square;
    REAL_CHOSEN(basis_measure)(n, 1, x, x, &square);
    return sqrt(square);
}

/* Subtracts the component in the span of the basis from x, and stores its coefficients in h[room].
 * A further pass is needed only if the last one has cancelled digits. Returns the relative length
 * of the remainder. */
static double orthogonalise(solver *s, double x[], double h[])
{
    const int n = s->p->n;
    const double first = norm(n, x), cancelled = 0.5;
    double before = first;
    memset(h, 0, (size_t)s->room * sizeof *h);
    for (;;) {
        REAL_CHOSEN(basis_measure)(n, s->count, s->Q, x, s->part);
        REAL_CHOSEN(basis_subtract)(n, s->count, s->Q, s->part, x);
        for (int k = 0; k < s->count; k++)
            h[k] += s->part[k];
        s->length = norm(n, x);
        if (!(s->length <= cancelled * before && s->length > nothing * first))
            return first > 0 ? s->length / first : 0;
        before = s->length;
    }
}

/* Returns the rest of an ended chain or, for end = s->ends, of the current chain. */
static double *rest_of(const solver *s, int end)
{
    return s->rest + (size_t)end * (size_t)s->p->n;
}

/* Adds a vector of the current chain, or a new start vector if the chain has ended. */
static int grow(solver *s)
{
    const int n = s->p->n, k = s->count;
    const size_t room = (size_t)s->room;
    double *q = s->Q + (size_t)k * (size_t)n, *rest = rest_of(s, s->ends);
    if (k == s->room)
        return 0;
    if (s->chain) {
        memcpy(q, rest, (size_t)n * sizeof *q);
        s->H[(size_t)(k - 1) * room + (size_t)k] = s->length;
    } else {
        fill_start(s, q);
        if (!(orthogonalise(s, q, s->H + (size_t)k * room) > nothing))
            return 0;
    }
    for (int i = 0; i < n; i++)
        q[i] /= s->length;
    for (int e = 0; e < s->ends; e++) {
        double *part = s->H + (size_t)s->last_of[e] * room + (size_t)k;
        REAL_CHOSEN(basis_measure)(n, 1, q, rest_of(s, e), part);
        REAL_CHOSEN(basis_subtract)(n, 1, q, part, rest_of(s, e));
    }
    s->last_of[s->ends] = s->count++;
    s->p->apply(s->p->context, q, rest);
    s->chain = orthogonalise(s, rest, s->H + (size_t)k * room) > nothing;
    return 1;
}

/* Makes the basis the identity. */
static void span(solver *s)
{
    const int n = s->p->n;
    s->whole = 1;
    for (int k = 0; k < n; k++) {
        memset(s->rest, 0, (size_t)n * sizeof *s->rest);
        s->rest[k] = 1;
        s->p->apply(s->p->context, s->rest, s->H + (size_t)k * (size_t)s->room);
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

static status find_pairs(solver *s, fault *f)
{
    const int k = s->count;
    for (int j = 0; j < k; j++)
        memcpy(s->A + (size_t)j * (size_t)k, s->H + (size_t)j * (size_t)s->room,
               (size_t)k * sizeof *s->A);
    numerics_work_add_dense(k);
    if (LAPACKE_dgeev(LAPACK_COL_MAJOR, s->left != NULL && s->whole ? 'V' : 'N',
                      s->p->values_only && s->whole ? 'N' : 'V', k, s->A, k, s->re, s->im, s->left,
                      k, s->z, k) != 0)
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

/* Stores the inner products of the rests of all chains. */
static void measure_rests(const solver *s, int chains, double product[])
{
    for (int e = 0; e < chains; e++)
        REAL_CHOSEN(basis_measure)(s->p->n, chains, s->rest, rest_of(s, e), product + e * chains);
}

/* Returns |T x - theta x|/|theta| for eigenvector x = Q z of length 1: (H - theta) z within the
 * basis and, outside, the sum of the rests times the components of z. */
static double residual_of(const solver *s, int i, int chains, const double product[])
{
    const int k = s->count, at = s->order[i];
    const double complex theta = s->re[at] + I * s->im[at];
    double sum = 0;
    for (int row = 0; row < k; row++)
        s->x[row] = -theta * component(s, s->z, i, row);
    for (int j = 0; j < k; j++) {
        const double complex c = component(s, s->z, i, j);
        for (int row = 0; row < k; row++)
            s->x[row] += c * s->H[(size_t)j * (size_t)s->room + (size_t)row];
    }
    for (int row = 0; row < k; row++)
        sum += creal(s->x[row] * conj(s->x[row]));
    for (int e = 0; e < chains; e++)
        for (int f = 0; f < chains; f++)
            sum += creal(component(s, s->z, i, s->last_of[e]) *
                         conj(component(s, s->z, i, s->last_of[f]))) *
                   product[e * chains + f];
    return sqrt(fmax(sum, 0)) / cabs(theta);
}

static void find_residuals(const solver *s)
{
    double product[MAX_STARTS * MAX_STARTS];
    const int chains = s->ends + s->chain;
    measure_rests(s, chains, product);
    for (int i = 0; i < s->found; i++)
        s->residual[i] = residual_of(s, i, chains, product);
}

static double residual_limit(const solver *s, int i)
{
    const double strict = good_residual + rounding_residual * size_of(s, 0) / size_of(s, i);
    const int at = s->order[i];
    double nearest = INFINITY;
    if (!s->p->rough || s->im[at] != 0)
        return strict;
    for (int j = 0; j < s->count; j++)
        if (j != at)
            nearest = fmin(nearest, hypot(s->re[j] - s->re[at], s->im[j]) / size_of(s, i));
    return fmax(strict, fmin(rough_residual, rough_part * nearest * nearest));
}

static int converged(solver *s, double *worst)
{
    int good = 1;
    find_residuals(s);
    *worst = 0;
    for (int i = 0; i < s->found; i++) {
        *worst = fmax(*worst, s->residual[i]);
        good &= s->residual[i] <= residual_limit(s, i);
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
        TRY(find_pairs(s, f));
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
    r->next = s->found < s->count ? size_of(s, s->found) : 0;
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

/* Stores the eigenvector of eigenvalue i in x[n], with the work space re[n], im[n]. */
static void vector_of(const solver *s, int i, double re[], double im[], double complex x[])
{
    const int n = s->p->n, k = s->count;
    double *parts[] = {re, im};
    for (int imaginary = 0; imaginary < 2; imaginary++) {
        for (int j = 0; j < k; j++) {
            const double complex c = component(s, s->z, i, j);
            s->part[j] = imaginary ? -cimag(c) : -creal(c);
        }
        memset(parts[imaginary], 0, (size_t)n * sizeof *re);
        REAL_CHOSEN(basis_subtract)(n, k, s->Q, s->part, parts[imaginary]);
    }
    for (int row = 0; row < n; row++)
        x[row] = re[row] + I * im[row];
}

static status store_results(solver *s, fault *f)
{
    arnoldi_result *r = s->out;
    const size_t n = (size_t)s->p->n;
    TRY(allocate_results(s, !s->p->values_only, r, f));
    if (s->p->values_only)
        return STATUS_OK;
    if (s->whole)
        find_residuals(s);
    memcpy(r->residual, s->residual, (size_t)s->found * sizeof *r->residual);
    for (int i = 0; i < s->found; i++) {
        double complex *x = r->mode + (size_t)i * n;
        for (size_t row = 0; s->whole && row < n; row++)
            x[row] = component(s, s->z, i, (int)row);
        if (!s->whole)
            vector_of(s, i, s->work, s->work + n, x);
    }
    return s->left != NULL && s->whole ? store_left(s, f) : STATUS_OK;
}

static status find(solver *s, fault *f)
{
    const int wanted = s->p->wanted, rough = s->p->rough;
    int vectors = FIRST + (rough ? wanted / 2 : wanted);
    if (s->p->n <= FIRST + 2 * wanted) {
        span(s);
        TRY(find_pairs(s, f));
        return store_results(s, f);
    }
    for (int start = 0; start < MAX_STARTS; start++) {
        s->ends += s->chain;
        s->chain = 0;
        TRY(iterate(s, vectors, f));
        const int news = changed(s);
        if (start > 0 && !news)
            return store_results(s, f);
        if (s->count == s->p->n)
            return store_results(s, f);
        vectors = MORE + (rough ? 0 : wanted / 2);
    }
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "modes may be missing, because start vector %d still yields new eigenvalues; "
                     "if the structure has many equal parts, make them slightly different",
                     MAX_STARTS);
}

static status allocate(solver *s, fault *f)
{
    const size_t n = (size_t)s->p->n, room = (size_t)s->room;
    s->Q = malloc((room + MAX_STARTS + 2) * n * sizeof *s->Q);
    s->H = malloc((4 * room * room + 4 * room + (size_t)s->p->wanted + 1) * sizeof *s->H);
    s->order = calloc(room + 1, sizeof *s->order);
    s->x = calloc(room + 1, sizeof *s->x);
    if (s->Q == NULL || s->H == NULL || s->order == NULL || s->x == NULL)
        return fault_memory(f, "%d vectors", s->room);
    s->rest = s->Q + room * n;
    s->work = s->rest + MAX_STARTS * n;
    s->A = s->H + room * room;
    s->z = s->A + room * room;
    s->left = s->p->left != NULL ? s->z + room * room : NULL;
    s->re = s->z + 2 * room * room;
    s->im = s->re + room;
    s->part = s->im + room;
    s->residual = s->part + room;
    s->last = s->residual + room;
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
