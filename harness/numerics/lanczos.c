/* Lanczos method with full reorthogonalisation and thick restarts (K. Wu, H. Simon, SIAM J. Matrix
 * Anal. Appl. 22 (2000) 602-616) for C = R^-1 s A R^-T with K = R R^T. If C v = mu v, then x = R^-T
 * v satisfies s A x = mu K x. Orthonormal vectors v are K-orthonormal vectors x, so no products
 * with K are needed. */
#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "elements/math/real.h"

enum { MAX_RESTARTS = 300, FIRST_CHECK = 4, FURTHEST_CHECK = 8 };
enum {
    BEYOND = 30,
    FEW_BEYOND = 12
}; /* the basis has up to BEYOND vectors more than twice the requested number; eigenvalues that are
    * not seen with FEW_BEYOND vectors more than requested count as absent */

/* Tolerance for the error of a vector. The error of its Rayleigh quotient is the square of this
 * value. */
static const double tolerance = 1e-10;
/* Tolerance for spare values, which must be in the right order, and ratio to the last value that is
 * not spare below which a value can be spare. */
static const double rough = 1e-3, distinct = 0.99;

typedef struct lanczos {
    const lanczos_problem *p;
    int n, wanted, found;
    int most, size, kept; /* largest, present and initial number of columns of T */
    double scale;         /* largest magnitude of an eigenvalue */
    /* the orthonormal vectors V: the known eigenvectors, then [most + 1] vectors */
    double *known, *basis;
    double *T; /* [most x most] V^T C V, upper triangle, column-major */
    /* [most x most], [most] eigenvectors of T, and its eigenvalues in ascending order */
    double *vector, *value;
    double *last;              /* [most] last component of each eigenvector */
    double *part;              /* [known + most + 1] */
    double beyond;             /* length of the component of C V outside V */
    unsigned long long random; /* state of the random numbers */
} lanczos;

static double *column(const lanczos *l, int i)
{
    return l->basis + (size_t)i * (size_t)l->n;
}

static status lanczos_alloc(const lanczos_problem *p, int wanted, lanczos *l, fault *f)
{
    const int n = p->K->n, room = n - p->known, most = 2 * wanted + BEYOND;
    *l = (lanczos){
        .p = p, .n = n, .wanted = wanted, .most = most < room ? most : room, .scale = p->scale};
    l->random = 0x9E3779B97F4A7C15ull;
    const size_t columns = (size_t)l->most, known = (size_t)p->known;
    l->known = malloc((known + columns + 1) * (size_t)n * sizeof *l->known);
    l->T = calloc(2 * columns * columns + 3 * columns + known + 1, sizeof *l->T);
    if (l->known == NULL || l->T == NULL)
        return fault_memory(f, "%zu vectors of %d unknowns", columns, n);
    l->basis = l->known + known * (size_t)n;
    l->vector = l->T + columns * columns;
    l->value = l->vector + columns * columns;
    l->last = l->value + columns;
    l->part = l->last + columns;
    return STATUS_OK;
}

static void lanczos_free(lanczos *l)
{
    free(l->known);
    free(l->T);
}

static double norm(int n, const double x[])
{
    double square;
    REAL_CHOSEN(basis_measure)(n, 1, x, x, &square);
    return sqrt(square);
}

/* Makes a vector orthogonal to the known vectors and to the first `count` vectors of the basis.
 * Returns its length. A second pass is needed only if the first one has cancelled digits. */
static double orthogonalise(lanczos *l, int count, double w[])
{
    const double cancelled = 0.7;
    double before = norm(l->n, w), after = before;
    for (int pass = 0; pass < 3; pass++) {
        REAL_CHOSEN(basis_measure)(l->n, l->p->known + count, l->known, w, l->part);
        REAL_CHOSEN(basis_subtract)(l->n, l->p->known + count, l->known, l->part, w);
        after = norm(l->n, w);
        if (after > cancelled * before)
            break;
        before = after;
    }
    return after;
}

static void divide(int n, double by, double x[])
{
    for (int i = 0; i < n; i++)
        x[i] /= by;
}

