/* Matrices with known properties for tests of linear algebra. Dense matrices are row-major. */
#ifndef BEAMWORK_TEST_MATRICES_H
#define BEAMWORK_TEST_MATRICES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/test/kit.h"
#include "harness/numerics/numerics.h"

/* Returns the sparse form of A[n x n], with the nonzero entries and all diagonal entries. */
static inline sparse matrices_from_dense(int n, int symmetric, const double A[])
{
    sparse s = {n, symmetric, calloc((size_t)n + 1, sizeof(int)), NULL, NULL, 0};
    s.row = malloc(((size_t)n * (size_t)n + 1) * sizeof *s.row);
    s.value = malloc(((size_t)n * (size_t)n + 1) * sizeof *s.value);
    for (int j = 0; j < n; j++) {
        s.column[j + 1] = s.column[j];
        for (int i = 0; i < (symmetric ? j + 1 : n); i++)
            if (A[i * n + j] != 0 || i == j) {
                s.row[s.column[j + 1]] = i;
                s.value[s.column[j + 1]++] = A[i * n + j];
            }
    }
    return s;
}

/* Returns the upper triangle of a block tridiagonal matrix of zeros with `nodes` diagonal blocks
 * [size x size]. */
static inline sparse matrices_chain(int nodes, int size)
{
    const int n = nodes * size;
    sparse s = {n, 1, calloc((size_t)n + 1, sizeof(int)), NULL, NULL, 0};
    s.row = malloc((size_t)n * 2 * (size_t)size * sizeof *s.row + 1);
    for (int j = 0, k = 0; j < n; j++) {
        const int first = j / size > 0 ? (j / size - 1) * size : 0;
        for (int i = first; i <= j; i++)
            s.row[k++] = i;
        s.column[j + 1] = k;
    }
    s.value = calloc((size_t)s.column[n] + 1, sizeof *s.value);
    return s;
}

static inline double matrices_energy(const sparse *A, const double x[])
{
    double *y = malloc((size_t)A->n * sizeof *y);
    sparse_mul(A, x, y);
    const double energy = dense_dot(A->n, x, y);
    free(y);
    return energy;
}

static inline void matrices_free(sparse *s)
{
    free(s->column);
    free(s->row);
    free(s->value);
    memset(s, 0, sizeof *s);
}

/* Returns a matrix that stores both triangles of the symmetric matrix a. */
static inline sparse matrices_both_triangles(const sparse *a)
{
    const int n = a->n;
    sparse s = {n, 0, calloc((size_t)n + 1, sizeof(int)), NULL, NULL, 0};
    int *next = calloc((size_t)n + 1, sizeof *next);
    s.row = malloc(2 * (size_t)a->column[n] * sizeof *s.row + 1);
    s.value = malloc(2 * (size_t)a->column[n] * sizeof *s.value + 1);
    for (int j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            s.column[j + 1]++;
            if (a->row[k] != j)
                s.column[a->row[k] + 1]++;
        }
    for (int j = 0; j < n; j++) {
        s.column[j + 1] += s.column[j];
        next[j] = s.column[j];
    }
    for (int j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            s.row[next[j]] = i;
            s.value[next[j]++] = a->value[k];
            if (i != j) {
                s.row[next[i]] = j;
                s.value[next[i]++] = a->value[k];
            }
        }
    free(next);
    return s;
}

static inline void matrices_add(sparse *s, int i, int j, double value)
{
    const int low = i < j ? i : j, high = i < j ? j : i;
    for (int k = s->column[high]; k < s->column[high + 1]; k++)
        if (s->row[k] == low)
            s->value[k] += value;
}

/* Adds element matrices k[2 size x 2 size] of all pairs of neighbouring nodes. The first `left_out`
 * unknowns of the chain are omitted. */
static inline void matrices_add_elements(sparse *s, int elements, int size, int left_out,
                                         const double k[])
{
    for (int e = 0; e < elements; e++)
        for (int a = 0; a < 2 * size; a++)
            for (int b = a; b < 2 * size; b++) {
                const int i = e * size + a - left_out, j = e * size + b - left_out;
                if (i >= 0 && i < s->n && j >= 0 && j < s->n)
                    matrices_add(s, i, j, k[a * 2 * size + b]);
            }
}

/* Computes the matrices of a shear-rigid plane beam element of length h with EI = 1: the stiffness,
 * minus the geometric stiffness at unit compression, and the mass matrix for a mass per length of
 * 1. The unknowns are w and the slope at both ends. */
static inline void matrices_beam(double h, double stiffness[16], double compression[16],
                                 double mass[16])
{
    const double k[16] = {12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4};
    const double g[16] = {36, 3, -36, 3, 3, 4, -3, -1, -36, -3, 36, -3, 3, -1, -3, 4};
    const double m[16] = {156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            const double slopes = (i % 2 ? h : 1) * (j % 2 ? h : 1);
            stiffness[4 * i + j] = k[4 * i + j] * slopes / (h * h * h);
            compression[4 * i + j] = g[4 * i + j] * slopes / (30 * h);
            mass[4 * i + j] = m[4 * i + j] * slopes * h / 420;
        }
}

#endif
