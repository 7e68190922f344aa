#include "elements/math/dense.h"

#include <string.h>

#include "elements/math/real.h"

/* Rows are padded with zeros to a whole number of SIMD vectors. Two rows are summed together, so
 * each loaded factor is used for both. */
#ifdef REAL_AVX2 /* numbers in a SIMD vector of the processor; wider vectors are slow */
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif
typedef double part __attribute__((vector_size(WIDTH * 8)));
enum { PARTS = CONGRUENCE_WIDEST / WIDTH };

/* Adds the sum over l of c[l stride] times row l of B[count x blocks] to the first row of out[2 x
 * blocks], and the sum with c[next + l stride] to the second. */
static inline __attribute__((always_inline)) void
two_rows(int count, int blocks, const double *c, int next, int stride, const part *B, part *out)
{
    part first[PARTS], second[PARTS];
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
                                                          int stride, const part *B, part *out)
{
    for (int b = 0; b < blocks; b++) {
        part sum = out[b];
        for (int l = 0; l < count; l++)
            sum += c[l * stride] * B[l * blocks + b];
        out[b] = sum;
    }
}

/* Adds the sum over l of c[i next + l stride] times row l of B to each row i of out[rows x
 * blocks]. */
static inline __attribute__((always_inline)) void add_rows(int rows, int count, int blocks,
                                                           const double *c, int next, int stride,
                                                           const part *B, part *out)
{
    int i = 0;
    for (; i + 1 < rows; i += 2)
        two_rows(count, blocks, c + i * next, next, stride, B, out + i * blocks);
    if (i < rows)
        one_row(count, blocks, c + i * next, stride, B, out + i * blocks);
}

static inline __attribute__((always_inline)) void widen(int rows, int n, int blocks,
                                                        const double *A, part *out)
{
    const size_t row = (size_t)n * sizeof *A;
    for (int i = 0; i < rows; i++) {
        out[i * blocks + blocks - 1] = (part){0};
        memcpy(out + i * blocks, A + i * n, row);
    }
}

static inline __attribute__((always_inline)) void narrow(int rows, int n, int blocks,
                                                         const part *in, double *A)
{
    const size_t row = (size_t)n * sizeof *A;
    for (int i = 0; i < rows; i++)
        memcpy(A + i * n, in + i * blocks, row);
}

static inline __attribute__((always_inline)) void add(int m, int n, int blocks, const double *A,
                                                      const double *S, const double *J, double *K)
{
    part wide[CONGRUENCE_WIDEST * PARTS], SJ[CONGRUENCE_WIDEST * PARTS],
        sum[CONGRUENCE_WIDEST * PARTS];
    widen(m, n, blocks, J, wide);
    for (int i = 0; i < m * blocks; i++)
        SJ[i] = (part){0};
    add_rows(m, m, blocks, S, m, 1, wide, SJ);
    widen(n, n, blocks, K, sum);
    add_rows(n, m, blocks, A, 1, n, SJ, sum);
    narrow(n, n, blocks, sum, K);
}

void REAL_NAMED(congruence_add_between)(int m, int n, const double *A, const double *S,
                                        const double *J, double *K)
{
    if (m == 8 && n == 14)
        add(8, 14, (14 + WIDTH - 1) / WIDTH, A, S, J, K);
    else if (m == 8 && n == 8)
        add(8, 8, 8 / WIDTH, A, S, J, K);
    else if (m == 15 && n == 21)
        add(15, 21, (21 + WIDTH - 1) / WIDTH, A, S, J, K);
    else
        add(m, n, (n + WIDTH - 1) / WIDTH, A, S, J, K);
}

void REAL_NAMED(congruence_add)(int m, int n, const double *J, const double *S, double *K)
{
    REAL_NAMED(congruence_add_between)(m, n, J, S, J, K);
}

typedef double tail __attribute__((vector_size(16)));
enum { UPPER = UPPER_COLUMNS, WHOLE = UPPER / WIDTH, LEFT = UPPER % WIDTH };

/* Adds row[rows] times U to the columns of A from the SIMD vector `block` on. */
static inline __attribute__((always_inline)) void
add_columns(int rows, double factor, const double *row, int block, const double *U, double *A)
{
    for (int b = block; b < WHOLE; b++) {
        part u, sum = {0}, all;
        for (int k = 0; k < rows; k++) {
            memcpy(&u, U + k * UPPER + b * WIDTH, sizeof u);
            sum = k == 0 ? row[k] * u : sum + row[k] * u;
        }
        memcpy(&all, A + b * WIDTH, sizeof all);
        all += factor * sum;
        memcpy(A + b * WIDTH, &all, sizeof all);
    }
    if (LEFT == 0)
        return;
    tail u, sum = {0}, all;
    for (int k = 0; k < rows; k++) {
        memcpy(&u, U + k * UPPER + WHOLE * WIDTH, sizeof u);
        sum = k == 0 ? row[k] * u : sum + row[k] * u;
    }
    memcpy(&all, A + WHOLE * WIDTH, sizeof all);
    all += factor * sum;
    memcpy(A + WHOLE * WIDTH, &all, sizeof all);
}

static inline __attribute__((always_inline)) void
add_upper(int rows, double factor, const double *T, const double *U, double *A)
{
    for (int i = 0; i < UPPER; i++) {
        double row[3];
        for (int k = 0; k < rows; k++)
            row[k] = T[k * UPPER + i];
        add_columns(rows, factor, row, i / WIDTH, U, A + i * UPPER);
    }
}

void REAL_NAMED(congruence_add_upper)(int rows, double factor, const double *T, const double *U,
                                      double *A)
{
    if (rows == 3)
        add_upper(3, factor, T, U, A);
    else
        add_upper(1, factor, T, U, A);
}
