#include "elements/exact/measure.h"

#include <math.h>

#include "elements/math/dense.h"

/* What 4 y must be multiplied by, y = tan(angle/4), and its first and second derivative with
 * respect to t = y^2. */
static void ratio(exact_measure_kind kind, double t, double m[3])
{
    if (kind == EXACT_MEASURE_EIGHTH) { /* 2 tan(angle/8)/tan(angle/4) */
        const double r = sqrt(1 + t);
        m[0] = 2 / (1 + r);
        m[1] = -1 / (r * (1 + r) * (1 + r));
        m[2] = (1 + 3 * r) / (2 * r * r * r * (1 + r) * (1 + r) * (1 + r));
        return;
    }
    if (t < 0.01) { /* atan(y)/y = sum (-t)^k/(2 k + 1) */
        double power = 1;
        m[0] = m[1] = m[2] = 0;
        for (int k = 0; k < 10; k++) {
            m[0] += power / (2 * k + 1);
            m[1] -= power * (k + 1) / (2 * k + 3);
            m[2] += power * (k + 1) * (k + 2) / (2 * k + 5);
            power *= -t;
        }
        return;
    }
    m[0] = atan(sqrt(t)) / sqrt(t);
    m[1] = (1 / (1 + t) - m[0]) / (2 * t);
    m[2] = (-1 / ((1 + t) * (1 + t)) - 3 * m[1]) / (2 * t);
}

void exact_measure_of(exact_measure_kind kind, const double x[3], double out[3], double T[9])
{
    double m[3] = {1, 0, 0};
    if (kind != EXACT_MEASURE_QUARTER)
        ratio(kind, vec3_dot(x, x) / 16, m);
    for (int i = 0; i < 3; i++) {
        out[i] = m[0] * x[i];
        for (int j = 0; j < 3; j++)
            T[3 * i + j] = (i == j ? m[0] : 0) + m[1] / 8 * x[i] * x[j];
    }
}

void exact_measure_second(exact_measure_kind kind, const double x[3], const double n[3],
                          double H[9])
{
    double m[3];
    ratio(kind, vec3_dot(x, x) / 16, m);
    const double along = vec3_dot(n, x);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            H[3 * i + j] = m[1] / 8 * (n[i] * x[j] + x[i] * n[j] + (i == j ? along : 0)) +
                           m[2] / 64 * along * x[i] * x[j];
}
