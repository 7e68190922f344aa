#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/real.h"

status candidates_alloc(candidates *p, const eigen_problem *problem, double sign, fault *f)
{
    const size_t n = (size_t)problem->K->n;
    memset(p, 0, sizeof *p);
    p->problem = problem;
    p->sign = sign;
    p->n = problem->K->n;
    p->work = malloc(2 * n * sizeof *p->work);
    p->form = malloc(n * sizeof *p->form);
    if (p->work == NULL || p->form == NULL)
        return fault_memory(f, "an eigenvalue problem");
    return STATUS_OK;
}

void candidates_free(candidates *p)
{
    void *const all[] = {p->mu, p->matrix_mu, p->stiffness, p->part,
                         p->x,  p->work,      p->form,      p->correction};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        free(all[i]);
    sparse_free_values(&p->shifted);
    factor_free(p->shifted_factor);
    memset(p, 0, sizeof *p);
}

static int grow(double **list, size_t count)
{
    double *larger = realloc(*list, count * sizeof **list);
    if (larger != NULL)
        *list = larger;
    return larger != NULL;
}

static status make_room(candidates *p, int room, fault *f)
{
    const size_t count = (size_t)room, numbers = count * (size_t)p->n;
    if (room > p->room &&
        !(grow(&p->mu, count) && grow(&p->part, count) && grow(&p->matrix_mu, count) &&
          grow(&p->stiffness, count) && grow(&p->x, numbers)))
        return fault_memory(f, "%d eigenvectors", room);
    p->room = room > p->room ? room : p->room;
    return STATUS_OK;
}

/* Returns x^T a x from the caller's function, or from the matrix. In the second case, `product`
 * receives a x. */
static double form_of(const candidates *p, eigen_form *form, const sparse *a, const double x[],
                      double product[])
{
    if (form != NULL)
        return form(p->problem->context, x);
    sparse_mul(a, x, product);
    return dense_dot(p->n, x, product);
}

static double K_form(candidates *p, const double x[])
{
    return form_of(p, p->problem->K_energy, p->problem->K, x, p->form);
}

/* Returns eps times the square root of the sum of the squares of all terms of x^T (K - s A/mu) x.
 * The squares are added because the rounding errors are independent. */
static double rounding(const candidates *p, double mu, const double x[])
{
    const sparse *K = p->problem->K, *A = p->problem->A;
    double sum = 0;
    for (int j = 0; j < p->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++) {
            const double term = x[K->row[k]] * x[j] * (fabs(K->value[k]) + fabs(A->value[k] / mu));
            sum += (K->row[k] != j ? 2 : 1) * term * term;
        }
    return DBL_EPSILON * sqrt(sum);
}

static void sort_last(candidates *p)
{
    const size_t n = (size_t)p->n;
    for (int i = p->count - 1; i > 0 && p->mu[i] > p->mu[i - 1]; i--) {
        double *const numbers[] = {p->mu, p->matrix_mu, p->stiffness};
        for (int k = 0; k < 3; k++) {
            const double kept = numbers[k][i];
            numbers[k][i] = numbers[k][i - 1];
            numbers[k][i - 1] = kept;
        }
        double *last = p->x + (size_t)i * n, *before = last - n;
        memcpy(p->work, last, n * sizeof *last);
        memcpy(last, before, n * sizeof *last);
        memcpy(before, p->work, n * sizeof *last);
    }
}

double candidates_least(int n, double scale)
{
    return 16 * n * sqrt(n) * DBL_EPSILON * scale;
}

int candidates_is_rounding(const candidates *p, double energy, const double x[])
{
    const double sure = 128;
    const eigen_problem *e = p->problem;
    return e->A_rounding != NULL && fabs(energy) <= sure * e->A_rounding(e->context, x);
}

double candidates_departure(const candidates *p, int count)
{
    double largest = 0;
    const int first = count < p->count ? count : p->count;
    for (int i = 0; i < first; i++)
        largest = fmax(largest, fabs(p->stiffness[i] - 1));
    return largest;
}

status candidates_refine(candidates *p, int count, fault *f)
{
    enum { MOST = 12 };
    const double departure = candidates_departure(p, count), left = 1e-6;
    double error = departure;
    p->refinements = 1;
    while (p->refinements < MOST && (error *= departure) > left)
        p->refinements++;
    if (p->correction == NULL)
        p->correction = malloc((size_t)p->n * sizeof *p->correction);
    return p->correction != NULL ? STATUS_OK : fault_memory(f, "refined solutions");
}

/* Adds K^-1 (s A x - K y) to y, where K y is computed from the elements. */
static void refine(candidates *p, const double x[], double y[])
{
    const eigen_problem *e = p->problem;
    double *r = p->correction;
    e->K_product(e->context, y, r);
    sparse_mul(e->A, x, p->form);
    for (int i = 0; i < p->n; i++)
        r[i] = p->sign * p->form[i] - r[i];
    factor_solve(e->K_factor, r);
    for (int i = 0; i < p->n; i++)
        y[i] += r[i];
}

