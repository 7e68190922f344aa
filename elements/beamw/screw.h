/* The screw displacement that takes node p and its triad to node q, of one element or of several in
 * lanes.  With R half way between the triads of the nodes, D the chord in its axes, psi the
 * rotation vector and a = psi/2, the translation along the way in axes that turn on it is U = V^-1
 * D,  V = int from -1/2 to 1/2 of exp(x psi~) dx,  V^-1 = mu + nu a a^T, mu = |a|/sin |a|,  nu = (1
 * - mu)/|a|^2. */
#ifndef BEAMWORK_BEAMW_SCREW_H
#define BEAMWORK_BEAMW_SCREW_H

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/shared/lanes.h"

/* mu, nu, tau = tan(|a|/2)/|a| and their derivatives with respect to |a|^2. */
enum { SCREW_MU, SCREW_NU = 2, SCREW_TAU = 5, SCREW_FACTORS = 7 };

typedef struct screw {
    real R[9]; /* triad of the middle */
    real D[3], a[3];
    real U[3];  /* less l0 along x */
    real along; /* a . D */
    real T[9];  /* dU/dpsi; dU/dD is V^-1 */
    real V[9];  /* V^-1 */
    real f[SCREW_FACTORS];
} screw;

/* Beyond that |a|^2 the factors have closed forms, which cancel below. */
static const double beamw_screw_far = 0.25;
void beamw_screw_far_factors(double square, double f[SCREW_FACTORS]);

enum { SCREW_POWERS = 12 };
/* a/sin a = 1 + sum power[k] t^(k + 1), t = 4 a^2 */
extern const double beamw_screw_power[SCREW_POWERS];

static inline void beamw_screw_factors(real square, real f[SCREW_FACTORS])
{
    const real t = 4 * square;
    real n[3] = {real_of(0), real_of(0), real_of(0)};
    for (int k = SCREW_POWERS - 1; k >= 0; k--) {
        n[2] = n[2] * t + 2 * n[1];
        n[1] = n[1] * t + n[0];
        n[0] = n[0] * t - beamw_screw_power[k];
    }
    real *nu = f + SCREW_NU, *mu = f + SCREW_MU, *tau = f + SCREW_TAU;
    nu[0] = 4 * n[0];
    nu[1] = 16 * n[1];
    nu[2] = 64 * n[2];
    mu[0] = 1 - square * nu[0];
    mu[1] = -nu[0] - square * nu[1];
    /* square tau^2 - 2 mu tau + 1 = 0 */
    const real cotangent = real_sqrt(mu[0] * mu[0] - square);
    tau[0] = 1 / (mu[0] + cotangent);
    tau[1] = tau[0] * (tau[0] - 2 * mu[1]) / (2 * cotangent);
    for (int lane = 0; lane < LANES; lane++) {
        double closed[SCREW_FACTORS];
        if (real_lane(&square, lane) < beamw_screw_far)
            continue;
        beamw_screw_far_factors(real_lane(&square, lane), closed);
        for (int i = 0; i < SCREW_FACTORS; i++)
            real_put(&f[i], lane, closed[i]);
    }
}

/* Quaternion of a rotation, w >= 0: from the trace where that is its largest part. */
static inline void beamw_screw_quaternion(const real B[9], real q[4])
{
    const real trace = B[0] + B[4] + B[8];
    q[0] = 1 + trace;
    q[1] = B[7] - B[5];
    q[2] = B[2] - B[6];
    q[3] = B[3] - B[1];
    const real inverse = 1 / real_sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] *= inverse;
    const real_truth usual = (trace >= B[0]) & (trace >= B[4]) & (trace >= B[8]);
    for (int lane = 0; lane < LANES; lane++) {
        double matrix[9], found[4];
        if (real_holds(usual, lane))
            continue;
        for (int i = 0; i < 9; i++)
            matrix[i] = real_lane(&B[i], lane);
        rotation_from_matrix(matrix, found);
        for (int i = 0; i < 4; i++)
            real_put(&q[i], lane, found[i]);
    }
}

/* a and R from the triads of the nodes. */
static inline void beamw_screw_half_way(const node_real x[2], screw *w)
{
    real between[9], q[4], half[9];
    mat3_transpose_mul(x[0].R, x[1].R, between);
    beamw_screw_quaternion(between, q);
    /* half of the angle = atan2(v, w); over v 1/w (1 - (v/w)^2/3 + ..) near 0, where w = 1 */
    const real square = q[1] * q[1] + q[2] * q[2] + q[3] * q[3], v = real_sqrt(square),
               scale = real_choose(v > 1e-5, real_atan2(v, q[0]) / v, (1 - square / 3) / q[0]);
    const real cosine = real_sqrt((1 + q[0]) / 2), sines = 0.5 / cosine;
    for (int i = 0; i < 3; i++)
        w->a[i] = scale * q[i + 1];
    const real h[4] = {cosine, sines * q[1], sines * q[2], sines * q[3]};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        half[4 * i] = 1 - 2 * (h[1 + j] * h[1 + j] + h[1 + k] * h[1 + k]);
        half[3 * i + j] = 2 * (h[1 + i] * h[1 + j] - h[0] * h[1 + k]);
        half[3 * j + i] = 2 * (h[1 + i] * h[1 + j] + h[0] * h[1 + k]);
    }
    mat3_mul(x[0].R, half, w->R);
}

/* l0 [m]: length at rest; x[2]: states of the nodes. */
static inline void beamw_screw_of(double l0, const node_real x[2], screw *w)
{
    real d[3], moved[3];
    beamw_screw_half_way(x, w);
    for (int i = 0; i < 3; i++) {
        moved[i] = x[1].u[i] - x[0].u[i];
        d[i] = x[1].r[i] - x[0].r[i];
    }
    mat3_transpose_mul_vec(w->R, d, w->D);
    /* D_x^2 - l0^2 without a difference of lengths: |d|^2 - l0^2 = (2 d - moved) . moved */
    const real squares =
        2 * vec3_dot(d, moved) - vec3_dot(moved, moved) - w->D[1] * w->D[1] - w->D[2] * w->D[2];
    const real extension =
        real_choose(w->D[0] > 0, squares / (w->D[0] + l0), w->D[0] - l0); /* D_x - l0 */
    const real square = vec3_dot(w->a, w->a);
    beamw_screw_factors(square, w->f);
    const real *mu = w->f + SCREW_MU, *nu = w->f + SCREW_NU;
    w->along = vec3_dot(w->a, w->D);
    for (int i = 0; i < 3; i++) {
        const real across = w->a[i] * w->along - square * w->D[i]; /* a x (a x D) */
        const real bent = nu[1] * across;
        w->U[i] = (i == 0 ? extension : w->D[i]) + nu[0] * across;
        for (int j = 0; j < 3; j++) {
            const real coupling =
                (i == j ? w->along : real_of(0)) + w->a[i] * w->D[j] - 2 * w->D[i] * w->a[j];
            w->T[3 * i + j] = nu[0] * coupling / 2 + bent * w->a[j];
            w->V[3 * i + j] = (i == j ? mu[0] : real_of(0)) + nu[0] * w->a[i] * w->a[j];
        }
    }
}

#endif
