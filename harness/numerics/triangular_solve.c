#include "harness/numerics/numerics_impl.h"

#include "elements/math/real.h"

/* The values of an unknown are contiguous: w[n x width]. width and count are compile-time constants
 * after inlining. */

/* Subtracts the columns of a run in the solution of L x = w, in place. */
static inline __attribute__((always_inline)) void
forward_run(const triangular_factors *t, int first, int count, int width, double *restrict w)
{
    const double *value[TRIANGULAR_RUN];
    double x[TRIANGULAR_RUN][TRIANGULAR_TOGETHER];
    const int last = first + count - 1, *row = t->row + t->begin[last],
              rows = t->begin[last + 1] - t->begin[last];
    for (int c = 0; c < count; c++)
        for (int i = 0; i < width; i++)
            x[c][i] = w[(first + c) * width + i];
    for (int c = 0; c < count; c++) {
        value[c] = t->value + t->begin[first + c];
        for (int r = c + 1; r < count; r++) {
            const double l = *value[c]++;
            for (int i = 0; i < width; i++)
                x[r][i] -= l * x[c][i];
        }
    }
    for (int c = 1; c < count; c++)
        for (int i = 0; i < width; i++)
            w[(first + c) * width + i] = x[c][i];
    for (int p = 0; p < rows; p++) {
        double *to = w + row[p] * width, sum[TRIANGULAR_TOGETHER];
        for (int i = 0; i < width; i++)
            sum[i] = to[i];
        for (int c = 0; c < count; c++)
            for (int i = 0; i < width; i++)
                sum[i] -= value[c][p] * x[c][i];
        for (int i = 0; i < width; i++)
            to[i] = sum[i];
    }
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

/* Divides by D, then solves L^T x = w in place. */
static inline __attribute__((always_inline)) void backward(const triangular_factors *t, int width,
                                                           double *restrict w)
{
    for (int j = t->n - 1; j >= 0; j--) {
        double sum[TRIANGULAR_TOGETHER];
        for (int i = 0; i < width; i++)
            sum[i] = w[j * width + i] / t->D[j];
        for (int p = t->begin[j]; p < t->begin[j + 1]; p++)
            for (int i = 0; i < width; i++)
                sum[i] -= t->value[p] * w[t->row[p] * width + i];
        for (int i = 0; i < width; i++)
            w[j * width + i] = sum[i];
    }
}

static inline __attribute__((always_inline)) void solve(const triangular_factors *t, int width,
                                                        int stride, double x[], double w[])
{
    for (int k = 0; k < t->n; k++)
        for (int i = 0; i < width; i++)
            w[k * width + i] = x[i * stride + t->order[k]];
    forward(t, width, w);
    backward(t, width, w);
    for (int k = 0; k < t->n; k++)
        for (int i = 0; i < width; i++)
            x[i * stride + t->order[k]] = w[k * width + i];
}

void REAL_NAMED(triangular_solve)(const triangular_factors *t, int columns, int stride, double x[],
                                  double work[])
{
    for (; columns >= 4; columns -= 4, x += 4 * stride)
        solve(t, 4, stride, x, work);
    for (; columns >= 2; columns -= 2, x += 2 * stride)
        solve(t, 2, stride, x, work);
    if (columns == 1)
        solve(t, 1, stride, x, work);
}
