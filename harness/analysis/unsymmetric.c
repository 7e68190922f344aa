#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

/* Relative magnitude below which an eigenvalue may be a rounding error of massless coordinates. */
static const double nothing = 1e-6;

/* Coordinates are scaled by the square roots of the diagonal of K. Rates are scaled by `second`. */
typedef struct unsymmetric_solver {
    const unsymmetric_problem *p;
    unsymmetric_result *out;
    int n, massive; /* number of coordinates, and number of coordinates with mass */
    int *of;        /* [massive] */
    double *scale;  /* [n] */
    double *x, *y;  /* [n] workspace */
    double second;  /* [s] */
    sparse M;       /* entries of the mass matrix that are not zero */
    arnoldi_result right, left;
} unsymmetric_solver;

void unsymmetric_free(unsymmetric_result *r)
{
    free(r->frequency);
    free(r->error);
    free(r->mode);
    memset(r, 0, sizeof *r);
}

static void solve(const unsymmetric_solver *s, int transposed, double x[])
{
    if (transposed)
        factor_solve_transposed(s->p->K_factor, x);
    else
        factor_solve(s->p->K_factor, x);
}

/* Computes y = K^-1 M x in scaled coordinates. */
static void apply_undamped(void *context, const double in[], double out[])
{
    const unsymmetric_solver *s = context;
    for (int i = 0; i < s->n; i++)
        s->x[i] = in[i] / s->scale[i];
    sparse_mul(&s->M, s->x, s->y);
    solve(s, 0, s->y);
    for (int i = 0; i < s->n; i++)
        out[i] = s->y[i] * s->scale[i];
}

/* Computes y = M K^-T x in scaled coordinates. */
static void apply_undamped_transposed(void *context, const double in[], double out[])
{
    const unsymmetric_solver *s = context;
    for (int i = 0; i < s->n; i++)
        s->x[i] = in[i] * s->scale[i];
    solve(s, 1, s->x);
    sparse_mul(&s->M, s->x, s->y);
    for (int i = 0; i < s->n; i++)
        out[i] = s->y[i] / s->scale[i];
}

/* Applies the matrix [-K^-1 C, -K^-1 M; 1, 0] to [x; v] in scaled coordinates. */
static void apply_damped(void *context, const double in[], double out[])
{
    const unsymmetric_solver *s = context;
    for (int i = 0; i < s->n; i++)
        s->x[i] = in[i] / s->scale[i];
    sparse_mul(s->p->C, s->x, s->y);
    memset(s->x, 0, (size_t)s->n * sizeof *s->x);
    for (int k = 0; k < s->massive; k++)
        s->x[s->of[k]] = in[s->n + k] / s->scale[s->of[k]] / s->second;
    sparse_mul(&s->M, s->x, out);
    for (int i = 0; i < s->n; i++)
        s->y[i] = -s->y[i] - out[i];
    solve(s, 0, s->y);
    for (int k = 0; k < s->massive; k++)
        out[s->n + k] = in[s->of[k]] * s->second;
    for (int i = 0; i < s->n; i++)
        out[i] = s->y[i] * s->scale[i];
}

static void apply_damped_transposed(void *context, const double in[], double out[])
{
    const unsymmetric_solver *s = context;
    for (int i = 0; i < s->n; i++)
        s->x[i] = in[i] * s->scale[i];
    solve(s, 1, s->x);
    sparse_mul_transposed(s->p->C, s->x, s->y);
    for (int i = 0; i < s->n; i++)
        out[i] = -s->y[i] / s->scale[i];
    sparse_mul(&s->M, s->x, s->y);
    for (int k = 0; k < s->massive; k++) {
        out[s->of[k]] += in[s->n + k] * s->second;
        out[s->n + k] = -s->y[s->of[k]] / s->scale[s->of[k]] / s->second;
    }
}

static double diagonal(const sparse *a, int j)
{
    for (int k = a->column[j]; k < a->column[j + 1]; k++)
        if (a->row[k] == j)
            return fabs(a->value[k]);
    return 0;
}

/* Returns the scale of a coordinate without a stiffness, such as a feedback integral, from the
 * forces that the coordinate causes. */
static double scale_of(const unsymmetric_solver *s, int j)
{
    const sparse *K = s->p->K;
    double largest = 0;
    for (int k = K->column[j]; k < K->column[j + 1]; k++) {
        const double own = diagonal(K, K->row[k]);
        if (own > 0)
            largest = fmax(largest, fabs(K->value[k]) / sqrt(own));
    }
    return largest;
}

