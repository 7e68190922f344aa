/* Sparse factors against LAPACK on random matrices, inertia, condition and the work that is
 * counted. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <stdio.h>

#include "elements/math/dense.h"
#include "harness/numerics/test/matrices.h"

enum { MOST = 60 };

typedef enum kind { DEFINITE, INDEFINITE, UNSYMMETRIC } kind;

/* About four entries in every row beside the diagonal; rows and columns in units that differ by up
 * to 1e3. */
static void fill_random(int n, kind what, uint64_t *seed, double A[])
{
    memset(A, 0, (size_t)(n * n) * sizeof *A);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 4; k++) {
            const int j = (int)((random_number(seed) + 1) / 2 * n);
            const double value = random_number(seed);
            if (what == UNSYMMETRIC) {
                A[i * n + j] += value;
            } else if (i != j) { /* Laplacian: positive definite once the diagonal has more */
                A[i * n + j] -= fabs(value);
                A[j * n + i] -= fabs(value);
                A[i * n + i] += fabs(value);
                A[j * n + j] += fabs(value);
            }
        }
    for (int i = 0; i < n; i++) {
        const double other = what == INDEFINITE ? 4 * random_number(seed) : 1;
        A[i * n + i] += what == DEFINITE ? 0.03 : other;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            A[i * n + j] *= (i % 3 == 0 ? 1e3 : 1) * (j % 3 == 0 ? 1e3 : 1);
}

/* Relative to the rounding error that elimination with pivoting makes. */
static double distance_from_dense(int n, const double A[], const double x[], const double b[])
{
    double copy[MOST * MOST] = {0}, dense[MOST], worst = 0, scale = 0, norm, condition;
    int pivot[MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            copy[i * n + j] = A[i * n + j] / ((i % 3 == 0 ? 1e3 : 1) * (j % 3 == 0 ? 1e3 : 1));
    norm = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, copy, n);
    for (int i = 0; i < n; i++)
        dense[i] = b[i] / (i % 3 == 0 ? 1e3 : 1);
    LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, 1, copy, n, pivot, dense, 1);
    LAPACKE_dgecon(LAPACK_ROW_MAJOR, '1', n, copy, n, norm, &condition);
    for (int i = 0; i < n; i++) {
        worst = fmax(worst, fabs(x[i] * (i % 3 == 0 ? 1e3 : 1) - dense[i]));
        scale = fmax(scale, fabs(dense[i]));
    }
    return worst / scale * condition / DBL_EPSILON;
}

static int negative_eigenvalues(int n, const double A[])
{
    double copy[MOST * MOST], w[MOST];
    int count = 0;
    memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', n, copy, n, w);
    for (int i = 0; i < n; i++)
        count += w[i] < 0;
    return count;
}

/* 1-norm condition of S A S with the roots of A's diagonal as 1/S, by the inverse. */
static double scaled_condition(int n, const double A[])
{
    double scaled[MOST * MOST] = {0}, norm[2];
    int pivot[MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double size = fabs(A[i * n + i] != 0 ? A[i * n + i] : 1) *
                                fabs(A[j * n + j] != 0 ? A[j * n + j] : 1);
            scaled[i * n + j] = A[i * n + j] / sqrt(size);
        }
    norm[0] = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, scaled, n);
    LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, scaled, n, pivot);
    LAPACKE_dgetri(LAPACK_ROW_MAJOR, n, scaled, n, pivot);
    norm[1] = LAPACKE_dlange(LAPACK_ROW_MAJOR, '1', n, n, scaled, n);
    return norm[0] * norm[1];
}

/* Sign of the determinant by Gaussian elimination. */
static int determinant_sign(int n, const double A[])
{
    double copy[MOST * MOST];
    int pivot[MOST], sign = 1;
    memcpy(copy, A, (size_t)(n * n) * sizeof *copy);
    LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, copy, n, pivot);
    for (int i = 0; i < n; i++)
        sign = (pivot[i] != i + 1) != (copy[i * n + i] < 0) ? -sign : sign;
    return sign;
}

/* Of right-hand sides that are solved together how many are not what each is alone, to the bit;
 * what stands between them stays. */
static int apart_together(matrix_factor *fa, uint64_t *seed)
{
    enum { SIDES = 7, STRIDE = MOST + 2 };
    double together[SIDES * STRIDE], alone[SIDES * STRIDE];
    for (int i = 0; i < SIDES * STRIDE; i++)
        together[i] = alone[i] = random_number(seed);
    factor_solve_many(fa, SIDES, STRIDE, together);
    for (int c = 0; c < SIDES; c++)
        factor_solve(fa, alone + (size_t)c * STRIDE);
    int apart = 0;
    for (int i = 0; i < SIDES * STRIDE; i++)
        apart += !(together[i] == alone[i]);
    return apart;
}

