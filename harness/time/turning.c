#include "harness/time/turning.h"

#include <math.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

/* Below it the series are exact to rounding. */
static const double small = 0.05;

/* (1 - cos x)/x^2, (x - sin x)/x^3, and their derivatives by x divided by x. */
static void coefficients(double x, double *b, double *c, double *db, double *dc)
{
    const double s = x * x;
    if (x < small) {
        *b = 1 / 2.0 - s / 24 * (1 - s / 30 * (1 - s / 56));
        *c = 1 / 6.0 - s / 120 * (1 - s / 42 * (1 - s / 72));
        *db = -1 / 12.0 + s / 180 * (1 - s * 3 / 112 * (1 - s * 4 / 270));
        *dc = -1 / 60.0 + s / 1260 * (1 - s / 48 * (1 - s * 4 / 330));
        return;
    }
    const double half = sin(x / 2);
    *b = 2 * half * half / s;
    *c = (x - sin(x)) / (s * x);
    *db = (sin(x) / x - 2 * *b) / s;
    *dc = (*b - 3 * *c) / s;
}

/* out = p 1 + q t~ + r t~ t~ */
static void polynomial(const double t[3], double p, double q, double r, double out[9])
{
    const double square = vec3_dot(t, t);
    const double skew[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = (i == j ? p - r * square : 0) + q * skew[3 * i + j] + r * t[i] * t[j];
}

void turning_jacobian(const double t[3], double Jr[9])
{
    double b, c, db, dc;
    coefficients(vec3_norm(t), &b, &c, &db, &dc);
    polynomial(t, 1, -b, c, Jr);
}

void turning_inverse(const double t[3], double inverse[9])
{
    const double x = vec3_norm(t), s = x * x;
    const double r =
        x < small ? 1 / 12.0 + s / 720 * (1 + s / 42 * (1 + s / 40)) : (1 - x / 2 / tan(x / 2)) / s;
    polynomial(t, 1, 0.5, r, inverse);
}

/* Jr y = y - b t x y + c t x (t x y) */
void turning_derivative(const double t[3], const double y[3], double D[9])
{
    double b, c, db, dc, ty[3], tty[3];
    coefficients(vec3_norm(t), &b, &c, &db, &dc);
    vec3_cross(t, y, ty);
    vec3_cross(t, ty, tty);
    const double along = vec3_dot(t, y);
    const double skew[9] = {0, -y[2], y[1], y[2], 0, -y[0], -y[1], y[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            D[3 * i + j] = b * skew[3 * i + j] + (dc * tty[i] - db * ty[i]) * t[j] +
                           c * ((i == j ? along : 0) + t[i] * y[j] - 2 * y[i] * t[j]);
}

void turning_add(double t[3], const double d[3])
{
    double p[4], q[4];
    rotation_exp(t, p);
    rotation_exp(d, q);
    rotation_compose(p, q, p);
    rotation_normalise(p);
    rotation_log(p, t);
}
