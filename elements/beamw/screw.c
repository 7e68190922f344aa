#include "elements/beamw/screw.h"

#include <math.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

enum { POWERS = 12 };

/* a/sin a = 1 + sum power[k] t^(k + 1) */
static const double power[POWERS] = {
    0.041666666666666664,   0.0012152777777777778, 3.2035383597883595e-05, 8.202608300264551e-07,
    2.0835982071876168e-08, 5.281609967721337e-10, 1.3380902920268335e-11, 3.389576851489321e-13,
    8.585996549822947e-15,  2.174864550325223e-16, 5.509000201462976e-18,  1.3954463022310702e-19,
};

static screw_factors factors_of(double square)
{
    screw_factors f;
    if (square < 0.25) { /* closed forms cancel */
        const double t = 4 * square;
        double n[3] = {0};
        for (int k = POWERS - 1; k >= 0; k--) {
            n[2] = n[2] * t + 2 * n[1];
            n[1] = n[1] * t + n[0];
            n[0] = n[0] * t - power[k];
        }
        f.nu[0] = 4 * n[0];
        f.nu[1] = 16 * n[1];
        f.nu[2] = 64 * n[2];
        f.mu[0] = 1 - square * f.nu[0];
        f.mu[1] = -f.nu[0] - square * f.nu[1];
        /* square tau^2 - 2 mu tau + 1 = 0 */
        const double cotangent = sqrt(f.mu[0] * f.mu[0] - square);
        f.tau[0] = 1 / (f.mu[0] + cotangent);
        f.tau[1] = f.tau[0] * (f.tau[0] - 2 * f.mu[1]) / (2 * cotangent);
        return f;
    }
    const double a = sqrt(square), s = sin(a), c = cos(a), tangent = tan(a / 2),
                 p = (s - a * c) / (s * s);
    const double slope =
        (a * s * s - 2 * c * (s - a * c)) / (s * s * s); /* of p, itself the slope of a/sin a */
    f.mu[0] = a / s;
    f.mu[1] = p / (2 * a);
    f.nu[0] = (1 - f.mu[0]) / square;
    f.nu[1] = -(f.mu[1] + f.nu[0]) / square;
    f.nu[2] = -((slope - p / a) / (4 * square) + 2 * f.nu[1]) / square;
    f.tau[0] = tangent / a;
    f.tau[1] = ((1 + tangent * tangent) / 2 - f.tau[0]) / (2 * square);
    return f;
}

static void half_way(const node_state x[2], screw *w)
{
    double between[9], q[4], psi[3], half[9];
    mat3_transpose_mul(x[0].R, x[1].R, between);
    rotation_from_matrix(between, q);
    rotation_log(q, psi);
    for (int i = 0; i < 3; i++)
        w->a[i] = psi[i] / 2;
    rotation_exp(w->a, q);
    rotation_matrix(q, half);
    mat3_mul(x[0].R, half, w->R);
}

screw beamw_screw(double l0, const node_state x[2])
{
    screw w;
    double d[3], moved[3];
    half_way(x, &w);
    for (int i = 0; i < 3; i++) {
        moved[i] = x[1].u[i] - x[0].u[i];
        d[i] = x[1].r[i] - x[0].r[i];
    }
    mat3_transpose_mul_vec(w.R, d, w.D);
    /* D_x^2 - l0^2 without a difference of lengths: |d|^2 - l0^2 = (2 d - moved) . moved */
    const double squares =
        2 * vec3_dot(d, moved) - vec3_dot(moved, moved) - w.D[1] * w.D[1] - w.D[2] * w.D[2];
    w.extension = w.D[0] > 0 ? squares / (w.D[0] + l0) : w.D[0] - l0;
    const double square = vec3_dot(w.a, w.a);
    w.f = factors_of(square);
    w.along = vec3_dot(w.a, w.D);
    for (int i = 0; i < 3; i++) {
        const double across = w.a[i] * w.along - square * w.D[i]; /* a x (a x D) */
        w.U[i] = (i == 0 ? w.extension : w.D[i]) + w.f.nu[0] * across;
        for (int j = 0; j < 3; j++) {
            const double coupling = (i == j ? w.along : 0) + w.a[i] * w.D[j] - 2 * w.D[i] * w.a[j];
            w.T[3 * i + j] = w.f.nu[0] * coupling / 2 + w.f.nu[1] * across * w.a[j];
            w.V[3 * i + j] = (i == j ? w.f.mu[0] : 0) + w.f.nu[0] * w.a[i] * w.a[j];
        }
    }
    return w;
}
