#include "elements/geometrically_exact/measure.h"

#include <math.h>

void exact_measure_angle(double t, double m[3])
{
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
