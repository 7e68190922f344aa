#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Eigenvalues of a projected mass matrix count as zero below this number times the largest
 * eigenvalue and the size. */
static const double no_mass = 8 * DBL_EPSILON;

status ritz_alloc(ritz *r, int room, const subspace *b, fault *f)
{
    memset(r, 0, sizeof *r);
    r->room = room;
    r->lambda = calloc((size_t)room + 1, sizeof *r->lambda);
    r->c = calloc((size_t)room * (size_t)b->room + 1, sizeof *r->c);
    r->left = calloc((size_t)room * (size_t)b->room + 1, sizeof *r->left);
    return r->lambda != NULL && r->c != NULL && r->left != NULL ? STATUS_OK
                                                                : fault_memory(f, "%d modes", room);
}

void ritz_free(ritz *r)
{
    free(r->lambda);
    free(r->c);
    free(r->left);
}

static double complex *coefficients(const subspace *b, const ritz *r, int i)
{
    return r->c + (size_t)i * (size_t)b->room;
}

static double complex *left_coefficients(const subspace *b, const ritz *r, int i)
{
    return r->left + (size_t)i * (size_t)b->room;
}

enum { RITZ_BEHIND = 8 };

static void normalise(int k, double complex c[])
{
    double square = 0;
    for (int j = 0; j < k; j++)
        square += creal(c[j]) * creal(c[j]) + cimag(c[j]) * cimag(c[j]);
    for (int j = 0; j < k; j++)
        c[j] /= sqrt(square);
}

/* Computes R[k x k], row-major, with R^T R equal to the projected M. A row is zero if its part
 * of M is only a rounding error of the largest eigenvalue of M. Returns 0, or another value if
 * it fails. */
static int root_of_mass(const subspace *b, double R[])
{
    const int k = b->count;
    double *d = calloc((size_t)k + 1, sizeof *d);
    int info = -1;
    if (d != NULL) {
        for (int i = 0; i < k; i++)
            for (int j = 0; j < k; j++)
                R[i * k + j] = b->Mp[i * b->room + j];
        numerics_work_add_dense(k);
        info = (int)LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', k, R, k, d);
    }
    for (int j = 0; info == 0 && j < k; j++)
        for (int i = 0; i < k; i++)
            R[j * k + i] *= d[j] > no_mass * k * d[k - 1] ? sqrt(d[j]) : 0;
    free(d);
    return info;
}

/* Fills the upper triangle of [-i G, R^T; R, 0], column-major. */
static void hermitian_matrix(const subspace *b, const double R[], double complex H[])
{
    const int k = b->count, n = 2 * k, room = b->room;
    for (int j = 0; j < k; j++)
        for (int i = 0; i < k; i++) {
            H[(size_t)j * (size_t)n + (size_t)i] = -I * b->Gp[i * room + j];
            H[(size_t)(k + j) * (size_t)n + (size_t)i] = R[j * k + i];
        }
}

static void take_hermitian(const subspace *b, int found, const double mu[], const double complex *z,
                           ritz *r)
{
    const int k = b->count, n = 2 * k;
    for (int i = found - 1; i >= 0; i--) {
        if (!(mu[i] > 16 * n * DBL_EPSILON * mu[found - 1]))
            break;
        r->lambda[r->count] = I / mu[i];
        memcpy(coefficients(b, r, r->count), z + (size_t)i * (size_t)n, (size_t)k * sizeof *z);
        normalise(k, coefficients(b, r, r->count));
        memcpy(left_coefficients(b, r, r->count), coefficients(b, r, r->count),
               (size_t)k * sizeof *z);
        r->count++;
    }
}

/* Computes the largest `most` eigenvalues mu, in ascending order, and their vectors z. zgemv of
 * some OpenBLAS versions (0.3.21, Haswell) reads a few columns past the end of its matrices. H and
 * the work array are allocated with additional columns for this reason. */
static int largest_eigenvalues(int n, int most, double complex H[], double mu[], double complex z[],
                               lapack_int support[], lapack_int *found)
{
    double complex size = 0;
    double real_size = 0;
    lapack_int whole_size = 0;
    int info = (int)LAPACKE_zheevr_work(LAPACK_COL_MAJOR, 'V', 'I', 'U', n, H, n, 0, 0,
                                        n - most + 1, n, 0, found, mu, z, n, support, &size, -1,
                                        &real_size, -1, &whole_size, -1);
    const size_t behind = (size_t)RITZ_BEHIND * (size_t)n, length = (size_t)creal(size);
    double complex *work = calloc(length + behind, sizeof *work);
    double *real_work = calloc((size_t)real_size + 1, sizeof *real_work);
    lapack_int *whole_work = calloc((size_t)whole_size + 1, sizeof *whole_work);
    if (work == NULL || real_work == NULL || whole_work == NULL)
        info = -1;
    numerics_work_add_dense(n);
    if (info == 0)
        info =
            (int)LAPACKE_zheevr_work(LAPACK_COL_MAJOR, 'V', 'I', 'U', n, H, n, 0, 0, n - most + 1,
                                     n, 0, found, mu, z, n, support, work, (lapack_int)length,
                                     real_work, (lapack_int)real_size, whole_work, whole_size);
    free(work);
    free(real_work);
    free(whole_work);
    return info;
}

