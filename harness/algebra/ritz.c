#include "harness/algebra/ritz.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

status ritz_alloc(ritz *r, int room, const subspace *b, fault *f)
{
    memset(r, 0, sizeof *r);
    r->room = room;
    r->lambda = calloc((size_t)room + 1, sizeof *r->lambda);
    r->c = calloc((size_t)room * (size_t)b->room + 1, sizeof *r->c);
    return r->lambda != NULL && r->c != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for %d modes", room);
}

void ritz_free(ritz *r)
{
    free(r->lambda);
    free(r->c);
}

static double complex *coefficients(const subspace *b, const ritz *r, int i)
{
    return r->c + (size_t)i * (size_t)b->room;
}

static void normalise(int k, double complex c[])
{
    double square = 0;
    for (int j = 0; j < k; j++)
        square += creal(c[j]) * creal(c[j]) + cimag(c[j]) * cimag(c[j]);
    for (int j = 0; j < k; j++)
        c[j] /= sqrt(square);
}

/* Q [k x k] and d [k] of the projected M = Q d Q^T into the matrix below. */
static void fill_hermitian(const subspace *b, const double *Q, const double d[], double complex H[])
{
    const int k = b->count, n = 2 * k, room = b->room;
    for (int j = 0; j < k; j++)
        for (int i = 0; i < k; i++) {
            H[(size_t)j * (size_t)n + (size_t)i] = -I * b->Gp[i * room + j];
            H[(size_t)(k + j) * (size_t)n + (size_t)i] = sqrt(fmax(0, d[j])) * Q[j * k + i];
        }
}

/* Upper triangle of [-i G, R^T; R, 0], column-major, with R = sqrt(d) Q^T of the projected M = Q d
 * Q^T. */
static int hermitian_matrix(const subspace *b, double complex H[])
{
    const int k = b->count, room = b->room;
    double *Q = malloc((size_t)k * (size_t)k * sizeof *Q), *d = malloc((size_t)k * sizeof *d);
    int info = -1;
    if (Q != NULL && d != NULL) {
        for (int i = 0; i < k; i++)
            for (int j = 0; j < k; j++)
                Q[i * k + j] = b->Mp[i * room + j];
        info = (int)LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', k, Q, k, d);
    }
    if (info == 0)
        fill_hermitian(b, Q, d, H);
    free(Q);
    free(d);
    return info;
}

/* The pairs of mu[found], ascending, but for infinite frequencies: nothing moves there that has a
 * mass. */
static void take_hermitian(const subspace *b, int found, const double mu[], const double complex *z,
                           ritz *r)
{
    const int k = b->count, n = 2 * k;
    for (int i = found - 1; i >= 0; i--) {
        if (!(mu[i] > 16 * n * DBL_EPSILON * mu[found - 1]))
            break;
        r->lambda[r->count] = I / mu[i];
        memcpy(coefficients(b, r, r->count), z + (size_t)i * (size_t)n, (size_t)k * sizeof *z);
        normalise(k, coefficients(b, r, r->count++));
    }
}

status ritz_hermitian(const subspace *b, ritz *r, fault *f)
{
    const int k = b->count, n = 2 * k, most = r->room < n ? r->room : n;
    double complex *H = calloc((size_t)n * (size_t)n, sizeof *H),
                   *z = calloc((size_t)n * (size_t)most, sizeof *z);
    double *mu = calloc((size_t)n, sizeof *mu);
    lapack_int *support = calloc(2 * (size_t)n, sizeof *support), found = 0;
    int info =
        H != NULL && z != NULL && mu != NULL && support != NULL ? hermitian_matrix(b, H) : -1;
    if (info == 0)
        info = (int)LAPACKE_zheevr(LAPACK_COL_MAJOR, 'V', 'I', 'U', n, H, n, 0, 0, n - most + 1, n,
                                   0, &found, mu, z, n, support);
    r->count = 0;
    r->size = k;
    if (info == 0)
        take_hermitian(b, (int)found, mu, z, r);
    free(H);
    free(z);
    free(mu);
    free(support);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "a Hermitian eigenvalue problem of %d unknowns fails", n);
}

static int is_first_of_its_kind(double complex lambda)
{
    const double tiny = ritz_imaginary * cabs(lambda);
    return cimag(lambda) > tiny ? creal(lambda) >= -tiny
                                : cimag(lambda) >= -tiny && creal(lambda) > 0;
}

/* Puts a pair where its size belongs. */
static void insert(const subspace *b, ritz *r, double complex lambda, const double complex c[])
{
    int at = r->count;
    while (at > 0 && cabs(r->lambda[at - 1]) > cabs(lambda))
        at--;
    if (at >= r->room)
        return;
    r->count += r->count < r->room;
    for (int i = r->count - 1; i > at; i--) {
        r->lambda[i] = r->lambda[i - 1];
        memcpy(coefficients(b, r, i), coefficients(b, r, i - 1), (size_t)b->room * sizeof *c);
    }
    r->lambda[at] = lambda;
    memcpy(coefficients(b, r, at), c, (size_t)b->count * sizeof *c);
    normalise(b->count, coefficients(b, r, at));
}

/* nu [Kp, 0; 0, 1] z = [-Gp, -Mp; 1, 0] z with nu = 1/lambda, z = (nu x, x) and Kp = 1 - shift Mp;
 * column-major. */
static void general_matrices(const subspace *b, double shift, double A[], double B[])
{
    const int k = b->count, n = 2 * k, room = b->room;
    for (int i = 0; i < k; i++)
        for (int j = 0; j < k; j++) {
            A[j * n + i] = -b->Gp[i * room + j];
            A[(k + j) * n + i] = -b->Mp[i * room + j];
            B[j * n + i] = (i == j) - shift * b->Mp[i * room + j];
        }
    for (int i = 0; i < k; i++)
        A[i * n + k + i] = B[(k + i) * n + k + i] = 1;
}

/* The first of each pair of the conjugate eigenvalues beta/(re + i im) [n], whose columns hold the
 * real and the imaginary part; c[k] is work space. */
static void take_general(const subspace *b, const double re[], const double im[],
                         const double beta[], const double *z, double complex c[], ritz *r)
{
    const int k = b->count, n = 2 * k;
    for (int i = 0; i < n; i++) {
        const double complex lambda = beta[i] / (re[i] + I * im[i]);
        const int second = im[i] < 0;
        const double complex imaginary = second ? -I : I;
        const double *column = z + (size_t)(second ? i - 1 : i) * (size_t)n + k;
        if (!isfinite(cabs(lambda)) || !is_first_of_its_kind(lambda))
            continue;
        for (int j = 0; j < k; j++)
            c[j] = column[j] + (im[i] != 0 ? imaginary * column[n + j] : 0);
        insert(b, r, lambda, c);
    }
}

status ritz_general(const subspace *b, double shift, ritz *r, fault *f)
{
    const int k = b->count, n = 2 * k;
    const size_t square = (size_t)n * (size_t)n;
    double *A = calloc(3 * square + 3 * (size_t)n + 1, sizeof *A), *B = A + square, *z = B + square;
    double *re = z + square, *im = re + n, *beta = im + n;
    double complex *c = calloc((size_t)k + 1, sizeof *c);
    int info = -1;
    if (A != NULL && c != NULL) {
        general_matrices(b, shift, A, B);
        info = (int)LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'V', n, A, n, B, n, re, im, beta, NULL, n,
                                  z, n);
    }
    r->count = 0;
    r->size = k;
    if (info == 0)
        take_general(b, re, im, beta, z, c, r);
    free(A);
    free(c);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "an eigenvalue problem of %d unknowns fails", n);
}
