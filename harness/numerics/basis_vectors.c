#include "harness/numerics/numerics_impl.h"

#include "elements/math/real.h"

enum { WIDE = TRIANGULAR_LANES };

typedef double lanes
    __attribute__((vector_size(WIDE * sizeof(double)), aligned(sizeof(double)), may_alias));

static inline double total(lanes sum)
{
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* `together` is a compile-time constant after inlining. */
static inline __attribute__((always_inline)) void measure(int together, size_t n, const double V[],
                                                          const double w[], double part[])
{
    lanes sum[WIDE] = {{0}};
    size_t k = 0;
    for (; k + WIDE <= n; k += WIDE)
        for (int i = 0; i < together; i++)
            sum[i] += *(const lanes *)(V + (size_t)i * n + k) * *(const lanes *)(w + k);
    for (int i = 0; i < together; i++) {
        part[i] = total(sum[i]);
        for (size_t l = k; l < n; l++)
            part[i] += V[(size_t)i * n + l] * w[l];
    }
}

void REAL_NAMED(basis_measure)(int n, int count, const double V[], const double w[], double part[])
{
    const size_t size = (size_t)n;
    int i = 0;
    for (; i + WIDE <= count; i += WIDE)
        measure(WIDE, size, V + (size_t)i * size, w, part + i);
    for (; i < count; i++)
        measure(1, size, V + (size_t)i * size, w, part + i);
}

static inline __attribute__((always_inline)) void subtract(int together, size_t n, const double V[],
                                                           const double part[], double w[])
{
    size_t k = 0;
    for (; k + WIDE <= n; k += WIDE) {
        lanes rest = *(const lanes *)(w + k);
        for (int i = 0; i < together; i++)
            rest -= part[i] * *(const lanes *)(V + (size_t)i * n + k);
        *(lanes *)(w + k) = rest;
    }
    for (; k < n; k++)
        for (int i = 0; i < together; i++)
            w[k] -= part[i] * V[(size_t)i * n + k];
}

void REAL_NAMED(basis_subtract)(int n, int count, const double V[], const double part[], double w[])
{
    const size_t size = (size_t)n;
    int i = 0;
    for (; i + WIDE <= count; i += WIDE)
        subtract(WIDE, size, V + (size_t)i * size, part + i, w);
    for (; i < count; i++)
        subtract(1, size, V + (size_t)i * size, part + i, w);
}
