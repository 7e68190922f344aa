#include "elements/exact/turn.h"

#include <math.h>

#include "elements/math/dense.h"

/* sum (-t)^k/(2 k + first)! with two derivatives; t < 1. */
static void series(double t, int first, double f[3])
{
    double factorial = 1, power = 1, before = 0, earlier = 0;
    f[0] = f[1] = f[2] = 0;
    for (int k = 2; k <= first; k++)
        factorial *= k;
    for (int k = 0; k < 11; k++) {
        const double term = 1 / factorial;
        f[0] += power * term;
        f[1] -= k * before * term;
        f[2] += k * (k - 1) * earlier * term;
        earlier = before;
        before = power;
        power *= -t;
        factorial *= (2 * k + first + 1) * (2 * k + first + 2);
    }
}

void turn_functions_at(double t, turn_functions *f)
{
    if (t < 1) {
        series(t, 1, f->c);
        series(t, 2, f->a);
        series(t, 3, f->b);
        return;
    }
    const double angle = sqrt(t), cosine = cos(angle);
    f->c[0] = sin(angle) / angle;
    f->a[0] = (1 - cosine) / t;
    f->b[0] = (1 - f->c[0]) / t;
    f->c[1] = (cosine - f->c[0]) / (2 * t);
    f->a[1] = (f->c[0] / 2 - f->a[0]) / t;
    f->b[1] = (-f->c[1] - f->b[0]) / t;
    f->c[2] = (-f->c[0] / 2 - 3 * f->c[1]) / (2 * t);
    f->a[2] = (f->c[1] / 2 - 2 * f->a[1]) / t;
    f->b[2] = (-f->c[2] - 2 * f->b[1]) / t;
}

void turn_vector(const double psi[3], double p, double q, const double y[3], double out[3])
{
    double once[3], twice[3];
    vec3_cross(psi, y, once);
    vec3_cross(psi, once, twice);
    for (int i = 0; i < 3; i++)
        out[i] = y[i] - p * once[i] + q * twice[i];
}

void turn_gradient(const double psi[3], const double p[3], const double q[3], const double x[3], const double y[3], double d_psi[3],
                   double d_y[3])
{
    double yx[3], xpsi[3];
    vec3_cross(y, x, yx);
    vec3_cross(x, psi, xpsi);
    const double t = vec3_dot(psi, psi), xy = vec3_dot(x, y), px = vec3_dot(psi, x), py = vec3_dot(psi, y);
    const double along = 2 * (q[1] * (px * py - t * xy) - p[1] * vec3_dot(psi, yx)) - 2 * q[0] * xy;
    for (int i = 0; i < 3; i++) {
        d_psi[i] = along * psi[i] - p[0] * yx[i] + q[0] * (x[i] * py + y[i] * px);
        d_y[i] = x[i] - p[0] * xpsi[i] + q[0] * (px * psi[i] - t * x[i]);
    }
}

void turn_add_hessian(const double psi[3], const double p[3], const double q[3], const double x[3], const double y[3], double PP[9],
                      double PY[9])
{
    double yx[3], xpsi[3], slope[3];
    vec3_cross(y, x, yx);
    vec3_cross(x, psi, xpsi);
    const double t = vec3_dot(psi, psi), xy = vec3_dot(x, y), px = vec3_dot(psi, x), py = vec3_dot(psi, y);
    const double first = vec3_dot(psi, yx), second = px * py - t * xy;
    const double level = 2 * (q[1] * second - p[1] * first - q[0] * xy), bent = 4 * (q[2] * second - p[2] * first);
    for (int i = 0; i < 3; i++) /* what meets 2 psi: derivatives of `first` and `second` with those of p and q */
        slope[i] = 2 * (q[1] * (x[i] * py + y[i] * px - 2 * psi[i] * xy) - p[1] * yx[i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double cross = i == j ? 0 : (j - i + 3) % 3 == 1 ? x[3 - i - j] : -x[3 - i - j]; /* x~ transposed */
            PP[3 * i + j] += bent * psi[i] * psi[j] + slope[i] * psi[j] + psi[i] * slope[j] + q[0] * (x[i] * y[j] + y[i] * x[j]) +
                             (i == j ? level : 0);
            PY[3 * i + j] += psi[i] * (2 * q[1] * (px * psi[j] - t * x[j]) - 2 * p[1] * xpsi[j] - 2 * q[0] * x[j]) - p[0] * cross +
                             q[0] * (x[i] * psi[j] + (i == j ? px : 0));
        }
}