/* Sets column i of the basis to a random vector that is orthogonal to the previous columns. */
static void start(lanczos *l, int i)
{
    double *v = column(l, i);
    for (int k = 0; k < l->n; k++) {
        l->random = l->random * 6364136223846793005ull + 1442695040888963407ull;
        v[k] = (double)(l->random >> 11) / 9007199254740992.0 - 0.5;
    }
    divide(l->n, norm(l->n, v), v);
    divide(l->n, orthogonalise(l, i, v), v);
}

static void apply(lanczos *l, const double v[], double x[], double w[])
{
    memcpy(x, v, (size_t)l->n * sizeof *x);
    factor_solve_root(l->p->K_factor, TRIANGULAR_ROOT_TRANSPOSED, 1, l->n, x);
    sparse_mul(l->p->A, x, w);
    for (int k = 0; k < l->n; k++)
        w[k] *= l->p->sign;
    factor_solve_root(l->p->K_factor, TRIANGULAR_ROOT, 1, l->n, w);
}

/* Adds a column to T and a vector to the basis. x: [n] work space. */
static void extend(lanczos *l, double x[])
{
    const int j = l->size, first = j == l->kept ? 0 : j - 1;
    double *T = l->T + (size_t)j * (size_t)l->most, *w = column(l, j + 1);
    apply(l, column(l, j), x, w);
    const double whole = norm(l->n, w);
    REAL_CHOSEN(basis_subtract)(l->n, j - first, column(l, first), T + first, w);
    REAL_CHOSEN(basis_measure)(l->n, 1, column(l, j), w, T + j);
    REAL_CHOSEN(basis_subtract)(l->n, 1, column(l, j), T + j, w);
    l->beyond = orthogonalise(l, j + 1, w);
    l->size++;
    const int all = l->size == l->n - l->p->known;
    if (all || l->beyond <= l->n * DBL_EPSILON * whole)
        l->beyond = 0;
    if (l->size < l->most)
        T[l->most + j] = l->beyond;
    if (l->beyond > 0)
        divide(l->n, l->beyond, w);
    else if (!all)
        start(l, l->size);
}

/* Computes the eigenvalues d[n] of a tridiagonal matrix with the diagonal d and with e[i] between i
 * and i + 1, and the first components z[n] of their eigenvectors, by the implicit QL method. The
 * largest entries must be those with the largest indices. Returns 0 if it does not converge. */
static int tridiagonal(int n, double d[], double e[], double z[])
{
    enum { MOST_TURNS = 50 };
    e[n - 1] = 0;
    for (int i = 0; i < n; i++)
        z[i] = i == 0;
    for (int l = 0, turns = 0; l < n;) {
        int m = l;
        while (m + 1 < n && fabs(e[m]) > DBL_EPSILON / 2 * (fabs(d[m]) + fabs(d[m + 1])))
            m++;
        if (m == l) {
            l++;
            turns = 0;
            continue;
        }
        if (turns++ == MOST_TURNS)
            return 0;
        const double half = (d[l + 1] - d[l]) / (2 * e[l]);
        double g = d[m] - d[l] + e[l] / (half + copysign(sqrt(half * half + 1), half)), s = 1,
               c = 1, shift = 0;
        int i = m - 1;
        for (; i >= l; i--) {
            const double f = s * e[i], b = c * e[i], r = sqrt(f * f + g * g), before = z[i + 1];
            e[i + 1] = r;
            if (r == 0)
                break;
            s = f / r;
            c = g / r;
            g = d[i + 1] - shift;
            const double turned = (d[i] - g) * s + 2 * c * b;
            shift = s * turned;
            d[i + 1] = g + shift;
            g = c * turned - b;
            z[i + 1] = s * z[i] + c * before;
            z[i] = c * z[i] - s * before;
        }
        if (i >= l) {
            d[i + 1] -= shift;
        } else {
            d[l] -= shift;
            e[l] = g;
        }
        e[m] = 0;
    }
    return 1;
}

/* Computes the eigenvalues of T in ascending order, and the last components of their eigenvectors.
 * T is tridiagonal. */
