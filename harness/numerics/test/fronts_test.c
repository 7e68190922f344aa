/* LU by fronts compared with LAPACK: chains of nodes, random patterns, and the matrix of three
 * stages of a step. Matrices that need exchanges of rows must go to KLU, and both builds of the
 * kernels must give the same bits. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/real.h"
#include "elements/test/kit.h"
#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/matrices.h"

enum { MOST = 90 };

/* Fills an unsymmetric matrix with a symmetric pattern: blocks of `size` unknowns, each coupled to
 * the previous block and to one earlier block. */
static void fill(int n, int size, uint64_t *seed, double A[])
{
    memset(A, 0, (size_t)(n * n) * sizeof *A);
    for (int j = 0; j < n; j++) {
        const int block = j / size, other = random_below(seed, block + 1);
        for (int i = 0; i < j; i++)
            if (i / size >= block - 1 || i / size == other) {
                A[i * n + j] = random_number(seed);
                A[j * n + i] = random_number(seed);
            }
        A[(n + 1) * j] = (0.5 + size) * (random_number(seed) < 0 ? -1 : 1);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            A[i * n + j] *= (i % 3 == 0 ? 1e3 : 1) * (j % 3 == 0 ? 1e3 : 1);
}

/* Returns the largest error of a solution with and without transposition, relative to the largest
 * component. */
static double error_of(factor_unsymmetric *fu, int n, const double A[], uint64_t *seed)
{
    enum { SIDES = 3 };
    double worst = 0;
    for (int transposed = 0; transposed < 2; transposed++) {
        double copy[MOST * MOST], x[SIDES * MOST], exact[SIDES * MOST];
        int pivot[MOST];
        memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
        for (int i = 0; i < SIDES * n; i++)
            x[i] = exact[i] = random_number(seed) * (i % n % 3 == 0 ? 1e3 : 1);
        LAPACKE_dgesv(transposed ? LAPACK_COL_MAJOR : LAPACK_ROW_MAJOR, n, 1, copy, n, pivot, exact,
                      transposed ? n : 1);
        for (int c = 1; c < SIDES; c++)
            LAPACKE_dgetrs(transposed ? LAPACK_COL_MAJOR : LAPACK_ROW_MAJOR, 'N', n, 1, copy, n,
                           pivot, exact + (size_t)c * (size_t)n, transposed ? n : 1);
        if (!transposed)
            factor_unsymmetric_solve(fu, SIDES, n, x);
        for (int c = 0; c < SIDES && transposed; c++)
            factor_unsymmetric_solve_transposed(fu, x + (size_t)c * (size_t)n);
        double apart = 0, scale = 0;
        for (int i = 0; i < SIDES * n; i++) {
            const double unit = i % n % 3 == 0 ? 1e3 : 1;
            apart = worst_of(apart, fabs(x[i] - exact[i]) * unit);
            scale = fmax(scale, fabs(exact[i]) * unit);
        }
        worst = worst_of(worst, apart / scale);
    }
    return worst;
}

typedef struct factored {
    status outcome;
    int by_fronts, determinant;
    double error;
} factored;

/* Factors A twice, the second time with other values. */
static factored factor(int n, int copies, const double A[])
{
    uint64_t seed = 17;
    factored out = {.outcome = STATUS_FAULT};
    factor_counts counts = {0};
    int row, column;
    double ratio;
    sparse s = matrices_from_dense(n, 0, A);
    factor_unsymmetric *fu;
    if (factor_unsymmetric_alloc(&s, copies, &fu, &counts, NULL) == STATUS_OK) {
        for (int k = 0; k < s.column[n]; k++)
            s.value[k] *= 2;
        factor_unsymmetric_numeric(fu, &s, &counts, &row, &column, &ratio);
        for (int k = 0; k < s.column[n]; k++)
            s.value[k] /= 2;
        out.outcome = factor_unsymmetric_numeric(fu, &s, &counts, &row, &column, &ratio);
    }
    if (out.outcome == STATUS_OK) {
        out.by_fronts = factor_unsymmetric_has_fronts(fu);
        out.determinant = counts.determinant;
        out.error = error_of(fu, n, A, &seed);
    }
    factor_unsymmetric_free(fu);
    matrices_free(&s);
    return out;
}

static int determinant_sign(int n, const double A[])
{
    double copy[MOST * MOST];
    int pivot[MOST], sign = 1;
    memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
    LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, copy, n, pivot);
    for (int i = 0; i < n; i++)
        sign = (pivot[i] != i + 1) != (copy[(n + 1) * i] < 0) ? -sign : sign;
    return sign;
}

