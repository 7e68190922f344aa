#include "elements/math/congruence.h"

#include <string.h>

#include "elements/math/real.h"

/* Rows are filled up with zeros to whole fours, two rows are summed at once: what is read of a
 * factor serves both. */
typedef double four __attribute__((vector_size(32)));
enum { FOUR = 4, FOURS = CONGRUENCE_WIDEST / FOUR };

/* Two rows of out[.. x blocks] += sum over l of c[l stride] row l of B[count x blocks]. */
static inline __attribute__((always_inline)) void
two_rows(int count, int blocks, const double *c, int next, int stride, const four *B, four *out)
{
    four first[FOURS], second[FOURS];
    for (int b = 0; b < blocks; b++) {
        first[b] = out[b];
        second[b] = out[blocks + b];
    }
    for (int l = 0; l < count; l++) {
        const double one = c[l * stride], other = c[next + l * stride];
        for (int b = 0; b < blocks; b++) {
            first[b] += one * B[l * blocks + b];
            second[b] += other * B[l * blocks + b];
        }
    }
    for (int b = 0; b < blocks; b++) {
        out[b] = first[b];
        out[blocks + b] = second[b];
    }
}

static inline __attribute__((always_inline)) void one_row(int count, int blocks, const double *c,
                                                          int stride, const four *B, four *out)
{
    for (int b = 0; b < blocks; b++) {
        four sum = out[b];
        for (int l = 0; l < count; l++)
            sum += c[l * stride] * B[l * blocks + b];
        out[b] = sum;
    }
}

/* out[rows x blocks] += sum over l of c[i next + l stride] row l of B. */
static inline __attribute__((always_inline)) void add_rows(int rows, int count, int blocks,
                                                           const double *c, int next, int stride,
                                                           const four *B, four *out)
{
    int i = 0;
    for (; i + 1 < rows; i += 2)
        two_rows(count, blocks, c + i * next, next, stride, B, out + i * blocks);
    if (i < rows)
        one_row(count, blocks, c + i * next, stride, B, out + i * blocks);
}

/* A[rows x n] into rows of whole fours, and back. */
static inline __attribute__((always_inline)) void widen(int rows, int n, int blocks,
                                                        const double *A, four *out)
{
    const size_t row = (size_t)n * sizeof *A;
    for (int i = 0; i < rows; i++) {
        out[i * blocks + blocks - 1] = (four){0};
        memcpy(out + i * blocks, A + i * n, row);
    }
}

static inline __attribute__((always_inline)) void narrow(int rows, int n, int blocks,
                                                         const four *in, double *A)
{
    const size_t row = (size_t)n * sizeof *A;
    for (int i = 0; i < rows; i++)
        memcpy(A + i * n, in + i * blocks, row);
}

static inline __attribute__((always_inline)) void add(int m, int n, int blocks, const double *J,
                                                      const double *S, double *K)
{
    four wide[CONGRUENCE_WIDEST * FOURS], SJ[CONGRUENCE_WIDEST * FOURS],
        sum[CONGRUENCE_WIDEST * FOURS];
    widen(m, n, blocks, J, wide);
    for (int i = 0; i < m * blocks; i++)
        SJ[i] = (four){0};
    add_rows(m, m, blocks, S, m, 1, wide, SJ);
    widen(n, n, blocks, K, sum);
    add_rows(n, m, blocks, J, 1, n, SJ, sum);
    narrow(n, n, blocks, sum, K);
}

void REAL_NAMED(congruence_add)(int m, int n, const double *J, const double *S, double *K)
{
    if (m == 8 && n == 14)
        add(8, 14, 4, J, S, K);
    else if (m == 8 && n == 8)
        add(8, 8, 2, J, S, K);
    else if (m == 15 && n == 21)
        add(15, 21, 6, J, S, K);
    else
        add(m, n, (n + FOUR - 1) / FOUR, J, S, K);
}