/* The pattern of M is that of K, of which M fills about half. */
static status take_mass(unsymmetric_solver *s, fault *f)
{
    const sparse *M = s->p->M;
    const size_t entries = (size_t)M->column[M->n];
    int *column = calloc((size_t)M->n + 1, sizeof *column),
        *row = malloc((entries + 1) * sizeof *row), count = 0;
    double *value = malloc((entries + 1) * sizeof *value);
    s->M = (sparse){M->n, M->symmetric, column, row, value, 0};
    if (column == NULL || row == NULL || value == NULL)
        return fault_memory(f, "a mass matrix of %d coordinates", M->n);
    for (int j = 0; j < M->n; j++) {
        for (int k = M->column[j]; k < M->column[j + 1]; k++)
            if (M->value[k] != 0) {
                row[count] = M->row[k];
                value[count++] = M->value[k];
            }
        column[j + 1] = count;
    }
    return STATUS_OK;
}

static void measure(unsymmetric_solver *s)
{
    double largest = 0;
    for (int i = 0; i < s->n; i++)
        largest = fmax(largest, diagonal(s->p->K, i));
    for (int i = 0; i < s->n; i++) {
        const double k = diagonal(s->p->K, i),
                     by_shift = s->p->shift > 0 ? s->p->shift * diagonal(s->p->C, i) : 0;
        const double by_forces = k > (1 + nothing) * by_shift ? 0 : scale_of(s, i);
        s->scale[i] = by_forces > 0 ? by_forces : sqrt(k > 0 ? k : largest > 0 ? largest : 1);
        if (diagonal(s->p->M, i) > 0)
            s->of[s->massive++] = i;
    }
}

/* Sets s->second to an estimate of 1/w, where w is the lowest circular frequency of the undamped
 * structure. */
static void find_second(unsymmetric_solver *s, double from[], double to[])
{
    double size = 0;
    for (int i = 0; i < s->n; i++)
        from[i] = 1 + 0.1 * (i % 7);
    for (int pass = 0; pass < 3; pass++) {
        const double length = sqrt(dense_dot(s->n, from, from));
        for (int i = 0; i < s->n; i++)
            from[i] /= length;
        apply_undamped(s, from, to);
        size = sqrt(dense_dot(s->n, to, to));
        memcpy(from, to, (size_t)s->n * sizeof *to);
        if (!(size > 0))
            break;
    }
    /* a feedback integral may reduce the value to rounding */
    for (int k = 0; k < s->massive && !s->p->K->symmetric; k++)
        size = fmax(size, diagonal(s->p->M, s->of[k]) / (s->scale[s->of[k]] * s->scale[s->of[k]]));
    s->second = size > 0 ? sqrt(size) : 1;
}

