/* LDL^T for symmetric and LU for unsymmetric matrices. A check shows if a small pivot is only a
 * rounding error. With x = A^-1 e_i and y = A^-T e_k, the number x_k = y^T A x is a sum of terms
 * y_i a_ij x_j. Rounding of A changes x_k by about eps times the square root of the sum of the
 * squares of these terms. If this change exceeds a quarter of x_k, A is singular to working
 * precision. */
#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <klu.h>
#include <math.h>
#include <stdlib.h>

static status factor_unsymmetric_alloc(const sparse *pattern, factor_unsymmetric **out,
                                       factor_counts *counts, fault *f);
/* Factors the values. Returns OK, SINGULAR, or FAULT if out of memory. The first pivot order is
 * used again for all later matrices, without allocation, until pivot growth requires a new order.
 * *ratio: smallest magnitude of a pivot relative to the largest entry of its column, after every
 * row is divided by its largest entry. *row, *column: position of this pivot. */
static status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a,
                                         factor_counts *counts, int *row, int *column,
                                         double *ratio);

struct matrix_factor {
    int n;
    factor_operator by;
    factor_symmetric *symmetric; /* LDL^T; a matrix with by_numbers has both factors */
    factor_unsymmetric *unsymmetric;
    by_numbers *whole;
    int upper;
    factor_counts counts, of_upper;
    double *residual, *other; /* [n] work space; `other` is only for unsymmetric matrices */
};

static status begin(const sparse *pattern, matrix_factor **out, fault *f)
{
    matrix_factor *fa = *out = calloc(1, sizeof *fa);
    if (fa == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fa->n = pattern->n;
    fa->upper = pattern->symmetric;
    fa->counts.condition = fa->counts.determinant = 1;
    fa->counts.negative_pivots = pattern->symmetric ? 0 : -1;
    fa->residual = malloc(((size_t)fa->n + 1) * sizeof *fa->residual);
    if (!pattern->symmetric)
        fa->other = malloc(((size_t)fa->n + 1) * sizeof *fa->other);
    return fa->residual != NULL && (pattern->symmetric || fa->other != NULL)
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for factors");
}

status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f)
{
    TRY(begin(pattern, out, f));
    matrix_factor *fa = *out;
    if (fa->n == 0)
        return STATUS_OK;
    if (pattern->symmetric)
        return factor_symmetric_alloc(pattern, &fa->symmetric, &fa->counts, f);
    if (pattern->by_numbers)
        TRY(by_numbers_alloc(pattern, &fa->whole, f));
    return factor_unsymmetric_alloc(pattern, &fa->unsymmetric, &fa->counts, f);
}

status factor_alloc_like(const matrix_factor *of, const sparse *pattern, matrix_factor **out,
                         fault *f)
{
    if (of->symmetric == NULL || !pattern->symmetric)
        return factor_alloc(pattern, out, f);
    const factor_counts *counts = of->whole != NULL ? &of->of_upper : &of->counts;
    TRY(begin(pattern, out, f));
    (*out)->counts.entries = counts->entries;
    (*out)->counts.flops = counts->flops;
    return factor_symmetric_alloc_like(of->symmetric, &(*out)->symmetric, f);
}

status factor_of(const factor_operator *by, matrix_factor **out, fault *f)
{
    matrix_factor *fa = *out = calloc(1, sizeof *fa);
    if (fa == NULL) {
        by->free(by->context);
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    }
    fa->by = *by;
    return STATUS_OK;
}

void factor_free(matrix_factor *fa)
{
    if (fa == NULL)
        return;
    if (fa->by.free != NULL)
        fa->by.free(fa->by.context);
    factor_symmetric_free(fa->symmetric);
    factor_unsymmetric_free(fa->unsymmetric);
    by_numbers_free(fa->whole);
    free(fa->residual);
    free(fa->other);
    free(fa);
}

static void unit_vector(int n, int i, double e[])
{
    for (int k = 0; k < n; k++)
        e[k] = 0;
    e[i] = 1;
}