static int find_values(lanczos *l)
{
    const size_t size = (size_t)l->size;
    double *d = l->value, *e = l->part, *z = l->last;
    double scale = 0;
    for (size_t j = 0; j < size; j++) {
        const double *T = l->T + (size - 1 - j) * (size_t)l->most + (size - 1 - j);
        d[j] = *T;
        e[j] = j + 1 < size ? T[-1] : 0;
        scale = fmax(scale, fmax(fabs(d[j]), fabs(e[j])));
    }
    for (size_t j = 0; j < size && scale > 0; j++) {
        d[j] /= scale;
        e[j] /= scale;
    }
    if (!tridiagonal(l->size, d, e, z))
        return 0;
    for (size_t j = 0; j < size; j++) {
        const double value = d[j] * scale, part = z[j];
        size_t k = j;
        for (; k > 0 && d[k - 1] > value; k--) {
            d[k] = d[k - 1];
            z[k] = z[k - 1];
        }
        d[k] = value;
        z[k] = part;
    }
    return 1;
}

static status find_vectors(lanczos *l, fault *f)
{
    const size_t size = (size_t)l->size;
    for (size_t j = 0; j < size; j++)
        memcpy(l->vector + j * size, l->T + j * (size_t)l->most, (j + 1) * sizeof *l->T);
    const int info =
        LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', l->size, l->vector, l->size, l->value);
    for (size_t j = 0; info == 0 && j < size; j++)
        l->last[j] = l->vector[j * size + size - 1];
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "an eigenvalue problem of %d unknowns was not solved (LAPACK "
                                 "returned %d); use another number of elements",
                                 l->size, info);
}

/* Returns Ritz value i in descending order, and sets *residual to the length of its residual, or to
 * 0 if this length is a rounding error. */
static double ritz_value(const lanczos *l, int i, double *residual)
{
    const double last = fabs(l->last[l->size - 1 - i]);
    *residual = last <= l->size * DBL_EPSILON ? 0 : l->beyond * last;
    return l->value[l->size - 1 - i];
}

/* Sets l->found to the number of values that have converged before the first one that has not.
 * Returns the largest residual of the values that are still needed, relative to its limit; at most
 * 1: the iteration is complete. */
static double evaluate(lanczos *l)
{
    const lanczos_problem *p = l->p;
    const int enough = l->wanted + FEW_BEYOND,
              most_seen = l->size >= enough || l->size == l->n - p->known;
    double excess = 0, last = INFINITY;
    l->scale = fmax(l->scale, fmax(fabs(l->value[0]), fabs(l->value[l->size - 1])));
    l->found = 0;
    for (int i = 0; i < l->wanted; i++) {
        double residual = INFINITY;
        const double mu = i < l->size ? ritz_value(l, i, &residual) : 0;
        if (!(mu > p->least * l->scale))
            return most_seen && !p->certain ? excess : INFINITY;
        const int spare = i >= l->wanted - p->spare && mu < distinct * last;
        excess = fmax(excess, residual / ((spare ? rough : tolerance) * mu));
        l->found += excess <= 1;
        last = spare ? last : mu;
    }
    return excess;
}

/* Replaces a set of vectors V by V S, where the columns of S are the eigenvectors of T of the
 * largest `count` eigenvalues, in descending order. */
static void combine(lanczos *l, int first, int count, double out[])
{
    const size_t n = (size_t)l->n, size = (size_t)l->size;
    for (int i = 0; i < count; i++, out += n) {
        const double *s = l->vector + (size - 1 - (size_t)(first + i)) * size;
        for (size_t k = 0; k < size; k++)
            l->part[k] = -s[k];
        memset(out, 0, n * sizeof *out);
        REAL_CHOSEN(basis_subtract)(l->n, l->size, l->basis, l->part, out);
    }
}