/* Increases the scales of integrals z, with C z' = -K x. */
static void scale_integrals(unsymmetric_solver *s, double rate[])
{
    const sparse *K = s->p->K, *C = s->p->C;
    memset(rate, 0, (size_t)s->n * sizeof *rate);
    for (int j = 0; j < s->n && !K->symmetric; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            if (K->row[k] != j)
                rate[K->row[k]] = fmax(rate[K->row[k]], fabs(K->value[k]) / s->scale[j]);
    for (int i = 0; i < s->n && !K->symmetric; i++) {
        const double own = diagonal(C, i);
        if (rate[i] > 0 && own > 0 && diagonal(s->p->M, i) == 0 &&
            diagonal(K, i) <= (1 + nothing) * s->p->shift * own) {
            const double by_rate = own / (rate[i] * s->second);
            s->scale[i] = fmax(s->scale[i], sqrt(by_rate * s->scale[i]));
        }
    }
}

static status pairs(unsymmetric_solver *s, int transposed, arnoldi_result *out, fault *f)
{
    const int damped = s->p->C != NULL, wanted = (damped ? 2 : 1) * s->p->wanted;
    arnoldi_problem a = {.n = s->n + (damped ? s->massive : 0),
                         .wanted = wanted,
                         .context = s,
                         .values_only = s->p->values_only && !s->p->estimate,
                         .rough = s->p->rough,
                         .left = s->p->estimate && !transposed ? &s->left : NULL};
    if (damped)
        a.apply = transposed ? apply_damped_transposed : apply_damped;
    else
        a.apply = transposed ? apply_undamped_transposed : apply_undamped;
    return arnoldi_solve(&a, out, f);
}

/* Computes y = A x. absolute 1: computes y = |A| x. */
static void multiply(const sparse *A, int absolute, const double complex x[], double complex y[])
{
    for (int j = 0; j < A->n; j++)
        y[j] = 0;
    for (int j = 0; j < A->n; j++)
        for (int k = A->column[j]; k < A->column[j + 1]; k++) {
            const double a = absolute ? fabs(A->value[k]) : A->value[k];
            if (a == 0)
                continue;
            y[A->row[k]] += a * x[j];
            if (A->symmetric && A->row[k] != j)
                y[j] += a * x[A->row[k]];
        }
}

/* Returns the eigenvalue s of the matrices, which may be shifted. */
static double complex root(const unsymmetric_solver *s, double complex theta)
{
    return s->p->C != NULL ? 1 / theta : csqrt(-1 / theta);
}

typedef struct growth_estimate {
    double complex *x, *w, *y, *left; /* left: [left.count x n] */
} growth_estimate;

static void size_of(int n, const double complex x[], double complex y[])
{
    for (int i = 0; i < n; i++)
        y[i] = cabs(x[i]);
}

static double complex product(int n, const double complex a[], const double complex b[])
{
    double complex sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Returns |w^T (2 s M + C) x|. absolute 1: returns the sum of the absolute values of its terms. */
static double slope(const unsymmetric_solver *s, int absolute, double complex at,
                    const double complex w[], const growth_estimate *e)
{
    multiply(s->p->M, absolute, e->x, e->y);
    double complex sum = 2 * (absolute ? cabs(at) : at) * product(s->n, w, e->y);
    if (s->p->C == NULL)
        return cabs(sum);
    multiply(s->p->C, absolute, e->x, e->y);
    return cabs(sum + product(s->n, w, e->y));
}

/* Returns the estimated error of s due to rounding. A change dK of K changes s by w^T dK x/(w^T (2
 * s M + C) x). If eigenvalues coincide, the error is of the order of the square root of the
 * rounding error. */
static double error_of(const unsymmetric_solver *s, int i, const growth_estimate *e)
{
    const int n = s->n;
    const double complex theta = s->right.theta[i], at = root(s, theta);
    const double whole_size = cabs(at + s->p->shift), part = cabs(at) / whole_size;
    const size_t size = s->p->C != NULL ? (size_t)(n + s->massive) : (size_t)n;
    double least = INFINITY, cap = INFINITY;
    for (int j = 0; j < s->left.count; j++) {
        const double complex *w = e->left + (size_t)j * (size_t)n;
        if (cabs(s->left.theta[j] - theta) > 1e-4 * cabs(theta))
            continue;
        for (int k = 0; k < n; k++)
            e->x[k] = s->right.mode[(size_t)i * size + (size_t)k] / s->scale[k];
        const double simple = slope(s, 0, at, w, e);
        size_of(n, e->x, e->x);
        size_of(n, w, e->w);
        const double whole = slope(s, 1, at, e->w, e);
        multiply(s->p->K, 1, e->x, e->y);
        const double rounding = DBL_EPSILON * creal(product(n, e->w, e->y)) / whole_size;
        least = fmin(least, rounding / simple);
        cap = fmin(cap, sqrt(rounding / whole));
    }
    return fmin(least, cap) + part * s->right.residual[i] * fmin(1, least / DBL_EPSILON);
}

/* Returns the relative distance from right.theta[i] to the nearest other eigenvalue. */
static double gap(const unsymmetric_solver *s, int i)
{
    const arnoldi_result *r = &s->right;
    double nearest = 1 - r->next / cabs(r->theta[i]);
    for (int j = 0; j < r->count; j++)
        if (j != i)
            nearest = fmin(nearest, cabs(r->theta[j] / r->theta[i] - 1));
    return nearest;
}

/* Returns |K^-T M x/theta - x|/|x| in scaled coordinates, where x is a real mode. */
static double left_change(unsymmetric_solver *s, int i)
{
    const double complex *v = s->right.mode + (size_t)i * (size_t)s->n;
    const double theta = creal(s->right.theta[i]);
    double change = 0, size = 0;
    for (int k = 0; k < s->n; k++)
        s->x[k] = creal(v[k]) / s->scale[k];
    sparse_mul(&s->M, s->x, s->y);
    solve(s, 1, s->y);
    for (int k = 0; k < s->n; k++) {
        const double d = (s->y[k] / theta - s->x[k]) * s->scale[k];
        change += d * d;
        size += creal(v[k]) * creal(v[k]);
    }
    return sqrt(change / size);
}

/* Returns 1 if modes x can replace the left vectors w in the estimate of errors. Let x = w_i + sum
 * c_j w_j. Since w_j^T M x_i = 0 for different eigenvalues, x^T M x equals w_i^T M x. The change
 * K^-T M x/theta_i - x equals sum c_j (theta_j/theta_i - 1) w_j. The difference of x and w_i is
 * therefore about this change divided by the smallest |theta_j/theta_i - 1|. */
static int modes_serve_as_left(unsymmetric_solver *s)
{
    const double small = 0.1;
    int serve = s->p->C == NULL;
    for (int i = 0; serve && i < s->right.count; i++)
        serve = cimag(s->right.theta[i]) == 0 && left_change(s, i) <= small * gap(s, i);
    return serve;
}

static status take_modes_as_left(unsymmetric_solver *s, fault *f)
{
    const size_t size = (size_t)s->right.count * sizeof *s->left.theta;
    s->left.theta = malloc(size + 1);
    if (s->left.theta == NULL)
        return fault_memory(f, "%d modes", s->right.count);
    memcpy(s->left.theta, s->right.theta, size);
    s->left.count = s->right.count;
    return STATUS_OK;
}

/* Computes the left vectors w of K, which are K^-T times the left vectors of the operator. */
static status left_vectors(unsymmetric_solver *s, growth_estimate *e, fault *f)
{
    const size_t n = (size_t)s->n;
    const int modes_serve = s->left.theta == NULL && modes_serve_as_left(s);
    if (s->left.theta == NULL)
        TRY(modes_serve ? take_modes_as_left(s, f) : pairs(s, 1, &s->left, f));
    e->x = calloc((3 + (size_t)s->left.count) * n + 1, sizeof *e->x);
    if (e->x == NULL)
        return fault_memory(f, "%d modes", s->left.count);
    e->w = e->x + n;
    e->y = e->w + n;
    e->left = e->y + n;
    for (size_t i = 0; modes_serve && i < n * (size_t)s->left.count; i++)
        e->left[i] = s->right.mode[i] / s->scale[i % n];
    for (int j = 0; !modes_serve && j < s->left.count; j++) {
        const size_t size = s->p->C != NULL ? n + (size_t)s->massive : n;
        const double complex *v = s->left.mode + (size_t)j * size;
        for (int half = 0; half < 2; half++) {
            for (size_t i = 0; i < n; i++)
                s->x[i] = (half ? cimag(v[i]) : creal(v[i])) * s->scale[i];
            solve(s, 1, s->x);
            for (size_t i = 0; i < n; i++)
                e->left[(size_t)j * n + i] += half ? I * s->x[i] : s->x[i];
        }
    }
    return STATUS_OK;
}

/* Sets mode[] to the real part of the eigenvector, with the phase for which this part is largest.
 * For the second of two flutter modes, sets mode[] to the imaginary part. */
static void take_mode(const unsymmetric_solver *s, int i, int second, double mode[])
{
    const size_t size = s->p->C != NULL ? (size_t)(s->n + s->massive) : (size_t)s->n;
    const double complex *v = s->right.mode + (size_t)i * size;
    double complex square = 0;
    for (int k = 0; k < s->n; k++)
        square += v[k] * v[k];
    const double complex phase = cexp(-I * carg(square) / 2);
    for (int k = 0; k < s->n; k++) {
        const double complex x = phase * v[k] / s->scale[k];
        mode[k] = second && fabs(cimag(square)) > 0 ? cimag(x) : creal(x);
    }
}

/* Returns w^T A x. y: work space. */
static double complex form(const unsymmetric_solver *s, const sparse *A, const double complex w[],
                           const double complex x[], double complex y[])
{
    multiply(A, 0, x, y);
    return product(s->n, w, y);
}

/* Returns the left vector of eigenvalue i; NULL: none. If there are several left vectors, returns
 * the vector whose product with e->x is largest. */
static const double complex *left_of(const unsymmetric_solver *s, int i, const growth_estimate *e)
{
    const double complex theta = s->right.theta[i], *found = NULL;
    double largest = 0;
    for (int j = 0; j < s->left.count; j++) {
        const double complex *w = e->left + (size_t)j * (size_t)s->n;
        if (cabs(s->left.theta[j] - theta) > 1e-4 * cabs(theta))
            continue;
        const double part = slope(s, 0, root(s, theta), w, e) / sqrt(cabs(product(s->n, w, w)));
        if (part > largest)
            found = w;
        largest = fmax(largest, part);
    }
    return found;
}

/* Sets e->w, the second vector of the forms: the left vector or, for a symmetric K, the mode x. If
 * |x^T M x| is too small, the conjugate of x is used. */
static void take_other(const unsymmetric_solver *s, int i, const growth_estimate *e)
{
    const double complex *left = s->p->K->symmetric ? NULL : left_of(s, i, e);
    memcpy(e->w, left != NULL ? left : e->x, (size_t)s->n * sizeof *e->w);
    if (left != NULL)
        return;
    const double size = cabs(form(s, s->p->M, e->w, e->x, e->y));
    for (int k = 0; k < s->n; k++)
        e->w[k] = conj(e->x[k]);
    if (size > 0.1 * cabs(form(s, s->p->M, e->w, e->x, e->y)))
        memcpy(e->w, e->x, (size_t)s->n * sizeof *e->w);
}

/* Returns the root of c (z - s) + m (z^2 - s^2) = b (z^2 + mass z)^2/(1 + stiffness z) next to the
 * eigenvalue s, where c, m and b are the forms of its mode. */
static double complex with_inside(const unsymmetric_solver *s, int i, double complex at,
                                  const growth_estimate *e)
{
    const double complex *v = s->right.mode + (size_t)i * (size_t)(s->n + s->massive);
    double complex z = at;
    for (int k = 0; k < s->n; k++)
        e->x[k] = v[k] / s->scale[k];
    take_other(s, i, e);
    const double complex m = form(s, s->p->M, e->w, e->x, e->y),
                         c = form(s, s->p->C, e->w, e->x, e->y) - 2 * s->p->shift * m,
                         b = form(s, s->p->B, e->w, e->x, e->y);
    for (int pass = 0; pass < 20; pass++) {
        const double complex moves = z * z + s->p->mass * z, rests = 1 + s->p->stiffness * z,
                             part = moves / rests,
                             slope = c + 2 * m * z -
                                     b * part * (4 * z + 2 * s->p->mass - s->p->stiffness * part);
        if (cabs(slope) > 0)
            z -= (c * (z - at) + m * (z * z - at * at) - b * moves * part) / slope;
    }
    return cabs(z - at) < 0.3 * cabs(at) ? z : at; /* coarse meshes: unchanged */
}

static void take(unsymmetric_solver *s, int i, double error, const growth_estimate *e)
{
    unsymmetric_result *r = s->out;
    const double complex theta = s->right.theta[i];
    double complex at = root(s, theta) + s->p->shift;
    const int stays_real = cimag(at) == 0;
    if (s->p->B != NULL)
        at = with_inside(s, i, at, e);
    if (stays_real)
        at = creal(at);
    const int damped = s->p->C != NULL, k = r->count,
              doubled = s->p->decaying && fabs(cimag(at)) <= fmin(10 * error, nothing) * cabs(at),
              second = (!damped || doubled) && cimag(theta) < 0;
    if (doubled)
        at = creal(at); /* two equal real eigenvalues that rounding has changed into a pair */
    const double complex square = at * at;
    const double same = damped ? 10 * error : fmax(unsymmetric_same, 20 * error);
    const int grows = fabs(creal(at)) > (damped ? same * cabs(at) : same / 2 * cabs(at));
    if (damped && (cimag(at) < 0 || (!s->p->decaying && cimag(at) == 0 && creal(at) < 0)))
        return;
    if (k == s->p->wanted ||
        (s->p->decaying && !isfinite(error) && cabs(theta) < nothing * cabs(s->right.theta[0])))
        return;
    r->frequency[k] = grows || damped ? fabs(cimag(at)) : cabs(at);
    r->growth[k] = !grows ? 0 : damped ? creal(at) : second ? -fabs(creal(at)) : fabs(creal(at));
    r->split[k] = creal(square) > 0 && cimag(theta) == 0 ? 1 : fabs(cimag(square)) / cabs(square);
    r->error[k] = error;
    if (!s->p->values_only)
        take_mode(s, i, second, r->mode + (size_t)k * (size_t)s->n);
    r->count++;
}

static void sort(unsymmetric_solver *s)
{
    arnoldi_result *r = &s->right;
    const size_t size = (size_t)s->n + (size_t)s->massive;
    for (int i = 1; i < r->count; i++)
        for (int k = i; k > 0 && cabs(root(s, r->theta[k]) + s->p->shift) <
                                     cabs(root(s, r->theta[k - 1]) + s->p->shift);
             k--) {
            double complex *x = r->mode + (size_t)k * size, *y = x - size;
            const double complex theta = r->theta[k];
            const double residual = r->residual[k];
            r->theta[k] = r->theta[k - 1];
            r->theta[k - 1] = theta;
            r->residual[k] = r->residual[k - 1];
            r->residual[k - 1] = residual;
            for (size_t j = 0; j < size; j++) {
                const double complex one = x[j];
                x[j] = y[j];
                y[j] = one;
            }
        }
}

/* Indices of equal eigenvalues, and of their left vectors. */
typedef struct equal_values {
    int count, lefts;
    int *right, *left;
} equal_values;

static void find_equal(const unsymmetric_solver *s, int i, equal_values *of)
{
    const double equal = 1e-6, same_left = 1e-4;
    const double complex theta = s->right.theta[i];
    of->count = of->lefts = 0;
    for (int j = 0; j < s->right.count; j++)
        if (cabs(s->right.theta[j] - theta) <= equal * cabs(theta))
            of->right[of->count++] = j;
    for (int j = 0; j < s->left.count; j++)
        if (cabs(s->left.theta[j] - theta) <= same_left * cabs(theta))
            of->left[of->lefts++] = j;
}

/* Replaces the vectors of equal eigenvalues, which may be any basis, by those for which B is
 * diagonal, because with_inside treats the modes one by one: the vectors of S^-1 W^T B X, where S =
 * W^T (2 z M + C) X, and W contains the left vectors. The products of the new left vectors, (S
 * T)^-1 W^T, with the new vectors X T are zero. S, Y, T: [count x count], x: [count x size] work
 * space. */
static void separate_equal(unsymmetric_solver *s, const equal_values *of, const growth_estimate *e,
                           double complex S[], double complex Y[], double complex T[],
                           double complex x[], double complex z[], int pivot[])
{
    const int g = of->count, n = s->n;
    const size_t size = (size_t)n + (size_t)s->massive, N = (size_t)n;
    const double complex at = root(s, s->right.theta[of->right[0]]);
    for (int j = 0; j < g; j++) {
        for (int k = 0; k < n; k++)
            e->x[k] = s->right.mode[(size_t)of->right[j] * size + (size_t)k] / s->scale[k];
        for (int i = 0; i < g; i++) {
            const double complex *w = e->left + (size_t)of->left[i] * N;
            S[i * g + j] =
                2 * at * form(s, s->p->M, w, e->x, e->y) + form(s, s->p->C, w, e->x, e->y);
            Y[i * g + j] = form(s, s->p->B, w, e->x, e->y);
        }
    }
    memcpy(x, S, (size_t)(g * g) * sizeof *x);
    if (LAPACKE_zgesv(LAPACK_ROW_MAJOR, g, g, x, g, pivot, Y, g) != 0 ||
        LAPACKE_zgeev(LAPACK_ROW_MAJOR, 'N', 'V', g, Y, g, z, NULL, 1, T, g) != 0)
        return;
    for (int i = 0; i < g; i++)
        for (int j = 0; j < g; j++) {
            Y[i * g + j] = 0;
            for (int k = 0; k < g; k++)
                Y[i * g + j] += S[i * g + k] * T[k * g + j];
        }
    for (int i = 0; i < g; i++)
        memcpy(x + (size_t)i * N, e->left + (size_t)of->left[i] * N, N * sizeof *x);
    if (LAPACKE_zgesv(LAPACK_ROW_MAJOR, g, n, Y, g, pivot, x, n) != 0)
        return;
    for (int i = 0; i < g; i++)
        memcpy(e->left + (size_t)of->left[i] * N, x + (size_t)i * N, N * sizeof *x);
    for (size_t k = 0; k < size; k++) {
        for (int j = 0; j < g; j++) {
            x[j] = 0;
            for (int i = 0; i < g; i++)
                x[j] += s->right.mode[(size_t)of->right[i] * size + k] * T[i * g + j];
        }
        for (int j = 0; j < g; j++)
            s->right.mode[(size_t)of->right[j] * size + k] = x[j];
    }
}

static status separate(unsymmetric_solver *s, const growth_estimate *e, fault *f)
{
    const size_t m = (size_t)s->right.count + (size_t)s->left.count + 1,
                 size = (size_t)s->n + (size_t)s->massive;
    int *index = malloc(3 * m * sizeof *index);
    double complex *room = malloc((3 * m * m + m + m * size) * sizeof *room);
    equal_values of = {.right = index, .left = index + m};
    for (int i = 0; index != NULL && room != NULL && i < s->right.count; i++) {
        find_equal(s, i, &of);
        if (of.count > 1 && of.lefts == of.count && of.right[0] == i)
            separate_equal(s, &of, e, room, room + m * m, room + 2 * m * m, room + 3 * m * m + m,
                           room + 3 * m * m, index + 2 * m);
    }
    const status outcome =
        index != NULL && room != NULL ? STATUS_OK : fault_memory(f, "%d modes", s->right.count);
    free(index);
    free(room);
    return outcome;
}

static void swap_numbers(double *a, double *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

/* Sorts the modes again, because the motions inside the elements may have changed their order. */
static void sort_results(unsymmetric_result *r)
{
    const size_t n = (size_t)r->n;
    for (int i = 1; i < r->count; i++)
        for (int k = i; k > 0 && hypot(r->frequency[k], r->growth[k]) <
                                     hypot(r->frequency[k - 1], r->growth[k - 1]);
             k--) {
            double *const numbers[] = {r->frequency, r->growth, r->split, r->error};
            for (int j = 0; j < 4; j++)
                swap_numbers(numbers[j] + k, numbers[j] + k - 1, 1);
            swap_numbers(r->mode + (size_t)k * n, r->mode + (size_t)(k - 1) * n, n);
        }
}

static status store_results(unsymmetric_solver *s, fault *f)
{
    unsymmetric_result *r = s->out;
    const size_t count = (size_t)s->right.count;
    growth_estimate e = {0};
    r->frequency = calloc(3 * count + 1, sizeof *r->frequency);
    r->error = calloc(count + 1, sizeof *r->error);
    r->mode = calloc(count * (size_t)s->n + 1, sizeof *r->mode);
    if (r->frequency == NULL || r->error == NULL || r->mode == NULL)
        return fault_memory(f, "%d modes", s->right.count);
    r->growth = r->frequency + count;
    r->split = r->growth + count;
    status outcome = s->p->estimate ? left_vectors(s, &e, f) : STATUS_OK;
    if (outcome == STATUS_OK && s->p->estimate && s->p->B != NULL)
        outcome = separate(s, &e, f);
    for (int i = 0; outcome == STATUS_OK && i < s->right.count; i++)
        take(s, i, s->p->estimate ? error_of(s, i, &e) : 0, &e);
    if (outcome == STATUS_OK && s->p->B != NULL)
        sort_results(r);
    free(e.x);
    return outcome;
}

status unsymmetric_solve(const unsymmetric_problem *p, unsymmetric_result *r, fault *f)
{
    const size_t n = (size_t)p->K->n;
    unsymmetric_solver s = {.p = p, .out = r, .n = p->K->n, .second = 1};
    memset(r, 0, sizeof *r);
    r->n = s.n;
    s.scale = calloc(5 * n + 1, sizeof *s.scale);
    s.of = calloc(n + 1, sizeof *s.of);
    status outcome = STATUS_FAULT;
    if (s.scale == NULL || s.of == NULL) {
        fault_memory(f, "modes");
    } else {
        outcome = take_mass(&s, f);
    }
    if (outcome == STATUS_OK) {
        s.x = s.scale + n;
        s.y = s.x + n;
        measure(&s);
        if (p->C != NULL && s.n > 0)
            find_second(&s, s.y + n, s.y + 2 * n);
        if (p->C != NULL)
            scale_integrals(&s, s.y);
        outcome = pairs(&s, 0, &s.right, f);
        if (outcome == STATUS_OK && p->shift > 0)
            sort(&s);
        if (outcome == STATUS_OK)
            outcome = store_results(&s, f);
    }
    free(s.scale);
    free(s.of);
    arnoldi_free(&s.right);
    arnoldi_free(&s.left);
    free(s.M.column);
    free(s.M.row);
    free(s.M.value);
    return outcome;
}