/* Returns the fraction of x_column that is a rounding error, where x = A^-1 e_row. */
static double lost_part(matrix_factor *fa, const sparse *a, int row, int column)
{
    double *x = fa->residual, *y = fa->residual, sum = 0;
    unit_vector(fa->n, row, x);
    factor_solve(fa, x);
    if (!fa->upper) {
        y = fa->other;
        unit_vector(fa->n, column, y);
        factor_unsymmetric_solve_transposed(fa->unsymmetric, y);
    }
    const double scale = fabs(x[column]);
    for (int j = 0; j < fa->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const double term = y[a->row[k]] / scale * a->value[k] * x[j];
            sum += (a->symmetric && a->row[k] != j ? 2 : 1) * term * term;
        }
    return DBL_EPSILON * sqrt(sum);
}

static status choose(matrix_factor *fa, const sparse **a, fault *f)
{
    const factor_counts before = fa->counts;
    fa->counts.asymmetry = by_numbers_take(fa->whole, *a);
    fa->upper = fa->counts.asymmetry <= FACTOR_SYMMETRIC_WITHIN;
    fa->counts.negative_pivots = -1;
    if (!fa->upper)
        return STATUS_OK;
    *a = by_numbers_upper(fa->whole);
    if (fa->symmetric == NULL) {
        fa->of_upper = before;
        TRY(factor_symmetric_alloc(*a, &fa->symmetric, &fa->of_upper, f));
    }
    return STATUS_OK;
}

status factor_report_singular(fault *f)
{
    return fault_set(f, STATUS_SINGULAR,
                     "the stiffness matrix is singular; check supports, releases and stiffnesses");
}

status factor_numeric(matrix_factor *fa, const sparse *a, fault *f)
{
    const double n = fa->n, lost = 0.25;
    int row = 0, column = 0;
    double ratio = 1;
    status outcome = STATUS_OK;
    fa->counts.factorisations++;
    fa->counts.lost = 0;
    if (fa->whole != NULL)
        TRY(choose(fa, &a, f));
    if (fa->upper && fa->symmetric != NULL) {
        outcome = factor_symmetric_numeric(fa->symmetric, a, &fa->counts, &row, &ratio);
        column = row;
    } else if (!fa->upper && fa->unsymmetric != NULL) {
        outcome =
            factor_unsymmetric_numeric(fa->unsymmetric, a, &fa->counts, &row, &column, &ratio);
    }
    if (outcome == STATUS_OK && ratio <= n * n * n * DBL_EPSILON &&
        !(lost_part(fa, a, row, column) < lost)) {
        fa->counts.lost = 1;
        outcome = STATUS_SINGULAR;
    }
    if (outcome == STATUS_SINGULAR)
        factor_report_singular(f);
    else if (outcome == STATUS_FAULT)
        fault_set(f, outcome, "out of memory for the factors of %d unknowns", fa->n);
    return outcome;
}

void factor_solve(matrix_factor *fa, double x[])
{
    factor_solve_many(fa, 1, fa->n, x);
}

void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[])
{
    for (int c = 0; c < columns && fa->by.solve != NULL; c++)
        fa->by.solve(fa->by.context, 0, x + c * stride);
    if (fa->by.solve == NULL && fa->upper && fa->symmetric != NULL)
        factor_symmetric_solve(fa->symmetric, columns, stride, x);
    if (fa->by.solve == NULL && !fa->upper && fa->unsymmetric != NULL)
        factor_unsymmetric_solve(fa->unsymmetric, columns, stride, x);
}

void factor_solve_transposed(matrix_factor *fa, double x[])
{
    if (fa->by.solve != NULL)
        fa->by.solve(fa->by.context, 1, x);
    else if (!fa->upper && fa->unsymmetric != NULL)
        factor_unsymmetric_solve_transposed(fa->unsymmetric, x);
    else
        factor_solve(fa, x);
}

factor_counts factor_count(const matrix_factor *fa)
{
    if (fa->by.count != NULL)
        return fa->by.count(fa->by.context);
    factor_counts counts = fa->counts;
    if (fa->whole != NULL && fa->upper) {
        counts.entries = fa->of_upper.entries;
        counts.flops = fa->of_upper.flops;
    }
    return counts;
}

int factor_is_symmetric(const matrix_factor *fa)
{
    return factor_count(fa).negative_pivots >= 0;
}

const sparse *factor_upper(const matrix_factor *fa)
{
    return fa->whole != NULL && fa->upper ? by_numbers_upper(fa->whole) : NULL;
}

