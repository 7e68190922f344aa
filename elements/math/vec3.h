/* Vectors of 3 and matrices of 3 x 3, row-major, for one element or several in lanes. */
#ifndef BEAMWORK_VEC3_H
#define BEAMWORK_VEC3_H

#include "elements/math/real.h"

static inline real vec3_dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vec3_cross(const real a[3], const real b[3], real c[3]) /* c must not alias */
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline real vec3_norm(const real a[3])
{
    return real_hypot(real_hypot(a[0], a[1]), a[2]);
}

/* Returns |d| - l0 for d = d0 + moved, where |d0| = l0. The form (2 d - moved) . moved/(|d| + l0)
 * avoids cancellation. */
static inline real vec3_elongation(const real d[3], const real moved[3], double l0)
{
    const real sum[3] = {2 * d[0] - moved[0], 2 * d[1] - moved[1], 2 * d[2] - moved[2]};
    return vec3_dot(sum, moved) / (real_sqrt(vec3_dot(d, d)) + l0);
}

static inline void mat3_mul(const real A[9], const real B[9], real C[9]) /* C = A B, no alias */
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
}

static inline void mat3_transpose_mul(const real A[9], const real B[9],
                                      real C[9]) /* C = A^T B, no alias */
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] = A[i] * B[j] + A[3 + i] * B[3 + j] + A[6 + i] * B[6 + j];
}

static inline void mat3_mul_vec(const real A[9], const real v[3], real w[3]) /* no alias */
{
    for (int i = 0; i < 3; i++)
        w[i] = A[3 * i] * v[0] + A[3 * i + 1] * v[1] + A[3 * i + 2] * v[2];
}

static inline void mat3_transpose_mul_vec(const real A[9], const real v[3],
                                          real w[3]) /* w = A^T v, no alias */
{
    for (int i = 0; i < 3; i++)
        w[i] = A[i] * v[0] + A[3 + i] * v[1] + A[6 + i] * v[2];
}

/* Adds A^T B to C, which must not alias A or B. */
static inline void mat3_add_transpose_mul(const real A[9], const real B[9], real C[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] += A[i] * B[j] + A[3 + i] * B[3 + j] + A[6 + i] * B[6 + j];
}

/* Subtracts A^T B from C, term by term; C must not alias A or B. */
static inline void mat3_subtract_transpose_mul(const real A[9], const real B[9], real C[9])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                C[3 * i + j] -= A[3 * k + i] * B[3 * k + j];
}

#endif