static void chains_of_nodes(void)
{
    static double A[MOST * MOST];
    uint64_t seed = 3;
    for (int size = 1; size <= 9; size++)
        for (int n = size; n <= MOST; n += 1 + 2 * size) {
            fill(n, size, &seed, A);
            const factored is = factor(n, 1, A);
            gsl_test(is.outcome != STATUS_OK || !is.by_fronts, "%d unknowns by fronts", n);
            gsl_test(!(is.error <= 1e-11), "%d unknowns in blocks of %d: error %g", n, size,
                     is.error);
            gsl_test_int(is.determinant, determinant_sign(n, A), "sign of the determinant");
        }
}

/* The matrix of the stages of Radau IIA is B^2 m + k for one mass m on a spring k. In the order of
 * the stages, its second pivot is almost zero if k is small. */
static void stages_of_a_step(void)
{
    enum { NODES = 30, SIZE = 3 * NODES };
    static const double B[9] = {3.2247448713915890,  1.1678400846904055,  -0.25319726474218083,
                                -3.5678400846904055, 0.7752551286084110,  1.0531972647421808,
                                5.5319726474218083,  -7.5319726474218083, 5.0};
    static double A[SIZE * SIZE];
    for (double k = 1e-6; k < 1e6; k *= 3) {
        memset(A, 0, sizeof A);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int a = 0; a < NODES; a++)
                    for (int l = 0; l < 3; l++)
                        A[(i * NODES + a) * SIZE + j * NODES + a] += B[3 * i + l] * B[3 * l + j];
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < NODES; a++) {
                double *row = A + (i * NODES + a) * SIZE + i * NODES + a;
                row[0] += k * 2;
                if (a > 0)
                    row[-1] -= k;
                if (a + 1 < NODES)
                    row[1] -= 1.01 * k;
            }
        const factored is = factor(SIZE, 3, A);
        gsl_test(is.outcome != STATUS_OK || !is.by_fronts, "stages with stiffness %g by fronts", k);
        gsl_test(!(is.error <= 1e-11), "stages with stiffness %g: error %g", k, is.error);
    }
}

static void exchanges_of_rows(void)
{
    static const struct {
        const char *name;
        double A[9];
    } sample[] = {{"a zero pivot", {0, 1, 2, 3, 1, 1, 1, 1, 5}},
                  {"a small pivot", {1e-9, 1, 2, 3, 1, 1, 1, 1, 5}},
                  {"a pivot that vanishes", {1, 1, 2, 3, 3 + 1e-9, 1, 1, 2, 5}},
                  {"an unsymmetric pattern", {1, 1, 0, 0, 1, 1, 1, 1, 5}}};
    for (size_t i = 0; i < sizeof sample / sizeof sample[0]; i++) {
        const factored is = factor(3, 1, sample[i].A);
        gsl_test(is.outcome != STATUS_OK || is.by_fronts, "%s: by KLU", sample[i].name);
        gsl_test(!(is.error <= 1e-12), "%s: error %g", sample[i].name, is.error);
    }
}

static void same_bits(void)
{
    static double A[MOST * MOST];
    uint64_t seed = 7;
    fill(MOST, 6, &seed, A);
    sparse s = matrices_from_dense(MOST, 0, A);
    factor_counts counts;
    fronts_pivots pivots[2];
    fronts *one = fronts_alloc(&s, 1, &counts), *two = fronts_alloc(&s, 1, &counts);
    gsl_test(one == NULL || two == NULL, "memory for fronts");
    if (one != NULL && two != NULL) {
        double x[MOST], y[MOST];
        for (int i = 0; i < MOST; i++)
            x[i] = y[i] = random_number(&seed);
        gsl_test(!triangular_fronts_factor_plain(one, s.value, &pivots[0]), "plain");
        gsl_test(!REAL_CHOSEN(triangular_fronts_factor)(two, s.value, &pivots[1]), "AVX2");
        gsl_test(memcmp(one->value, two->value, one->size * sizeof *one->value) != 0,
                 "factors have the same bits");
        triangular_fronts_solve_plain(one, 1, MOST, x);
        REAL_CHOSEN(triangular_fronts_solve)(two, 1, MOST, y);
        gsl_test(memcmp(x, y, sizeof x) != 0, "solutions have the same bits");
    }
    fronts_free(one);
    fronts_free(two);
    matrices_free(&s);
}

int main(void)
{
    chains_of_nodes();
    stages_of_a_step();
    exchanges_of_rows();
    same_bits();
    return gsl_test_summary();
}