/* Hager's estimate of the 1-norm condition number (W.W. Hager, SIAM J. Sci. Stat. Comput. 5, 1984),
 * which needs only solutions. Translations, rotations and warping have different units, and the
 * condition number should not depend on the units. Therefore rows and columns are divided by the
 * square roots of the diagonal. For a positive definite matrix, this scaling is within a factor n
 * of the best scaling (A. van der Sluis, Numer. Math. 14, 1969). */

enum { MOST_STEPS = 5 };

typedef struct condition {
    matrix_factor *fa;
    int n;
    const double *scale; /* [n] diagonal of S in the scaled matrix S A S */
} condition;

/* Replaces x by (S A S)^-1 x. transposed 1: replaces x by (S A S)^-T x. */
static void solve_scaled(const condition *c, int transposed, double x[])
{
    for (int i = 0; i < c->n; i++)
        x[i] /= c->scale[i];
    if (transposed)
        factor_solve_transposed(c->fa, x);
    else
        factor_solve(c->fa, x);
    for (int i = 0; i < c->n; i++)
        x[i] /= c->scale[i];
}

/* Estimates |(S A S)^-1|_1: searches for the largest column sum in steps along the subgradient. x,
 * z: work space [n]. */
static double inverse_norm(const condition *c, double x[], double z[])
{
    const int n = c->n;
    double norm = 0;
    for (int i = 0; i < n; i++)
        x[i] = 1.0 / n;
    for (int step = 0; step < MOST_STEPS; step++) {
        double sum = 0, along = 0;
        int largest = 0;
        for (int i = 0; i < n; i++)
            z[i] = x[i];
        solve_scaled(c, 0, z);
        for (int i = 0; i < n; i++)
            sum += fabs(z[i]);
        if (!(sum > norm) && step > 0)
            break;
        norm = sum;
        for (int i = 0; i < n; i++)
            z[i] = z[i] >= 0 ? 1 : -1;
        solve_scaled(c, 1, z);
        for (int i = 0; i < n; i++) {
            along += z[i] * x[i];
            if (fabs(z[i]) > fabs(z[largest]))
                largest = i;
        }
        if (fabs(z[largest]) <= along)
            break;
        for (int i = 0; i < n; i++)
            x[i] = i == largest;
    }
    return norm;
}

/* Computes the scale of every unknown, and returns the norm of S A S. sum: work space [n]. */
static double scaled_norm(const sparse *a, double scale[], double sum[])
{
    double norm = 0;
    for (int j = 0; j < a->n; j++) {
        scale[j] = 1;
        sum[j] = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            if (a->row[k] == j && a->value[k] != 0)
                scale[j] = 1 / sqrt(fabs(a->value[k]));
    }
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            const double size = fabs(a->value[k]) * scale[i] * scale[j];
            sum[j] += size;
            if (a->symmetric && i != j)
                sum[i] += size;
        }
    for (int j = 0; j < a->n; j++)
        norm = fmax(norm, sum[j]);
    return norm;
}

double factor_condition(matrix_factor *fa, const sparse *a)
{
    const size_t n = (size_t)a->n;
    double *work = malloc((3 * n + 1) * sizeof *work), estimate = NAN;
    if (work == NULL)
        return estimate;
    const double norm = scaled_norm(a, work, work + n);
    const condition c = {fa, a->n, work};
    estimate = n == 0 ? 1 : norm * inverse_norm(&c, work + n, work + 2 * n);
    free(work);
    return estimate;
}

/* Factor of KLU, which scales every row by its largest entry and orders by AMD on A + A^T. Diagonal
 * pivots are preferred. */

struct factor_unsymmetric {
    int n;
    klu_common common;
    klu_symbolic *symbolic;
    klu_numeric *numeric;
    double *largest;
};

/* The pivot order is reused as long as the entries of U are below this factor times the entries of
 * the matrix. */
static const double tolerable_growth = 1e4;

