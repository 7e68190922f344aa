#include "harness/numerics/numerics_impl.h"

#include <math.h>

#include "elements/math/real.h"

/* The values of an unknown are contiguous: w[n x width]. width and count are compile-time constants
 * after inlining. The result for a right-hand side is the same for every width. */

enum { ROWS = TRIANGULAR_LANES };

typedef double lanes
    __attribute__((vector_size(ROWS * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Columns first .. first + count - 1 of L, and the unknowns with these numbers. */
typedef struct run_values {
    double x[TRIANGULAR_RUN][TRIANGULAR_TOGETHER];
    /* entries of each column in the rows below the run; entry (r, c) inside the run is
     * value[c][r - count] */
    const double *value[TRIANGULAR_RUN];
    const int *row; /* [rows] */
    int rows;
} run_values;

static inline __attribute__((always_inline)) void load(const triangular_factors *t, int first,
                                                       int count, int width, const double w[],
                                                       run_values *run)
{
    const int last = first + count - 1;
    run->row = t->row + t->begin[last];
    run->rows = t->begin[last + 1] - t->begin[last];
    for (int c = 0; c < count; c++) {
        run->value[c] = t->value + t->begin[first + c] + (count - 1 - c);
        for (int i = 0; i < width; i++)
            run->x[c][i] = w[(first + c) * width + i];
    }
}

static inline __attribute__((always_inline)) void store(int first, int count, int width,
                                                        const run_values *run, double w[])
{
    for (int c = 0; c < count; c++)
        for (int i = 0; i < width; i++)
            w[(first + c) * width + i] = run->x[c][i];
}

/* Subtracts column c of a run from the later ones. */
static inline __attribute__((always_inline)) void subtract_column(int c, int count, int width,
                                                                  run_values *run)
{
    for (int r = c + 1; r < count; r++)
        for (int i = 0; i < width; i++)
            run->x[r][i] -= run->value[c][r - count] * run->x[c][i];
}

/* Subtracts row r of a run from the previous ones. */
static inline __attribute__((always_inline)) void subtract_row(int r, int count, int width,
                                                               run_values *run)
{
    for (int c = 0; c < r && r < count; c++)
        for (int i = 0; i < width; i++)
            run->x[c][i] -= run->value[c][r - count] * run->x[r][i];
}

/* Subtracts the columns of a run in the solution of L x = w, in place. */
static inline __attribute__((always_inline)) void
forward_run(const triangular_factors *t, int first, int count, int width, double *restrict w)
{
    run_values run;
    load(t, first, count, width, w, &run);
    subtract_column(0, count, width, &run);
    subtract_column(1, count, width, &run);
    subtract_column(2, count, width, &run);
    subtract_column(3, count, width, &run);
    subtract_column(4, count, width, &run);
    subtract_column(5, count, width, &run);
    store(first, count, width, &run, w);
    for (int p = 0; p < run.rows;) {
        double *to = w + run.row[p] * width, sum[TRIANGULAR_TOGETHER];
        if (width == 1 && p + ROWS <= run.rows && run.row[p + ROWS - 1] == run.row[p] + ROWS - 1) {
            lanes sums = *(lanes *)to;
            for (int c = 0; c < count; c++)
                sums -= *(const lanes *)(run.value[c] + p) * run.x[c][0];
            *(lanes *)to = sums;
            p += ROWS;
            continue;
        }
        for (int i = 0; i < width; i++)
            sum[i] = to[i];
        for (int c = 0; c < count; c++)
            for (int i = 0; i < width; i++)
                sum[i] -= run.value[c][p] * run.x[c][i];
        for (int i = 0; i < width; i++)
            to[i] = sum[i];
        p++;
    }
}

/* Solves for the rows of a run in L^T x = w, in place. The terms below the run are subtracted
 * first. */
static inline __attribute__((always_inline)) void
backward_run(const triangular_factors *t, int first, int count, int width, double *restrict w)
{
    run_values run;
    load(t, first, count, width, w, &run);
    for (int p = 0; p < run.rows; p++) {
        const double *from = w + run.row[p] * width;
        for (int c = 0; c < count; c++)
            for (int i = 0; i < width; i++)
                run.x[c][i] -= run.value[c][p] * from[i];
    }
    subtract_row(6, count, width, &run);
    subtract_row(5, count, width, &run);
    subtract_row(4, count, width, &run);
    subtract_row(3, count, width, &run);
    subtract_row(2, count, width, &run);
    subtract_row(1, count, width, &run);
    store(first, count, width, &run, w);
}

static inline __attribute__((always_inline)) void forward(const triangular_factors *t, int width,
                                                          double *restrict w)
{
    for (int i = 0; i < t->runs; i++) {
        const int first = t->run[i].first;
        switch (t->run[i].count) {
        case 1:
            forward_run(t, first, 1, width, w);
            break;
        case 2:
            forward_run(t, first, 2, width, w);
            break;
        case 3:
            forward_run(t, first, 3, width, w);
            break;
        case 4:
            forward_run(t, first, 4, width, w);
            break;
        case 5:
            forward_run(t, first, 5, width, w);
            break;
        case 6:
            forward_run(t, first, 6, width, w);
            break;
        default:
            forward_run(t, first, TRIANGULAR_RUN, width, w);
        }
    }
}

static inline __attribute__((always_inline)) void backward(const triangular_factors *t, int width,
                                                           double *restrict w)
{
    for (int i = t->runs - 1; i >= 0; i--) {
        const int first = t->run[i].first;
        switch (t->run[i].count) {
        case 1:
            backward_run(t, first, 1, width, w);
            break;
        case 2:
            backward_run(t, first, 2, width, w);
            break;
        case 3:
            backward_run(t, first, 3, width, w);
            break;
        case 4:
            backward_run(t, first, 4, width, w);
            break;
        case 5:
            backward_run(t, first, 5, width, w);
            break;
        case 6:
            backward_run(t, first, 6, width, w);
            break;
        default:
            backward_run(t, first, TRIANGULAR_RUN, width, w);
        }
    }
}

static inline __attribute__((always_inline)) void
divide(const triangular_factors *t, triangular_part part, int width, double *restrict w)
{
    for (int k = 0; k < t->n; k++) {
        const double by = part == TRIANGULAR_WHOLE ? t->D[k] : sqrt(t->D[k]);
        for (int i = 0; i < width; i++)
            w[k * width + i] /= by;
    }
}

static inline __attribute__((always_inline)) void solve(const triangular_factors *t,
                                                        triangular_part part, int width, int stride,
                                                        double x[], double w[])
{
    const int *from = part == TRIANGULAR_ROOT_TRANSPOSED ? NULL : t->order,
              *to = part == TRIANGULAR_ROOT ? NULL : t->order;
    for (int k = 0; k < t->n; k++)
        for (int i = 0; i < width; i++)
            w[k * width + i] = x[i * stride + (from != NULL ? from[k] : k)];
    if (part != TRIANGULAR_ROOT_TRANSPOSED)
        forward(t, width, w);
    divide(t, part, width, w);
    if (part != TRIANGULAR_ROOT)
        backward(t, width, w);
    for (int k = 0; k < t->n; k++)
        for (int i = 0; i < width; i++)
            x[i * stride + (to != NULL ? to[k] : k)] = w[k * width + i];
}

void REAL_NAMED(triangular_solve)(const triangular_factors *t, triangular_part part, int columns,
                                  int stride, double x[], double work[])
{
    for (; columns >= 4; columns -= 4, x += 4 * stride)
        solve(t, part, 4, stride, x, work);
    for (; columns >= 2; columns -= 2, x += 2 * stride)
        solve(t, part, 2, stride, x, work);
    if (columns == 1)
        solve(t, part, 1, stride, x, work);
}
