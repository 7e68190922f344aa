#include "harness/numerics/numerics_impl.h"

#include <string.h>

#include "elements/math/real.h"

enum { ROWS = TRIANGULAR_LANES, MOST = TRIANGULAR_MATRICES };

typedef double lanes
    __attribute__((vector_size(ROWS * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef long long bits
    __attribute__((vector_size(ROWS * sizeof(long long)), aligned(sizeof(long long)), may_alias));

/* Row k keeps the last k numbers. */
static const bits last[ROWS] = {{0}, {0, 0, 0, -1}, {0, 0, -1, -1}, {0, -1, -1, -1}};

/* Adds a_kj x_j to y_k and a_kj x_k to `sums` for entries k .. k + ROWS - 1. The first ones have
 * been used if `kept` is less than ROWS. */
static inline __attribute__((always_inline)) void use_lanes(int matrices, int kept,
                                                            const double *const value[], int k,
                                                            double xj, const double x[],
                                                            double *const y[], int i, lanes sums[])
{
    for (int m = 0; m < matrices; m++) {
        lanes four = *(const lanes *)(value[m] + k);
        if (kept < ROWS)
            four = (lanes)((bits)four & last[kept]);
        *(lanes *)(y[m] + i) += four * xj;
        sums[m] += four * *(const lanes *)(x + i);
    }
}

/* Adds the part of column j with `count` entries in the rows i, i + 1, ..., from entry k. */
static inline __attribute__((always_inline)) void use_rows(int matrices, int count,
                                                           const double *const value[], int k,
                                                           double xj, const double x[],
                                                           double *const y[], int i, double sum[])
{
    lanes sums[MOST] = {{0}};
    int used = 0;
    for (; used + ROWS <= count; used += ROWS)
        use_lanes(matrices, ROWS, value, k + used, xj, x, y, i + used, sums);
    if (used > 0 && used < count)
        use_lanes(matrices, count - used, value, k + count - ROWS, xj, x, y, i + count - ROWS,
                  sums);
    for (int m = 0; m < matrices; m++) {
        for (int l = 0; l < count && l < ROWS - 1 && used == 0; l++) {
            y[m][i + l] += value[m][k + l] * xj;
            sum[m] += value[m][k + l] * x[i + l];
        }
        sum[m] += (sums[m][0] + sums[m][1]) + (sums[m][2] + sums[m][3]);
    }
}

/* If the diagonal entry is stored, it is the last entry of its column. */
static inline __attribute__((always_inline)) void multiply(int matrices, const sparse *a,
                                                           const double *const value[],
                                                           const double x[], double *const y[])
{
    const int *const column = a->column, *const row = a->row, n = a->n;
    for (int m = 0; m < matrices; m++)
        memset(y[m], 0, (size_t)n * sizeof *y[m]);
    for (int j = 0; j < n; j++) {
        int k = column[j], end = column[j + 1];
        double sum[MOST] = {0};
        if (end > k && row[end - 1] == j) {
            end--;
            for (int m = 0; m < matrices; m++)
                sum[m] = value[m][end] * x[j];
        }
        while (k < end) {
            const int i = row[k];
            int count = end - k;
            if (row[end - 1] - i != count - 1)
                for (count = 1; row[k + count] == i + count; count++)
                    ;
            use_rows(matrices, count, value, k, x[j], x, y, i, sum);
            k += count;
        }
        for (int m = 0; m < matrices; m++)
            y[m][j] += sum[m];
    }
}

void REAL_NAMED(triangular_product)(const sparse *a, const double x[], double y[])
{
    multiply(1, a, (const double *[]){a->value}, x, (double *[]){y});
}

void REAL_NAMED(triangular_products)(const sparse *a, const sparse *b, const double x[],
                                     double ax[], double bx[])
{
    multiply(2, a, (const double *[]){a->value, b->value}, x, (double *[]){ax, bx});
}