static void random_matrices(kind what, const char *name, double allowed)
{
    uint64_t seed = 2385;
    double worst = 0, least_condition = INFINITY, most_condition = 0;
    int wrong_inertia = 0, wrong_sign = 0, failures = 0, most_negative = 0, apart = 0;
    for (int sample = 0; sample < 40; sample++) {
        const int n = 2 + sample * (MOST - 2) / 39;
        double A[MOST * MOST], b[MOST], x[MOST];
        fill_random(n, what, &seed, A);
        sparse s = matrices_from_dense(n, what != UNSYMMETRIC, A);
        matrix_factor *fa;
        failures += factor_alloc(&s, &fa, NULL) != STATUS_OK;
        for (int turn = 0; turn < 2;
             turn++) { /* the second time with other numbers on the same pattern */
            for (int k = 0; k < s.column[n]; k++)
                s.value[k] *= turn == 0 ? 1 : -0.3;
            for (int i = 0; i < n * n; i++)
                A[i] *= turn == 0 ? 1 : -0.3;
            failures += factor_numeric(fa, &s, NULL) != STATUS_OK;
            wrong_sign += factor_count(fa).determinant != determinant_sign(n, A);
            if (what != UNSYMMETRIC) {
                const int expected = negative_eigenvalues(n, A),
                          found = factor_count(fa).negative_pivots;
                wrong_inertia += found != expected;
                most_negative = found > most_negative ? found : most_negative;
            }
            const double condition = factor_condition(fa, &s) / scaled_condition(n, A);
            least_condition = fmin(least_condition, condition);
            most_condition = fmax(most_condition, condition);
            for (int i = 0; i < n; i++)
                b[i] = x[i] = random_number(&seed);
            factor_solve(fa, x);
            worst = fmax(worst, distance_from_dense(n, A, x, b));
            apart += apart_together(fa, &seed);
        }
        gsl_test(factor_count(fa).entries < n || factor_count(fa).flops <= 0,
                 "%s matrix of %d: work is counted", name, n);
        factor_free(fa);
        matrices_free(&s);
    }
    gsl_test(!(least_condition > 0.3 && most_condition < 1 + 1e-9),
             "%s: the condition is estimated as %.2f to %.2f of what it is", name, least_condition,
             most_condition);
    gsl_test_int(failures, 0, "%s: all samples are factorised", name);
    gsl_test_int(apart, 0, "%s: solutions made together are those made alone", name);
    gsl_test_int(wrong_sign, 0, "%s: the sign of the determinant", name);
    if (what != UNSYMMETRIC)
        gsl_test_int(wrong_inertia, 0,
                     "%s: negative pivots are the negative eigenvalues (up to %d)", name,
                     most_negative);
    gsl_test(!(worst < allowed), "%s: as LAPACK within %.1f eps times the condition", name, worst);
}

/* The upper triangle and the whole of a symmetric matrix have one condition: of a chain of n
 * springs held at one end, with rows and columns scaled to a diagonal of ones, that is the exact
 * 1-norm. */
static void condition_of_a_triangle(void)
{
    enum { N = 6 };
    int column[N + 1] = {0}, row[3 * N], whole_column[N + 1] = {0}, whole_row[3 * N];
    double value[3 * N], whole_value[3 * N], dense[N * N] = {0}, inverse[N * N] = {0},
                                                       norm[2] = {0};
    int count = 0, whole = 0, pivot[N];
    for (int j = 0; j < N; j++) {
        for (int i = j > 0 ? j - 1 : 0; i <= j + 1 && i < N; i++) {
            const double scale = (i == N - 1 ? 1 : sqrt(2)) * (j == N - 1 ? 1 : sqrt(2));
            const double diagonal = j == N - 1 ? 1 : 2, entry = i != j ? -1 : diagonal;
            dense[i * N + j] = entry / scale;
            whole_row[whole] = i;
            whole_value[whole++] = entry;
            if (i <= j) {
                row[count] = i;
                value[count++] = entry;
            }
        }
        column[j + 1] = count;
        whole_column[j + 1] = whole;
        inverse[j * N + j] = 1;
    }
    for (int j = 0; j < N; j++) {
        double sum = 0;
        for (int i = 0; i < N; i++)
            sum += fabs(dense[i * N + j]);
        norm[0] = fmax(norm[0], sum);
    }
    dense_lu(N, dense, pivot);
    dense_lu_solve(N, N, dense, pivot, inverse);
    for (int j = 0; j < N; j++) {
        double sum = 0;
        for (int i = 0; i < N; i++)
            sum += fabs(inverse[i * N + j]);
        norm[1] = fmax(norm[1], sum);
    }
    const sparse of[2] = {{N, 1, column, row, value}, {N, 0, whole_column, whole_row, whole_value}};
    for (int k = 0; k < 2; k++) {
        matrix_factor *fa;
        gsl_test(factor_alloc(&of[k], &fa, NULL) != STATUS_OK ||
                     factor_numeric(fa, &of[k], NULL) != STATUS_OK,
                 "factored");
        gsl_test_rel(factor_condition(fa, &of[k]), norm[0] * norm[1], 1e-12,
                     "condition from the %s", k == 0 ? "triangle" : "whole");
        factor_free(fa);
    }
}

static void nothing_to_solve(void)
{
    int column[1] = {0};
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        const sparse none = {0, symmetric, column, NULL, NULL};
        matrix_factor *fa;
        gsl_test(factor_alloc(&none, &fa, NULL) != STATUS_OK ||
                     factor_numeric(fa, &none, NULL) != STATUS_OK,
                 "no unknowns are no problem");
        factor_solve(fa, NULL);
        gsl_test_int(factor_count(fa).negative_pivots, symmetric ? 0 : -1, "of %s kind",
                     symmetric ? "symmetric" : "unsymmetric");
        factor_free(fa);
    }
    factor_free(NULL);
}

int main(void)
{
    random_matrices(DEFINITE, "definite", 1);
    random_matrices(INDEFINITE, "indefinite", 20);
    random_matrices(UNSYMMETRIC, "unsymmetric", 1);
    condition_of_a_triangle();
    nothing_to_solve();
    return gsl_test_summary();
}
