/* Inverse iteration of a subspace: Y = K^-1 D X, then the eigenvectors of the projected problem. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/real_dense.h"
#include "harness/analysis/analysis_impl.h"

enum { VECTORS = LOWEST_VALUES, MOST_ITERATIONS = 12, MOST_SWEEPS = 30 };

/* The components of all vectors at one coordinate. */
typedef double components __attribute__((vector_size(VECTORS * sizeof(double))));

status lowest_values_alloc(int n, lowest_values *l, fault *f)
{
    const size_t size = (size_t)n;
    *l = (lowest_values){.n = n};
    l->work = malloc((1 + 2 * VECTORS) * size * sizeof *l->work + 1);
    if (l->work == NULL)
        return fault_memory(f, "the stability of %zu coordinates", size);
    for (size_t c = 0; c < VECTORS; c++)
        for (size_t i = 0; i < size; i++)
            l->work[(1 + c) * size + i] = sin(1 + 1.7 * (double)((c + 1) * (c * size + i)));
    return STATUS_OK;
}

void lowest_values_free(lowest_values *l)
{
    free(l->work);
}

/* Sets the metric to the diagonal of K. */
static void choose_metric(lowest_values *l, const sparse *K)
{
    double *D = l->work, largest = 0;
    for (int i = 0; i < K->n; i++) {
        D[i] = fabs(sparse_diagonal(K, i));
        largest = fmax(largest, D[i]);
    }
    for (int i = 0; i < K->n; i++)
        if (!(D[i] > 0))
            D[i] = largest > 0 ? largest : 1;
    l->measured = 1;
}

/* Replaces each row of A (n x n) by L^-1 times this row, with the lower triangle L. */
static void solve_rows(int n, const double L[], double A[])
{
    for (int r = 0; r < n; r++)
        for (int i = 0; i < n; i++) {
            double *a = A + r * n, sum = a[i];
            for (int k = 0; k < i; k++)
                sum -= L[i * n + k] * a[k];
            a[i] = sum / L[i * n + i];
        }
}

static void transpose(int n, double A[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            const double a = A[i * n + j];
            A[i * n + j] = A[j * n + i];
            A[j * n + i] = a;
        }
}

/* Rotates columns p and q, and, for both = 1, also rows p and q. */
static void rotate(int n, int p, int q, double c, double s, int both, double A[])
{
    for (int k = 0; k < n; k++) {
        const double a = A[k * n + p], b = A[k * n + q];
        A[k * n + p] = c * a - s * b;
        A[k * n + q] = s * a + c * b;
    }
    for (int k = 0; both && k < n; k++) {
        const double a = A[p * n + k], b = A[q * n + k];
        A[p * n + k] = c * a - s * b;
        A[q * n + k] = s * a + c * b;
    }
}

/* Diagonalises the symmetric A by Jacobi rotations, which are applied to the columns of V. */
static void diagonalise(int n, double A[], double V[])
{
    int rotated = 1;
    for (int sweep = 0; rotated && sweep < MOST_SWEEPS; sweep++) {
        rotated = 0;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                const double a = A[p * n + q], first = A[p * n + p], second = A[q * n + q];
                if (!(fabs(a) > DBL_EPSILON * (fabs(first) + fabs(second))))
                    continue;
                const double half = (second - first) / (2 * a),
                             tangent = copysign(1, half) / (fabs(half) + sqrt(1 + half * half)),
                             cosine = 1 / sqrt(1 + tangent * tangent);
                rotate(n, p, q, cosine, tangent * cosine, 1, A);
                rotate(n, p, q, cosine, tangent * cosine, 0, V);
                rotated = 1;
            }
    }
}

/* Solves A c = lambda B c, with lambda in ascending order. Stores c in the columns of C. Returns 0
 * if B is not positive definite. A and B are overwritten. */
static int project(int n, double A[], double B[], double lambda[], double C[])
{
    double V[VECTORS * VECTORS] = {0};
    if (!real_cholesky(n, B))
        return 0;
    solve_rows(n, B, A);
    transpose(n, A);
    solve_rows(n, B, A);
    for (int i = 0; i < n; i++)
        V[i * n + i] = 1;
    diagonalise(n, A, V);
    for (int i = n - 1; i >= 0; i--) /* L^-T V */
        for (int c = 0; c < n; c++) {
            for (int k = i + 1; k < n; k++)
                V[i * n + c] -= B[k * n + i] * V[k * n + c];
            V[i * n + c] /= B[i * n + i];
        }
    for (int i = 0; i < n; i++) {
        int rank = 0;
        for (int k = 0; k < n; k++)
            rank += A[k * n + k] < A[i * n + i] || (A[k * n + k] <= A[i * n + i] && k < i);
        lambda[rank] = A[i * n + i];
        for (int k = 0; k < n; k++)
            C[k * n + rank] = V[k * n + i];
    }
    return 1;
}

static int iterate(lowest_values *l, matrix_factor *K, int count, double lambda[])
{
    const size_t n = (size_t)l->n;
    const double *D = l->work;
    double *X = l->work + n, *Y = X + VECTORS * n, A[VECTORS * VECTORS] = {0},
           B[VECTORS * VECTORS] = {0}, C[VECTORS * VECTORS];
    components a[VECTORS] = {{0}}, b[VECTORS] = {{0}}, c[VECTORS] = {{0}};
    for (int v = 0; v < count; v++)
        for (size_t i = 0; i < n; i++)
            Y[(size_t)v * n + i] = D[i] * X[(size_t)v * n + i];
    factor_solve_many(K, count, l->n, Y);
    for (size_t i = 0; i < n; i++) {
        components x = {0}, y = {0};
        for (int v = 0; v < count; v++) {
            x[v] = D[i] * X[(size_t)v * n + i];
            y[v] = Y[(size_t)v * n + i];
        }
        for (int v = 0; v < VECTORS; v++) {
            a[v] += y[v] * x;
            b[v] += y[v] * D[i] * y;
        }
    }
    for (int v = 0; v < count; v++)
        for (int k = 0; k <= v; k++) {
            A[v * count + k] = A[k * count + v] = a[k][v];
            B[v * count + k] = B[k * count + v] = b[k][v];
        }
    if (!project(count, A, B, lambda, C))
        return 0;
    for (int v = 0; v < count; v++)
        for (int k = 0; k < count; k++)
            c[k][v] = C[k * count + v];
    for (size_t i = 0; i < n; i++) {
        components x = {0};
        for (int k = 0; k < count; k++)
            x += Y[(size_t)k * n + i] * c[k];
        for (int v = 0; v < count; v++)
            X[(size_t)v * n + i] = x[v];
    }
    return 1;
}

int lowest_values_find(lowest_values *l, const sparse *K, matrix_factor *factor,
                       double value[LOWEST_VALUES])
{
    const double wanted_accuracy = 1e-2;
    const int count = l->n < VECTORS ? l->n : VECTORS;
    int compared = l->known;
    if (!l->measured)
        choose_metric(l, K);
    l->known = 0;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        int same = compared;
        if (!iterate(l, factor, count, value))
            return 0;
        for (int k = 0; k < count; k++)
            same &= fabs(value[k] - l->value[k]) <= wanted_accuracy * fabs(value[k]);
        memcpy(l->value, value, (size_t)count * sizeof *value);
        compared = 1;
        if (!same)
            continue;
        l->known = 1;
        return count;
    }
    return 0;
}
