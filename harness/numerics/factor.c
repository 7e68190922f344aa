/* LDL^T for symmetric and LU for unsymmetric matrices. A check shows if a small pivot is only a
 * rounding error. With x = A^-1 e_i and y = A^-T e_k, the number x_k = y^T A x is a sum of terms
 * y_i a_ij x_j. Rounding of A changes x_k by about eps times the square root of the sum of the
 * squares of these terms. If this change exceeds a quarter of x_k, A is singular to working
 * precision. */
#include "harness/numerics/numerics_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

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
        return fault_memory(f, "factors");
    fa->n = pattern->n;
    fa->upper = pattern->symmetric;
    fa->counts.condition = fa->counts.determinant = 1;
    fa->counts.negative_pivots = pattern->symmetric ? 0 : -1;
    fa->residual = malloc(((size_t)fa->n + 1) * sizeof *fa->residual);
    if (!pattern->symmetric)
        fa->other = malloc(((size_t)fa->n + 1) * sizeof *fa->other);
    return fa->residual != NULL && (pattern->symmetric || fa->other != NULL)
               ? STATUS_OK
               : fault_memory(f, "factors");
}

status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f)
{
    return factor_alloc_copies(pattern, 0, out, f);
}

status factor_alloc_copies(const sparse *pattern, int copies, matrix_factor **out, fault *f)
{
    TRY(begin(pattern, out, f));
    matrix_factor *fa = *out;
    if (fa->n == 0)
        return STATUS_OK;
    if (pattern->symmetric)
        return factor_symmetric_alloc(pattern, &fa->symmetric, &fa->counts, f);
    if (pattern->by_numbers)
        TRY(by_numbers_alloc(pattern, &fa->whole, f));
    return factor_unsymmetric_alloc(pattern, copies, &fa->unsymmetric, &fa->counts, f);
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
        return fault_memory(f, "factors");
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

static _Thread_local numerics_work done;

numerics_work numerics_work_done(void)
{
    return done;
}

numerics_work numerics_work_since(const numerics_work *start)
{
    return (numerics_work){
        done.solutions - start->solutions, done.solved_entries - start->solved_entries,
        done.factor_flops - start->factor_flops, done.dense_operations - start->dense_operations};
}

void numerics_work_add(const numerics_work *more)
{
    done.solutions += more->solutions;
    done.solved_entries += more->solved_entries;
    done.factor_flops += more->factor_flops;
    done.dense_operations += more->dense_operations;
}

void numerics_work_add_dense(double n)
{
    done.dense_operations += n * n * n;
}

/* Adds the solutions with a factor that is not an operator, whose parts add their own work. */
static void add_solutions(const matrix_factor *fa, int columns)
{
    if (fa->by.solve == NULL)
        numerics_work_add(
            &(numerics_work){.solutions = columns,
                             .solved_entries = (double)columns * (double)factor_count(fa).entries});
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
    done.factor_flops += factor_count(fa).flops;
    if (outcome == STATUS_OK && ratio <= n * n * n * DBL_EPSILON &&
        !(lost_part(fa, a, row, column) < lost)) {
        fa->counts.lost = 1;
        outcome = STATUS_SINGULAR;
    }
    if (outcome == STATUS_SINGULAR)
        factor_report_singular(f);
    else if (outcome == STATUS_FAULT)
        fault_memory(f, "the factors of %d unknowns", fa->n);
    return outcome;
}

void factor_solve(matrix_factor *fa, double x[])
{
    factor_solve_many(fa, 1, fa->n, x);
}

void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[])
{
    add_solutions(fa, columns);
    for (int c = 0; c < columns && fa->by.solve != NULL; c++)
        fa->by.solve(fa->by.context, 0, x + c * stride);
    if (fa->by.solve == NULL && fa->upper && fa->symmetric != NULL)
        factor_symmetric_solve(fa->symmetric, TRIANGULAR_WHOLE, columns, stride, x);
    if (fa->by.solve == NULL && !fa->upper && fa->unsymmetric != NULL)
        factor_unsymmetric_solve(fa->unsymmetric, columns, stride, x);
}

void factor_solve_root(matrix_factor *fa, triangular_part part, int columns, int stride, double x[])
{
    const double entries = (double)factor_count(fa).entries;
    numerics_work_add(&(numerics_work){.solutions = part == TRIANGULAR_ROOT ? columns : 0,
                                       .solved_entries = columns * entries / 2});
    factor_symmetric_solve(fa->symmetric, part, columns, stride, x);
}

void factor_solve_transposed(matrix_factor *fa, double x[])
{
    if (fa->by.solve != NULL)
        fa->by.solve(fa->by.context, 1, x);
    else if (!fa->upper && fa->unsymmetric != NULL) {
        add_solutions(fa, 1);
        factor_unsymmetric_solve_transposed(fa->unsymmetric, x);
    } else
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