/* Computes y = K^-1 s A x. */
static void candidates_apply(candidates *p, const double x[], double y[])
{
    sparse_mul(p->problem->A, x, y);
    for (int i = 0; i < p->n; i++)
        y[i] *= p->sign;
    factor_solve(p->problem->K_factor, y);
    if (p->correction != NULL)
        for (int pass = 0; pass < p->refinements; pass++)
            refine(p, x, y);
}

/* Accepts the vector stored after the last candidate as a candidate if its mu exceeds `least`. */
static void add_next(candidates *p, double least)
{
    const eigen_problem *e = p->problem;
    double *vector = p->x + (size_t)p->count * (size_t)p->n;
    REAL_CHOSEN(triangular_products)(e->K, e->A, vector, p->work, p->form);
    const double square = dense_dot(p->n, vector, p->work), length = sqrt(square),
                 of_matrix = p->sign * dense_dot(p->n, vector, p->form) / square;
    for (int i = 0; i < p->n; i++)
        vector[i] /= length;
    const double stiffness = K_form(p, vector),
                 mu = e->A_energy != NULL ? p->sign * e->A_energy(e->context, vector) : of_matrix;
    if (!(mu / stiffness > least))
        return;
    p->mu[p->count] = mu / stiffness;
    p->stiffness[p->count] = stiffness;
    p->matrix_mu[p->count] = of_matrix;
    p->count++;
    sort_last(p);
}

static void add_all(candidates *p, int count, const double x[], double least)
{
    const size_t n = (size_t)p->n;
    for (int c = 0; c < count; c++) {
        memmove(p->x + (size_t)p->count * n, x + (size_t)c * n, n * sizeof *x);
        add_next(p, least);
    }
}

status candidates_add(candidates *p, int count, const double x[], double least, fault *f)
{
    TRY(make_room(p, p->count + count, f));
    add_all(p, count, x, least);
    return STATUS_OK;
}

status candidates_take(candidates *p, int count, double *x, double least, fault *f)
{
    if (p->room == 0) {
        p->x = x;
        TRY(make_room(p, count, f));
        add_all(p, count, p->x, least);
        return STATUS_OK;
    }
    const status outcome = candidates_add(p, count, x, least, f);
    free(x);
    return outcome;
}

double *candidates_products(const candidates *p)
{
    const size_t n = (size_t)p->n;
    double *products = malloc(((size_t)p->count * n + 1) * sizeof *products);
    for (int i = 0; i < p->count && products != NULL; i++)
        sparse_mul(p->problem->K, p->x + (size_t)i * n, products + (size_t)i * n);
    return products;
}

/* Returns y^T K y, where y = K^-1 s A x - mu x for candidate i, and sets p->form to A y. If the
 * solutions are not refined, the assembly of K has hardly changed its forms. */
static double remainder_of(candidates *p, int i)
{
    const eigen_problem *e = p->problem;
    const double *x = p->x + (size_t)i * (size_t)p->n;
    double *y = p->work, *Ky = p->work + p->n;
    candidates_apply(p, x, y);
    for (int k = 0; k < p->n; k++)
        y[k] -= p->mu[i] * x[k];
    const double refined = p->correction != NULL ? K_form(p, y) : 0;
    REAL_CHOSEN(triangular_products)(e->K, e->A, y, Ky, p->form);
    return p->correction != NULL ? refined : dense_dot(p->n, y, Ky);
}

/* Error bound: if x^T K x = 1 and y = K^-1 s A x - mu x, the distance from mu to an eigenvalue is
 * at most sqrt(y^T K y). The component of y along a mode k with a larger eigenvalue, c_k = x_k^T K
 * y = x_k^T s A y/mu_k, is due to a part c_k/(mu_k - mu) of this mode in x. This part changes the
 * quotient mu by c_k^2/(mu_k - mu), or by mu_k - mu if the two eigenvalues are too close to be
 * distinguished. The remaining part of y contributes its full length. */
void candidates_evaluate(candidates *p, int i, double *residual, double *error)
{
    const double mu = p->mu[i], square = remainder_of(p, i) / (p->stiffness[i] * mu * mu);
    double rest = square;
    REAL_CHOSEN(basis_measure)(p->n, i, p->x, p->form, p->part);
    *error = 0;
    for (int k = 0; k < i; k++) {
        const double part = p->part[k] / p->mu[k] / mu, apart = p->mu[k] / mu - 1;
        rest -= part * part;
        *error += part * part >= apart * apart ? apart : part * part / apart;
    }
    *residual = sqrt(square);
    *error += fmax(rest, 0);
}

/* According to Sylvester's law, the number of mu > s > 0 equals the number of negative pivots of K
 * - sign A/s. The count is correct if the distance of s from every eigenvalue exceeds the effect of
 * rounding in the matrices. */

static const double close = 1e-9;

enum { LARGE = 20000 };

void candidates_count_rest(candidates *p)
{
    if (p->n < LARGE)
        return;
    sparse_free_values(&p->shifted);
    factor_free(p->shifted_factor);
    p->shifted_factor = NULL;
}

