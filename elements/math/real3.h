/* Vectors of 3 and matrices of 3 x 3, row-major, of numbers in lanes (real.h). */
#ifndef BEAMWORK_REAL3_H
#define BEAMWORK_REAL3_H

#include "elements/math/real.h"

static inline real real3_dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void real3_cross(const real a[3], const real b[3], real c[3]) /* no alias */
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* w = A^T v, no alias */
static inline void real3_transpose_mul_vec(const real A[9], const real v[3], real w[3])
{
    for (int i = 0; i < 3; i++)
        w[i] = A[i] * v[0] + A[3 + i] * v[1] + A[6 + i] * v[2];
}

/* C = A B, no alias */
static inline void real3_mul(const real A[9], const real B[9], real C[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
}

/* C += A^T B, no alias */
static inline void real3_add_transpose_mul(const real A[9], const real B[9], real C[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] += A[i] * B[j] + A[3 + i] * B[3 + j] + A[6 + i] * B[6 + j];
}

/* C -= A^T B, term by term; no alias */
static inline void real3_subtract_transpose_mul(const real A[9], const real B[9], real C[9])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                C[3 * i + j] -= A[3 * k + i] * B[3 * k + j];
}

static inline void real3_zero(int n, real a[])
{
    for (int i = 0; i < n; i++)
        a[i] = real_of(0);
}

#endif
