/* How the rotation between two nodes is measured: a vector along its axis, whose length is a
 * function of the angle.  In lanes (real.h). */
#ifndef BEAMWORK_EXACT_MEASURE_H
#define BEAMWORK_EXACT_MEASURE_H

#include "elements/math/vec3.h"

typedef enum exact_measure_kind {
    EXACT_MEASURE_QUARTER, /* 4 tan(angle/4): what the interpolation of two quaternions gives half
                              way */
    EXACT_MEASURE_ANGLE,   /* the angle itself */
    EXACT_MEASURE_EIGHTH   /* 8 tan(angle/8) */
} exact_measure_kind;

/* Factor m of 4 y that gives the angle, y = tan(angle/4), and its first and second derivative with
 * respect to t = y^2. */
void exact_measure_angle(double t, double m[3]);

/* The same of the kind wanted, of x of the first kind. */
static inline void exact_measure_ratio(exact_measure_kind kind, const real x[3], real m[3])
{
    const real t = vec3_dot(x, x) * (1.0 / 16);
    if (kind == EXACT_MEASURE_EIGHTH) { /* 2 tan(angle/8)/tan(angle/4) */
        const real r = real_sqrt(1 + t), s = 1 + r;
        m[0] = 2 / s;
        m[1] = -1 / (r * s * s);
        m[2] = (1 + 3 * r) / (2 * (r * r * r) * (s * s * s));
        return;
    }
    for (int lane = 0; lane < LANES; lane++) {
        double one[3];
        exact_measure_angle(real_lane(&t, lane), one);
        for (int i = 0; i < 3; i++)
            real_put(&m[i], lane, one[i]);
    }
}

/* The measure of x [3], and its derivative T [3 x 3]. */
static inline void exact_measure_of(const real m[3], const real x[3], real out[3], real T[9])
{
    const real slope = m[1] * 0.125;
    for (int i = 0; i < 3; i++) {
        out[i] = m[0] * x[i];
        for (int j = 0; j < 3; j++)
            T[3 * i + j] = slope * x[i] * x[j];
        T[4 * i] += m[0];
    }
}

/* Second derivative [3 x 3] of n . measure(x). */
static inline void exact_measure_second(const real m[3], const real x[3], const real n[3],
                                        real H[9])
{
    const real along = vec3_dot(n, x), slope = m[1] * 0.125, bent = m[2] * (1.0 / 64) * along;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            H[3 * i + j] = slope * (n[i] * x[j] + x[i] * n[j]) + bent * x[i] * x[j];
        H[4 * i] += slope * along;
    }
}

#endif