status candidates_count_above(candidates *p, double s, int *above, eigen_result *work, fault *f)
{
    const sparse *K = p->problem->K;
    if (p->shifted.value == NULL)
        TRY(sparse_alloc_like(K, &p->shifted, f));
    if (p->shifted_factor == NULL)
        TRY(factor_alloc_like(p->problem->K_factor, K, &p->shifted_factor, f));
    for (int i = 0; i < K->column[p->n]; i++)
        p->shifted.value[i] = K->value[i] - p->sign * p->problem->A->value[i] / s;
    const status outcome = factor_numeric(p->shifted_factor, &p->shifted, f);
    *above = factor_count(p->shifted_factor).negative_pivots;
    work->factorisations++;
    return outcome;
}

/* Returns the change of the Rayleigh quotient of candidate i due to rounding of its sums. */
static double noise(const candidates *p, int i)
{
    return rounding(p, p->mu[i], p->x + (size_t)i * (size_t)p->n);
}

/* Returns the number of candidates above the cluster that contains rank `wanted`, and sets *top to
 * the largest value of the cluster, and *noise_of_top to its rounding error. */
static int above_cluster(const candidates *p, int wanted, double *top, double *noise_of_top)
{
    const double *mu = p->matrix_mu;
    int q = wanted - 1;
    *top = mu[q];
    *noise_of_top = noise(p, q);
    while (q > 0) {
        const double next = noise(p, q - 1);
        if (mu[q - 1] - *top > (close + 16 * fmax(next, *noise_of_top)) * mu[q - 1])
            break;
        *top = fmax(*top, mu[--q]);
        *noise_of_top = next;
    }
    return q;
}

status candidates_count_missing(candidates *p, int wanted, int *missing, eigen_result *work,
                                fault *f)
{
    static const double place[] = {0.5, 0.35, 0.65};
    double low, rounded;
    const int q = above_cluster(p, wanted, &low, &rounded);
    const double distinguishable = 2 * close + 32 * rounded, near = 1e-2;
    const double high = q > 0 ? fmin(p->matrix_mu[q - 1], low * (1 + fmax(near, distinguishable)))
                              : low * (1 + distinguishable);
    int above = 0;
    *missing = -1;
    for (int i = 0; i < 3; i++) {
        const status outcome =
            candidates_count_above(p, low + place[i] * (high - low), &above, work, f);
        if (outcome == STATUS_SINGULAR)
            continue;
        TRY(outcome);
        const int confirmed = *missing == above - q;
        *missing = above - q;
        if (*missing == 0 || confirmed)
            break;
    }
    if (*missing < 0)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "%d eigenvalues were found, but the signs of the pivots give fewer or "
                         "cannot be computed; use fewer elements",
                         q);
    return STATUS_OK;
}

static void signed_product(const candidates *p, const double x[], double Ax[])
{
    sparse_mul(p->problem->A, x, Ax);
    for (int i = 0; i < p->n; i++)
        Ax[i] *= p->sign;
}

/* Computes the upper triangles of Y^T K Y and Y^T s A Y, column-major. */
static void project(candidates *p, const double Y[], double K[], double A[])
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    for (size_t j = 0; j < count; j++) {
        signed_product(p, p->x + j * n, p->work);
        for (size_t i = 0; i <= j; i++)
            K[j * count + i] = dense_dot(p->n, Y + i * n, p->work);
        signed_product(p, Y + j * n, p->work);
        for (size_t i = 0; i <= j; i++)
            A[j * count + i] = dense_dot(p->n, Y + i * n, p->work);
    }
}

/* Replaces Y by Y C with the column-major C[count x count]. row[count]: work space. */
static void combine(size_t n, size_t count, double Y[], const double C[], double row[])
{
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < count; k++)
            row[k] = Y[k * n + i];
        for (size_t j = 0; j < count; j++)
            Y[j * n + i] = dense_dot((int)count, row, C + j * count);
    }
}

/* Replaces the candidates by the Ritz vectors of Y = K^-1 s A X. They do not change if LAPACK
 * fails. Work space: Y[count x n], small[2 count^2 + count]. */
static status replace(candidates *p, double Y[], double small[], fault *f)
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    double *A = small, *K = A + count * count, *mu = K + count * count;
    const int m = (int)count;
    for (size_t i = 0; i < count; i++)
        candidates_apply(p, p->x + i * n, Y + i * n);
    project(p, Y, K, A);
    if (LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', m, A, m, K, m, mu) != 0)
        return STATUS_OK;
    combine(n, count, Y, A, mu);
    p->count = 0;
    return candidates_add(p, m, Y, 0, f);
}

status polish(candidates *p, fault *f)
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    double *Y = malloc((count * n + 1) * sizeof *Y),
           *small = calloc(2 * count * count + count + 1, sizeof *small);
    const status outcome = Y != NULL && small != NULL
                               ? replace(p, Y, small, f)
                               : fault_memory(f, "%zu vectors of %zu unknowns", count, n);
    free(Y);
    free(small);
    return outcome;
}
