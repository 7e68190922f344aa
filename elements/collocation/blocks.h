/* Symmetric matrices in blocks of 3 x 3, of which those on and above the diagonal are stored, and
 * the elimination of their first rows: K = L D L^T without exchange of rows.  In lanes (real.h).
 * Exact enough where those rows are positive definite except for a negative definite end, whatever
 * their condition; exact_blocks_definite tests it. */
#ifndef BEAMWORK_EXACT_BLOCKS_H
#define BEAMWORK_EXACT_BLOCKS_H

#include "elements/math/vec3.h"

enum { EXACT_BLOCKS_MAX = 12 };

/* Place of block (i, j), i <= j. */
static inline int exact_blocks_at(int i, int j)
{
    return j * (j + 1) / 2 + i;
}

/* D of a diagonal block and, in its place, L^T above the diagonal. */
static inline void exact_blocks_pivot(real a[9], real d[3], real inverse[3])
{
    d[0] = a[0];
    inverse[0] = 1 / d[0];
    const real l1 = a[1] * inverse[0], l2 = a[2] * inverse[0];
    d[1] = a[4] - l1 * a[1];
    inverse[1] = 1 / d[1];
    const real middle = a[5] - l1 * a[2], l12 = middle * inverse[1];
    d[2] = a[8] - l2 * a[2] - l12 * middle;
    inverse[2] = 1 / d[2];
    a[1] = l1;
    a[2] = l2;
    a[5] = l12;
}

/* Eliminates `rows` block rows of a matrix of n, A [n (n + 1)/2][9]. In the result V the eliminated
 * rows have L^T and D^-1 L^-1 A, the others the remainder (Schur complement) of A. Block column
 * `late` is zero above row rows - 1 (n: there is none). D: d [3 rows]. */
static inline __attribute__((always_inline)) void
exact_blocks_eliminate(int rows, int n, int late, real A[][9], real V[][9], real d[])
{
    real inverse[EXACT_BLOCKS_MAX][3], U[EXACT_BLOCKS_MAX][9];
    for (int j = 0; j < n; j++) {
        const int begin = j == late ? rows - 1 : 0;
        for (int i = begin; i <= j; i++) {
            const int from = i == late && begin == 0 ? rows - 1 : begin, at = exact_blocks_at(i, j);
            real sum[9];
            for (int c = 0; c < 9; c++)
                sum[c] = A[at][c];
            for (int k = from; k < (i < rows ? i : rows); k++)
                mat3_subtract_transpose_mul(V[exact_blocks_at(k, i)], U[k], sum);
            if (i == j && i < rows)
                exact_blocks_pivot(sum, &d[3 * i], inverse[i]);
            if (i < j && i < rows) {
                const real *L = V[exact_blocks_at(i, i)];
                for (int c = 0; c < 3; c++) {
                    U[i][c] = sum[c];
                    U[i][3 + c] = sum[3 + c] - L[1] * sum[c];
                    U[i][6 + c] = sum[6 + c] - L[2] * sum[c] - L[5] * U[i][3 + c];
                }
                for (int r = 0; r < 3; r++)
                    for (int c = 0; c < 3; c++)
                        sum[3 * r + c] = U[i][3 * r + c] * inverse[i][r];
            }
            for (int c = 0; c < 9; c++)
                V[at][c] = sum[c];
        }
    }
}

/* X [rows][9]: K^-1 times block column j of A, of the rows eliminated; `late` as above. */
static inline __attribute__((always_inline)) void exact_blocks_solve(int rows, int late, int j,
                                                                     real V[][9], real X[][9])
{
    for (int i = rows - 1; i >= 0; i--) {
        const real *L = V[exact_blocks_at(i, i)], *b = V[exact_blocks_at(i, j)];
        real *x = X[i];
        for (int c = 0; c < 9; c++)
            x[c] = j == late && i < rows - 1 ? real_of(0) : b[c];
        for (int k = i + 1; k < rows; k++) {
            const real *K = V[exact_blocks_at(i, k)];
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    x[3 * r + c] -= K[3 * r] * X[k][c] + K[3 * r + 1] * X[k][3 + c] +
                                    K[3 * r + 2] * X[k][6 + c];
        }
        for (int c = 0; c < 3; c++) {
            x[3 + c] -= L[5] * x[6 + c];
            x[c] -= L[1] * x[3 + c] + L[2] * x[6 + c];
        }
    }
}

/* Were the pivots d of one lane positive, and the last three negative? One that is lost in
 * round-off is neither. */
static inline int exact_blocks_definite(int rows, real A[][9], const real d[], int lane)
{
    const double lost = 1e-9;
    for (int i = 0; i < rows - 1; i++)
        for (int r = 0; r < 3; r++)
            if (!(real_lane(&d[3 * i + r], lane) >
                  lost * fabs(real_lane(&A[exact_blocks_at(i, i)][4 * r], lane))))
                return 0;
    for (int r = 3 * (rows - 1); r < 3 * rows; r++)
        if (!(real_lane(&d[r], lane) < 0))
            return 0;
    return 1;
}

#endif