status ritz_hermitian(const subspace *b, ritz *r, fault *f)
{
    const int k = b->count, n = 2 * k, most = r->room < n ? r->room : n;
    double complex *H = calloc((size_t)n * ((size_t)n + RITZ_BEHIND), sizeof *H),
                   *z = calloc((size_t)n * (size_t)most, sizeof *z);
    double *mu = calloc((size_t)n, sizeof *mu);
    double *R = calloc((size_t)k * (size_t)k + 1, sizeof *R);
    lapack_int *support = calloc(2 * (size_t)n, sizeof *support), found = 0;
    const int room = H != NULL && z != NULL && mu != NULL && R != NULL && support != NULL;
    int info = room ? root_of_mass(b, R) : -1;
    if (info == 0) {
        hermitian_matrix(b, R, H);
        info = largest_eigenvalues(n, most, H, mu, z, support, &found);
    }
    r->count = 0;
    r->size = k;
    if (info == 0)
        take_hermitian(b, (int)found, mu, z, r);
    free(H);
    free(z);
    free(mu);
    free(R);
    free(support);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "a Hermitian eigenvalue problem of %d unknowns was not solved; "
                                 "use another number of elements",
                                 n);
}

static int is_first_of_its_kind(double complex lambda)
{
    const double tiny = ritz_imaginary * cabs(lambda);
    return cimag(lambda) > tiny ? creal(lambda) >= -tiny
                                : cimag(lambda) >= -tiny && creal(lambda) > 0;
}

/* Inserts a pair in the order of magnitude. c[2 x basis size]: coefficients of x and of w. */
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
        memcpy(left_coefficients(b, r, i), left_coefficients(b, r, i - 1),
               (size_t)b->room * sizeof *c);
    }
    r->lambda[at] = lambda;
    memcpy(coefficients(b, r, at), c, (size_t)b->count * sizeof *c);
    memcpy(left_coefficients(b, r, at), c + b->count, (size_t)b->count * sizeof *c);
    normalise(b->count, coefficients(b, r, at));
    normalise(b->count, left_coefficients(b, r, at));
}

/* Fills the column-major matrices of nu [Kp, 0; 0, 1] z = [-Gp, -R^T; R, 0] z, where nu = 1/lambda,
 * z = (x, lambda R x), Mp = R^T R and Kp = 1 - shift Mp. A massless mode is a simple eigenvalue nu
 * = 0. */
static void general_matrices(const subspace *b, double shift, const double R[], double A[],
                             double B[])
{
    const int k = b->count, n = 2 * k, room = b->room;
    for (int i = 0; i < k; i++)
        for (int j = 0; j < k; j++) {
            A[j * n + i] = -b->Gp[i * room + j];
            A[(k + j) * n + i] = -R[j * k + i];
            A[j * n + k + i] = R[i * k + j];
            B[j * n + i] = (i == j) - shift * b->Mp[i * room + j];
        }
    for (int i = 0; i < k; i++)
        B[(k + i) * n + k + i] = 1;
}

/* Copies the first half of column i of z[n x n] to c[k]. For a conjugate pair, this column contains
 * the real part and the next column contains the imaginary part. */
static void take_column(int k, int i, int is_complex, int second, const double *z,
                        double complex c[])
{
    const int n = 2 * k;
    const double complex imaginary = second ? -I : I;
    const double *column = z + (size_t)(second ? i - 1 : i) * (size_t)n;
    for (int j = 0; j < k; j++)
        c[j] = column[j] + (is_complex ? imaginary * column[n + j] : 0);
}

/* Stores one of each set lambda, -lambda, conj lambda, -conj lambda of eigenvalues beta/(re + i im)
 * [n]. Their columns of z (right) and w (left) contain real and imaginary parts. c[2 k]: work
 * space. */
static void take_general(const subspace *b, const double re[], const double im[],
                         const double beta[], const double *z, const double *w, double complex c[],
                         ritz *r)
{
    const int k = b->count, n = 2 * k;
    double largest = 0;
    for (int i = 0; i < n; i++)
        if (beta[i] != 0)
            largest = fmax(largest, hypot(re[i], im[i]) / fabs(beta[i]));
    for (int i = 0; i < n; i++) {
        const double complex lambda = beta[i] / (re[i] + I * im[i]);
        if (!(hypot(re[i], im[i]) > 16 * n * DBL_EPSILON * largest * fabs(beta[i])) ||
            !is_first_of_its_kind(lambda))
            continue;
        take_column(k, i, im[i] != 0, im[i] < 0, z, c);
        take_column(k, i, im[i] != 0, im[i] < 0, w, c + k);
        insert(b, r, lambda, c);
    }
}

status ritz_general(const subspace *b, double shift, ritz *r, fault *f)
{
    const int k = b->count, n = 2 * k;
    const size_t square = (size_t)n * (size_t)n;
    double *A = calloc(5 * square + 3 * (size_t)n + 1, sizeof *A), *B = A + square, *z = B + square;
    double *w = z + square, *R = w + square, *re = R + square, *im = re + n, *beta = im + n;
    double complex *c = calloc(2 * (size_t)k + 1, sizeof *c);
    int info = -1;
    if (A != NULL && c != NULL)
        info = root_of_mass(b, R);
    if (info == 0) {
        general_matrices(b, shift, R, A, B);
        numerics_work_add_dense(n);
        info =
            (int)LAPACKE_dggev(LAPACK_COL_MAJOR, 'V', 'V', n, A, n, B, n, re, im, beta, w, n, z, n);
    }
    r->count = 0;
    r->size = k;
    if (info == 0)
        take_general(b, re, im, beta, z, w, c, r);
    free(A);
    free(c);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "an eigenvalue problem of %d unknowns was not solved; use another "
                                 "number of elements",
                                 n);
}
