#include "elements/collocation/variables.h"

#include <string.h>

#include "elements/math/dense.h"

enum { OUTER = EXACT_STAGES_OUTER, UNKNOWNS = EXACT_STAGES_UNKNOWNS };

static double entry(int stages, double A[][9], int i, int j)
{
    int row, column;
    const int I = exact_variables_block(stages, i, &row),
              J = exact_variables_block(stages, j, &column);
    if (I < J || (I == J && row <= column))
        return A[exact_blocks_at(I, J)][3 * row + column];
    return A[exact_blocks_at(J, I)][3 * column + row];
}

void exact_variables_matrix(int stages, double A[][9], int n, double matrix[])
{
    int row, column;
    for (int i = 0; i < n; i++) {
        const int I = exact_variables_block(stages, i, &row);
        for (int j = 0; j < n; j += 3) { /* of one block; the last one has two */
            const int J = exact_variables_block(stages, j, &column), down = I > J,
                      at = down ? exact_blocks_at(J, I) : exact_blocks_at(I, J);
            for (int k = 0; k < 3 && j + k < n; k++)
                matrix[i * n + j + k] =
                    A[at][down || (I == J && row > k) ? 3 * k + row : 3 * row + k];
        }
    }
}

int exact_variables_eliminate(int stages, int columns, double A[][9], double S[][9],
                              double X[][EXACT_STAGES_MAX][9])
{
    enum { MOST = OUTER + 4 };
    const int m = 3 * stages, n = columns;
    double K[UNKNOWNS * UNKNOWNS], B[UNKNOWNS * MOST], solved[UNKNOWNS * MOST];
    int pivot[UNKNOWNS], row, column;
    exact_variables_matrix(stages, A, m, K);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            B[i * n + j] = solved[i * n + j] = entry(stages, A, i, m + j);
    const int failed = dense_lu(m, K, pivot);
    if (failed != 0)
        return failed;
    dense_lu_solve(m, n, K, pivot, solved);
    for (int j = 0; j < n; j++) {
        const int J = exact_variables_block(stages, m + j, &column);
        for (int i = 0; i < m; i++) {
            const int I = exact_variables_block(stages, i, &row);
            X[J - stages][I][3 * row + column] = solved[i * n + j];
        }
        for (int i = 0; i < n; i++) {
            const int I = exact_variables_block(stages, m + i, &row);
            double rest = entry(stages, A, m + i, m + j);
            for (int k = 0; k < m; k++)
                rest -= B[k * n + i] * solved[k * n + j];
            if (I <= J)
                S[exact_blocks_at(I, J)][3 * row + column] = rest;
        }
    }
    return 0;
}

void exact_variables_change(const exact_stages *s, int i, const double change[], double x[3],
                            double slope[3])
{
    memset(x, 0, 3 * sizeof *x);
    memset(slope, 0, 3 * sizeof *slope);
    for (int k = 0; k < s->stages; k++) {
        const int first = k < s->stages - 1 ? 3 * (k + 1) : s->unknowns + 3;
        for (int j = 0; j < 3; j++) {
            x[j] += s->N[i][k] * change[first + j];
            slope[j] += s->dN[i][k] * change[first + j];
        }
    }
}