/* Continues with the best half of the space and with the component of C V outside V. */
static status restart(lanczos *l, fault *f)
{
    const size_t n = (size_t)l->n, most = (size_t)l->most;
    const int kept = (l->wanted + l->most) / 2;
    double *V = malloc((size_t)kept * n * sizeof *V), *T = l->T + (size_t)kept * most;
    if (V == NULL)
        return fault_memory(f, "%d vectors of %d unknowns", kept, l->n);
    combine(l, 0, kept, V);
    memcpy(l->basis, V, (size_t)kept * n * sizeof *V);
    memcpy(column(l, kept), column(l, l->size), n * sizeof *V);
    free(V);
    memset(l->T, 0, most * most * sizeof *T);
    for (int i = 0; i < kept; i++) {
        const size_t k = (size_t)(l->size - 1 - i);
        l->T[(size_t)i * (most + 1)] = l->value[k];
        T[i] = l->beyond * l->last[k];
    }
    l->size = l->kept = kept;
    return STATUS_OK;
}

/* Returns the number of columns after which convergence is checked again, from the decrease of the
 * logarithm of `excess` in the last steps. */
static int steps_to_check(double before, double excess, int steps)
{
    const double fall = log(before / excess) / steps,
                 left = fall > 0 ? log(excess) / fall : INFINITY;
    return isfinite(before) && left < FURTHEST_CHECK ? (int)ceil(left) : FIRST_CHECK;
}

static status iterate(lanczos *l, double x[], fault *f)
{
    start(l, 0);
    for (int restarts = 0;; restarts++) {
        int checked = l->size, next = l->wanted + FIRST_CHECK;
        double before = INFINITY;
        while (l->size < l->most) {
            extend(l, x);
            if (l->size < next && l->size < l->most)
                continue;
            const int is_tridiagonal = l->kept == 0 && l->size < l->most;
            if (!is_tridiagonal || !find_values(l))
                TRY(find_vectors(l, f));
            const double excess = evaluate(l);
            if (excess <= 1)
                return is_tridiagonal ? find_vectors(l, f) : STATUS_OK;
            next = l->size + steps_to_check(before, excess, l->size - checked);
            before = excess;
            checked = l->size;
        }
        if (restarts == MAX_RESTARTS || l->most == l->n - l->p->known)
            break;
        TRY(restart(l, f));
    }
    return l->found > 0 ? STATUS_OK
                        : fault_set(f, STATUS_NOT_CONVERGED,
                                    "none of %d eigenvalues was found; use another number of "
                                    "elements",
                                    l->wanted);
}

/* Computes the vectors (*x)[count x n] of eigenvalues first, first + 1, ... in descending order. */
static status take_vectors(lanczos *l, int first, int count, double **x, fault *f)
{
    *x = malloc((size_t)count * (size_t)l->n * sizeof **x);
    if (*x == NULL)
        return fault_memory(f, "%d vectors of %d unknowns", count, l->n);
    combine(l, first, count, *x);
    factor_solve_root(l->p->K_factor, TRIANGULAR_ROOT_TRANSPOSED, count, l->n, *x);
    return STATUS_OK;
}

static status solve(lanczos *l, double **x, fault *f)
{
    const size_t known = (size_t)l->p->known * (size_t)l->n;
    double *work = malloc((size_t)l->n * sizeof *work);
    if (work == NULL)
        return fault_memory(f, "a vector of %d unknowns", l->n);
    memcpy(l->known, l->p->KX, known * sizeof *work);
    factor_solve_root(l->p->K_factor, TRIANGULAR_ROOT, l->p->known, l->n, l->known);
    const status outcome = iterate(l, work, f);
    free(work);
    TRY(outcome);
    if (l->found > 0)
        return take_vectors(l, 0, l->found, x, f);
    const int negative = fabs(l->value[0]) > fabs(l->value[l->size - 1]);
    return take_vectors(l, negative ? l->size - 1 : 0, 1, x, f);
}

status lanczos_largest(const lanczos_problem *p, int wanted, lanczos_result *r, fault *f)
{
    lanczos l;
    *r = (lanczos_result){0};
    status outcome = lanczos_alloc(p, wanted, &l, f);
    if (outcome == STATUS_OK)
        outcome = solve(&l, &r->x, f);
    r->found = l.found;
    r->scale = l.scale;
    lanczos_free(&l);
    return outcome;
}

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_wall_seconds(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double clock_processor_seconds(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}
