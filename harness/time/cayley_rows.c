#include <string.h>

#include "elements/math/real.h"
#include "harness/time/time_impl.h"

enum { N = NODE_COORDINATES };

/* Three numbers and the number after them, which remains as it is. */
typedef double three __attribute__((vector_size(4 * sizeof(double))));

static inline __attribute__((always_inline)) three load(const double x[])
{
    three v;
    memcpy(&v, x, sizeof v);
    return v;
}

/* Returns a[3] B, where B contains rows of four numbers, the last of which is zero. */
static inline __attribute__((always_inline)) three row_times(const double a[], const double B[])
{
    return a[0] * load(B) + a[1] * load(B + 4) + a[2] * load(B + 8);
}

static inline __attribute__((always_inline)) void add(three more, double to[])
{
    const three sum = load(to) + more;
    memcpy(to, &sum, sizeof sum);
}

void REAL_NAMED(cayley_rows)(int nodes, double share, double at, double weight,
                             const cayley_columns of[], const double back[12], int rows,
                             const double A[], double out[])
{
    const int n = N * nodes;
    for (int r = 0; r < rows; r++) {
        const double *a = A + (size_t)(r * n);
        double *to = out + (size_t)(r * n);
        three pulled = {0}, turned = {0};
        for (int j = 0; j < nodes; j++) {
            turned += share * row_times(a + N * j, of[j].r_common);
            turned += share * row_times(a + N * j + 3, of[j].phi_common);
            pulled += share * load(a + N * j);
        }
        turned[3] = 0;
        turned *= weight;
        for (int j = 0; j < nodes; j++) {
            const double *by = a + N * j;
            const double alone[3] = {by[0] - pulled[0], by[1] - pulled[1], by[2] - pulled[2]};
            add(weight * at * row_times(alone, back), to + N * j);
            add(weight * row_times(by + 3, of[j].by_phi), to + N * j + 3);
            add(turned, to + N * j + 3);
            to[N * j + 6] += weight * at * by[6];
        }
    }
}

static void turn_rows(const double A[9], double factor, int columns, double rows[])
{
    for (int k = 0; k < columns; k++) {
        const double at[3] = {rows[k], rows[columns + k], rows[2 * columns + k]};
        for (int i = 0; i < 3; i++)
            rows[i * columns + k] =
                factor * (A[3 * i] * at[0] + A[3 * i + 1] * at[1] + A[3 * i + 2] * at[2]);
    }
}

void REAL_NAMED(cayley_turn_forces)(const cayley_step *s, int columns, double f[])
{
    double common[3 * ELEMENT_MAX_COORDINATES] = {0};
    const int n = columns;
    for (int j = 0; j < s->nodes; j++) {
        double *F = f + (size_t)(NODE_COORDINATES * j) * (size_t)n, *M = F + 3 * n;
        const double *D = s->Dm[j];
        turn_rows(s->S, 1, n, F);
        turn_rows(s->T, s->z[j], n, M);
        for (int k = 0; k < n; k++) {
            common[k] += M[k] + D[1] * F[2 * n + k] - D[2] * F[n + k];
            common[n + k] += M[n + k] + D[2] * F[k] - D[0] * F[2 * n + k];
            common[2 * n + k] += M[2 * n + k] + D[0] * F[n + k] - D[1] * F[k];
        }
    }
    for (int j = 0; j < s->nodes; j++)
        for (int k = 0; k < 3 * n; k++)
            f[(size_t)(NODE_COORDINATES * j + 3) * (size_t)n + (size_t)k] -= s->share * common[k];
}