static status factor_unsymmetric_alloc(const sparse *pattern, factor_unsymmetric **out,
                                       factor_counts *counts, fault *f)
{
    factor_unsymmetric *fu = *out = calloc(1, sizeof *fu);
    if (fu == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fu->n = pattern->n;
    counts->negative_pivots = -1;
    klu_defaults(&fu->common);
    fu->largest = malloc((size_t)fu->n * sizeof *fu->largest);
    fu->symbolic = klu_analyze(fu->n, pattern->column, pattern->row, &fu->common);
    if (fu->largest != NULL && fu->symbolic != NULL)
        return STATUS_OK;
    if (fu->common.status == KLU_SINGULAR)
        return fault_set(f, STATUS_SINGULAR,
                         "the matrix is structurally singular, because a part is not supported; "
                         "support this part");
    return fault_set(f, STATUS_FAULT, "out of memory for ordering %d unknowns", fu->n);
}

void factor_unsymmetric_free(factor_unsymmetric *fu)
{
    if (fu == NULL)
        return;
    klu_free_numeric(&fu->numeric, &fu->common);
    klu_free_symbolic(&fu->symbolic, &fu->common);
    free(fu->largest);
    free(fu);
}

/* Factors `a` with the pivot order of an earlier matrix. Returns 0 if there is no earlier matrix,
 * or if this order is not accurate for `a`. */
static int refactor(factor_unsymmetric *fu, const sparse *a)
{
    return fu->numeric != NULL &&
           klu_refactor(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.status == KLU_OK &&
           klu_rgrowth(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.rgrowth * tolerable_growth > 1;
}

static status factor_anew(factor_unsymmetric *fu, const sparse *a, factor_counts *counts)
{
    klu_free_numeric(&fu->numeric, &fu->common);
    fu->numeric = klu_factor(a->column, a->row, a->value, fu->symbolic, &fu->common);
    if (fu->numeric == NULL)
        return fu->common.status == KLU_SINGULAR ? STATUS_SINGULAR : STATUS_FAULT;
    klu_flops(fu->symbolic, fu->numeric, &fu->common);
    counts->entries = (long)fu->numeric->lnz + fu->numeric->unz - fu->n;
    counts->flops = fu->common.flops;
    return STATUS_OK;
}

/* Returns the sign of a permutation. A cycle of k members consists of k - 1 exchanges. done: work
 * space. */
static int sign_of(int n, const int permutation[], double done[])
{
    int sign = 1;
    for (int i = 0; i < n; i++)
        done[i] = 0;
    for (int i = 0; i < n; i++)
        for (int k = i, length = 0; done[k] == 0; k = permutation[k], length++) {
            done[k] = 1;
            sign = length == 0 ? sign : -sign;
        }
    return sign;
}

/* Returns the sign of the determinant. P R^-1 A Q is block triangular and has the pivots on its
 * diagonal. */
static int determinant_of(factor_unsymmetric *fu)
{
    int sign = sign_of(fu->n, fu->numeric->Pnum, fu->largest) *
               sign_of(fu->n, fu->symbolic->Q, fu->largest);
    for (int k = 0; k < fu->n; k++)
        sign = ((const double *)fu->numeric->Udiag)[k] < 0 ? -sign : sign;
    return sign;
}

static status check_pivots(factor_unsymmetric *fu, const sparse *a, factor_counts *counts, int *row,
                           int *column, double *ratio)
{
    const klu_numeric *u = fu->numeric;
    const double *pivot = u->Udiag;
    double largest = 0, smallest = INFINITY;
    for (int j = 0; j < fu->n; j++) {
        fu->largest[j] = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            fu->largest[j] = fmax(fu->largest[j], fabs(a->value[k]) / u->Rs[u->Pinv[a->row[k]]]);
    }
    *ratio = INFINITY;
    for (int k = 0; k < fu->n; k++) {
        const double d = fabs(pivot[k]), part = d / fu->largest[fu->symbolic->Q[k]];
        if (!isfinite(d) || d == 0)
            return STATUS_SINGULAR;
        if (part < *ratio) {
            *ratio = part;
            *row = u->Pnum[k];
            *column = fu->symbolic->Q[k];
        }
        largest = fmax(largest, d);
        smallest = fmin(smallest, d);
    }
    counts->condition = largest / smallest;
    return STATUS_OK;
}

static status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a,
                                         factor_counts *counts, int *row, int *column,
                                         double *ratio)
{
    if (!refactor(fu, a)) {
        TRY(factor_anew(fu, a, counts));
    }
    counts->determinant = determinant_of(fu);
    return check_pivots(fu, a, counts, row, column, ratio);
}

void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[])
{
    klu_solve(fu->symbolic, fu->numeric, stride, columns, x, &fu->common);
}

void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[])
{
    klu_tsolve(fu->symbolic, fu->numeric, fu->n, 1, x, &fu->common);
}
