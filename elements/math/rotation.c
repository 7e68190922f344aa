#include "elements/math/rotation.h"

#include <math.h>
#include <stddef.h>

#include "elements/math/dense.h"

/* Finite rotations by unit quaternions. All formulas use half of the angle. sinc keeps the
 * exponential accurate near 0, and atan2 keeps the logarithm accurate near 0 and near pi. */

void rotation_identity(double q[4])
{
    q[0] = 1;
    q[1] = q[2] = q[3] = 0;
}

void rotation_exp(const double phi[3], double q[4])
{
    const double half = vec3_norm(phi) / 2;
    /* sin(h)/(2 h): the next term of the series, h^4/240, is below eps/8 for h < 1e-4 */
    const double s = half > 1e-4 ? sin(half) / (2 * half) : 0.5 - half * half / 12;
    q[0] = cos(half);
    for (int i = 0; i < 3; i++)
        q[i + 1] = s * phi[i];
}

void rotation_log(const double q[4], double phi[3])
{
    const double v = vec3_norm(q + 1), sign = q[0] < 0 ? -1 : 1;
    /* angle = 2 atan2(v, |w|); angle/v = 2/w (1 - (v/w)^2/3 + ...) near 0, where |w| = 1 */
    const double scale =
        v > 1e-5 ? 2 * atan2(v, sign * q[0]) / v : 2 / (sign * q[0]) * (1 - v * v / 3);
    for (int i = 0; i < 3; i++)
        phi[i] = sign * scale * q[i + 1];
}

void rotation_normalise(double q[4])
{
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] /= norm;
}

void rotation_matrix(const double q[4], double R[9])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    R[0] = 1 - 2 * (y * y + z * z);
    R[1] = 2 * (x * y - w * z);
    R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z);
    R[4] = 1 - 2 * (x * x + z * z);
    R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y);
    R[7] = 2 * (y * z + w * x);
    R[8] = 1 - 2 * (x * x + y * y);
}

void rotation_from_matrix(const double R[9], double q[4])
{
    /* Shepperd's method, which divides by the largest of the four components */
    const double trace = R[0] + R[4] + R[8];
    int largest = -1;
    double best = trace;
    for (int i = 0; i < 3; i++)
        if (R[4 * i] > best) {
            best = R[4 * i];
            largest = i;
        }
    if (largest < 0) {
        q[0] = 1 + trace;
        q[1] = R[7] - R[5];
        q[2] = R[2] - R[6];
        q[3] = R[3] - R[1];
    } else {
        const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
        q[0] = R[3 * k + j] - R[3 * j + k];
        q[i + 1] = 1 + R[4 * i] - R[4 * j] - R[4 * k];
        q[j + 1] = R[3 * j + i] + R[3 * i + j];
        q[k + 1] = R[3 * k + i] + R[3 * i + k];
    }
    rotation_normalise(q);
    if (q[0] < 0)
        for (int i = 0; i < 4; i++)
            q[i] = -q[i];
}

void rotation_apply(const double q[4], const double v[3], double Rv[3])
{
    /* v + 2 w (u x v) + 2 u x (u x v) */
    double t[3], s[3];
    vec3_cross(q + 1, v, t);
    vec3_cross(q + 1, t, s);
    for (int i = 0; i < 3; i++)
        Rv[i] = v[i] + 2 * (q[0] * t[i] + s[i]);
}

void rotation_between(const double from[4], const double to[4], double phi[3])
{
    double inverse[4], q[4];
    rotation_conjugate(from, inverse);
    rotation_compose(to, inverse, q);
    rotation_log(q, phi);
}

int rotation_triad(const double x[3], const double y[3], double R[9])
{
    const double length = vec3_norm(x), scale = vec3_norm(y);
    if (!(length > 0) || !(scale > 0))
        return -1;
    double n[3], z[3];
    for (int i = 0; i < 3; i++)
        n[i] = x[i] / length;
    vec3_cross(n, y, z);
    const double across = vec3_norm(z);
    if (!(across > 1e-12 * scale))
        return -1;
    for (int i = 0; i < 3; i++)
        z[i] /= across;
    double b[3];
    vec3_cross(z, n, b);
    for (int i = 0; i < 3; i++) {
        R[3 * i] = n[i];
        R[3 * i + 1] = b[i];
        R[3 * i + 2] = z[i];
    }
    return 0;
}

/* Computes (1 - cos w)/w^2 and (w - sin w)/w^3. */
static void arc_coefficients(double w, double *a, double *b)
{
    const double half = sin(w / 2);
    *a = w < 1e-4 ? 0.5 - w * w / 24 : 2 * half * half / (w * w);
    *b = w < 0.3 ? (1 - w * w / 20 * (1 - w * w / 42 * (1 - w * w / 72 * (1 - w * w / 110)))) / 6
                 : (w - sin(w)) / (w * w * w);
}

void arc_beyond(const double rotation[3], const double e[3], double x, double r[3])
{
    const double part[3] = {rotation[0] * x, rotation[1] * x, rotation[2] * x};
    double a, b, once[3], twice[3];
    arc_coefficients(vec3_norm(part), &a, &b);
    vec3_cross(part, e, once);
    vec3_cross(part, once, twice);
    for (int i = 0; i < 3; i++)
        r[i] = x * (a * once[i] + b * twice[i]);
}

void arc_at(const double rotation[3], const double e[3], double x, double r[3], double q[4])
{
    const double part[3] = {rotation[0] * x, rotation[1] * x, rotation[2] * x};
    double a, b, once[3], twice[3];
    arc_coefficients(vec3_norm(part), &a, &b);
    vec3_cross(part, e, once);
    vec3_cross(part, once, twice);
    for (int i = 0; i < 3; i++)
        r[i] = x * (e[i] + a * once[i] + b * twice[i]);
    rotation_exp(part, q);
}

void arc_to(const double rotation[3], const double r[3], double e[3])
{
    const double half = vec3_norm(rotation) / 2, square = 4 * half * half;
    /* (1 - h cot h)/(2 h)^2: the next term of the series, (2 h)^4/30240, is below eps/4 */
    const double c =
        half < 1e-3 ? 1.0 / 12 + square / 720 : (1 - half * cos(half) / sin(half)) / square;
    double once[3], twice[3];
    vec3_cross(rotation, r, once);
    vec3_cross(rotation, once, twice);
    for (int i = 0; i < 3; i++)
        e[i] = r[i] - once[i] / 2 + c * twice[i];
}

void offset_force(const double rho[3], double force[6])
{
    double moment[3];
    vec3_cross(rho, force, moment);
    for (int i = 0; i < 3; i++)
        force[3 + i] += moment[i];
}

void offset_matrix(int n, int at, const double rho[3], const double force[3], double K[])
{
    for (int i = 0; i < n; i++) {
        double moment[3];
        vec3_cross(rho, &K[i * n + at], moment);
        for (int c = 0; c < 3; c++)
            K[i * n + at + 3 + c] += moment[c];
    }
    for (int j = 0; j < n; j++) {
        const double column[3] = {K[at * n + j], K[(at + 1) * n + j], K[(at + 2) * n + j]};
        double moment[3];
        vec3_cross(rho, column, moment);
        for (int c = 0; c < 3; c++)
            K[(at + 3 + c) * n + j] += moment[c];
    }
    if (force == NULL)
        return;
    const double dot = vec3_dot(force, rho);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[(at + 3 + i) * n + at + 3 + j] +=
                (force[i] * rho[j] + rho[i] * force[j]) / 2 - (i == j ? dot : 0);
}
