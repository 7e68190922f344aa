/* The screw displacement that moves node p with its triad to node q with its triad, for one element
 * or several in lanes. R is the mean of the triads of the nodes, D is the chord in the axes of R,
 * psi is the rotation vector, and a = psi/2. In axes that rotate along the screw, the translation
 * is U = V^-1 D, where V is the integral of exp(x psi~) dx from -1/2 to 1/2 and V^-1 = mu + nu a
 * a^T, mu = |a|/sin |a|, nu = (1 - mu)/|a|^2. */
#ifndef BEAMWORK_BEAMW_SCREW_H
#define BEAMWORK_BEAMW_SCREW_H

#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/shared/lanes.h"

/* Positions of mu, nu and tau = tan(|a|/2)/|a| in screw.f. Each is followed by its derivatives
 * with respect to |a|^2. */
enum { SCREW_MU, SCREW_NU = 2, SCREW_TAU = 5, SCREW_FACTORS = 7 };

typedef struct screw {
    real R[9]; /* triad in the middle of the element */
    real D[3], a[3];
    real U[3];  /* U minus l0 along x */
    real along; /* a . D */
    real T[9];  /* dU/dpsi, where dU/dD is V^-1 */
    real V[9];  /* V^-1 */
    real f[SCREW_FACTORS];
} screw;

/* Value of |a|^2 above which the factors use closed forms, which lose digits for smaller values. */
static const double beamw_screw_far = 0.25;
void beamw_screw_far_factors(double square, double f[SCREW_FACTORS]);

enum { SCREW_POWERS = 12 };
/* Coefficients of a/sin a = 1 + sum power[k] t^(k + 1), where t = 4 a^2. */
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
    /* tau is a root of square tau^2 - 2 mu tau + 1 = 0 */
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

/* Computes the quaternion of a rotation, with w >= 0, from the trace if w is the largest
 * component. */
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

/* Computes a and R from the triads of the nodes. */
static inline void beamw_screw_half_way(const node_real x[2], screw *w)
{
    real between[9], q[4], half[9];
    mat3_transpose_mul(x[0].R, x[1].R, between);
    beamw_screw_quaternion(between, q);
    /* Half of the angle is atan2(v, w). Near 0, where w = 1, atan2(v, w)/v is 1/w (1 - (v/w)^2/3 +
     * ...). */
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

/* Computes the screw. l0 is the initial length [m], and x[2] are the states of the nodes. */
static inline void beamw_screw_of(double l0, const node_real x[2], screw *w)
{
    real d[3], moved[3];
    beamw_screw_half_way(x, w);
    for (int i = 0; i < 3; i++) {
        moved[i] = x[1].u[i] - x[0].u[i];
        d[i] = x[1].r[i] - x[0].r[i];
    }
    mat3_transpose_mul_vec(w->R, d, w->D);
    /* computes D_x^2 - l0^2 without subtracting lengths: |d|^2 - l0^2 = (2 d - moved) . moved */
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

/* First derivatives of a screw with respect to the coordinates of the nodes, for constant spatial
 * velocities and angular velocities. In the mean axes, v is the velocity of q relative to p, s is
 * the mean of the angular velocities of the nodes, and delta is their difference. The mean axes
 * rotate with w = s - tau/2 a x delta. The rates are dpsi/dt = V^-1 delta, dD/dt = v - w x D, d(v,
 * s, delta)/dt = -w x (v, s, delta). */

enum { SCREW_COORDINATES = 2 * NODE_COORDINATES };
enum { SCREW_RP = 0, SCREW_TP = 3, SCREW_AP = 6, SCREW_RQ = 7, SCREW_TQ = 10, SCREW_AQ = 13 };

/* Work conjugates of the rates: f . dU/dt + t . dpsi/dt = g . v + mean . s + difference . delta. */
typedef struct screw_work {
    real g[3], t[3], m[3]; /* stresses conjugate to D and to psi, and m = D x g = -mean */
    real p[3];             /* V^-1 t */
    real difference[3];
} screw_work;

/* Completes the work conjugates from g and t. */
static inline void beamw_screw_rates_complete(const screw *w, screw_work *k)
{
    real side[3];
    vec3_cross(w->D, k->g, k->m);
    mat3_mul_vec(w->V, k->t, k->p);
    vec3_cross(k->m, w->a, side);
    for (int i = 0; i < 3; i++)
        k->difference[i] = k->p[i] + w->f[SCREW_TAU] / 2 * side[i];
}

/* Computes the work conjugates of the force f and the moment. */
static inline void beamw_screw_rates_work(const screw *w, const real f[3], const real moment[3],
                                          screw_work *k)
{
    mat3_mul_vec(w->V, f, k->g); /* symmetric */
    mat3_transpose_mul_vec(w->T, f, k->t);
    for (int i = 0; i < 3; i++)
        k->t[i] += moment[i];
    beamw_screw_rates_complete(w, k);
}

/* Gradients of U with respect to v, s and delta, in global axes, stored by columns. The gradient of
 * psi with respect to delta equals that of U with respect to v. */
typedef struct screw_gradient {
    real v[9], s[9], delta[9];
} screw_gradient;

static inline void beamw_screw_rates_gradient(const screw *w, screw_gradient *out)
{
    real mean[9], difference[9];
    for (int i = 0; i < 3; i++) {
        screw_work k; /* work conjugates of a unit force */
        memcpy(k.g, w->V + 3 * i, sizeof k.g);
        memcpy(k.t, w->T + 3 * i, sizeof k.t);
        beamw_screw_rates_complete(w, &k);
        for (int j = 0; j < 3; j++) {
            mean[3 * j + i] = -k.m[j];
            difference[3 * j + i] = k.difference[j];
        }
    }
    mat3_mul(w->R, w->V, out->v);
    mat3_mul(w->R, mean, out->s);
    mat3_mul(w->R, difference, out->delta);
}

/* Computes a row: sign times the gradient of U_translation plus part l0 times the gradient of
 * psi_rotation. */
static inline void beamw_screw_rates_row(const screw_gradient *g, int translation, double sign,
                                         int rotation, double part, real row[SCREW_COORDINATES])
{
    for (int i = 0; i < 3; i++) {
        const real force = sign * g->v[3 * i + translation],
                   mean = sign / 2 * g->s[3 * i + translation],
                   difference =
                       sign * g->delta[3 * i + translation] + part * g->v[3 * i + rotation];
        row[SCREW_RP + i] = -force;
        row[SCREW_RQ + i] = force;
        row[SCREW_TP + i] = mean - difference;
        row[SCREW_TQ + i] = mean + difference;
    }
    row[SCREW_AP] = row[SCREW_AQ] = real_of(0);
}

/* Second derivatives of a screw with respect to the coordinates of the nodes, in the exponential
 * chart. */

/* Blocks of a symmetric form in v, s and delta. */
typedef struct screw_form {
    real vd[9], ss[9], sd[9], dd[9];
} screw_form;

/* Computes the second derivatives of f . U with respect to (D, psi): `bent` with respect to (psi,
 * psi) and `mixed` with respect to (psi, D). */
static inline void beamw_screw_forms_translation(const screw *w, const real f[3], real bent[9],
                                                 real mixed[9])
{
    const real *a = w->a, *nu = w->f + SCREW_NU;
    const real square = vec3_dot(a, a), fD = vec3_dot(f, w->D), fa = vec3_dot(f, a),
               across = fa * w->along - square * fD;
    real coupled[3], aside[3];
    for (int i = 0; i < 3; i++) {
        coupled[i] = f[i] * w->along + w->D[i] * fa - 2 * a[i] * fD;
        aside[i] = nu[1] * (a[i] * fa - square * f[i]) - nu[0] * f[i];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            real even = nu[0] / 4 * (f[i] * w->D[j] + w->D[i] * f[j]) +
                        nu[1] / 2 * (a[i] * coupled[j] + coupled[i] * a[j]) +
                        nu[2] * across * a[i] * a[j],
                 odd = nu[0] / 2 * f[i] * a[j] + a[i] * aside[j];
            if (i == j) {
                even += nu[1] / 2 * across - nu[0] / 2 * fD;
                odd += nu[0] / 2 * fa;
            }
            bent[3 * i + j] = even;
            mixed[3 * i + j] = odd;
        }
}

/* Transforms the second derivatives to v, w and delta. The blocks of w are stored in place of those
 * of s. */
static inline void beamw_screw_forms_middle(const screw *w, const screw_work *k, const real f[3],
                                            screw_form *out)
{
    real bent[9], mixed[9], VM[9], VB[9], side[3];
    const real *mu = w->f + SCREW_MU, *nu = w->f + SCREW_NU, *tau = w->f + SCREW_TAU, *a = w->a,
               *p = k->p;
    const real moment[9] = {real_of(0), -p[2], p[1], p[2],      real_of(0),
                            -p[0],      -p[1], p[0], real_of(0)};
    beamw_screw_forms_translation(w, f, bent, mixed);
    mat3_mul(w->V, mixed, VM);
    mat3_mul(w->V, bent, VB);
    mat3_mul(VB, w->V, out->dd);
    vec3_cross(k->m, a, side);
    const real gD = vec3_dot(k->g, w->D), ma = vec3_dot(k->m, a), ta = vec3_dot(k->t, a);
    const real c1 = (tau[1] + tau[0] * nu[0] / 2) / 4, c2 = (mu[1] + nu[0] * mu[0] / 2) / 2,
               c3 = ta * (nu[1] + nu[0] * nu[0]), c4 = ta * nu[0] * mu[0] / 2;
    real reach[3];
    for (int j = 0; j < 3; j++)
        reach[j] = c1 * side[j] + c2 * k->t[j] + c3 / 2 * a[j];
    for (int i = 0; i < 3; i++) {
        real VMD[3]; /* VM D~ */
        vec3_cross(VM + 3 * i, w->D, VMD);
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j, mirrored = 3 * j + i, same = i == j;
            out->vd[mirrored] = VM[at];
            out->ss[at] = (k->g[i] * w->D[j] + w->D[i] * k->g[j]) / 2;
            out->sd[mirrored] = VMD[j] + (moment[mirrored] - tau[0] / 2 * k->m[j] * a[i]) / 2;
            out->dd[at] += a[i] * reach[j] + reach[i] * a[j];
            if (same) {
                out->ss[at] -= gD;
                out->sd[at] += tau[0] / 4 * ma;
                out->dd[at] += c4;
            }
        }
    }
}

/* Transforms from w to s, where w = s + C delta and C = -tau/2 a~. */
static inline void beamw_screw_forms_nodes(const screw *w, const screw_work *work, screw_form *k)
{
    real c[3], ssC[9], Csd[9];
    for (int i = 0; i < 3; i++)
        c[i] = -w->f[SCREW_TAU] / 2 * w->a[i];
    const real gc = vec3_dot(work->g, c);
    for (int i = 0; i < 3; i++) {
        vec3_cross(k->ss + 3 * i, c, ssC + 3 * i); /* rows of ss c~ */
        for (int j = 0; j < 3; j++)                /* vs c~ = -g~ c~ */
            k->vd[3 * i + j] -= c[i] * work->g[j];
        k->vd[4 * i] += gc;
    }
    for (int j = 0; j < 3; j++) { /* C^T (sd + ss C/2) = -c~ .., by columns */
        const real column[3] = {k->sd[j] + ssC[j] / 2, k->sd[3 + j] + ssC[3 + j] / 2,
                                k->sd[6 + j] + ssC[6 + j] / 2};
        real turned[3];
        vec3_cross(column, c, turned);
        for (int i = 0; i < 3; i++)
            Csd[3 * i + j] = turned[i];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            k->sd[3 * i + j] += ssC[3 * i + j];
            k->dd[3 * i + j] += Csd[3 * i + j] + Csd[3 * j + i];
        }
}

/* Replaces A by R A R^T. */
static inline void beamw_screw_forms_turn(const real R[9], real A[9])
{
    real RA[9];
    mat3_mul(R, A, RA);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = vec3_dot(RA + 3 * i, R + 3 * j);
}

static inline void beamw_screw_forms_nodal(const screw *w, const screw_work *work, screw_form *k,
                                           real H[SCREW_COORDINATES * SCREW_COORDINATES])
{
    enum { N = SCREW_COORDINATES, RP = SCREW_RP, TP = SCREW_TP, RQ = SCREW_RQ, TQ = SCREW_TQ };
    real g[3], ss[9], dd[9];
    beamw_screw_forms_turn(w->R, k->vd);
    beamw_screw_forms_turn(w->R, k->ss);
    beamw_screw_forms_turn(w->R, k->sd);
    beamw_screw_forms_turn(w->R, k->dd);
    mat3_mul_vec(w->R, work->g, g);
    const real vs[9] = {real_of(0), g[2] / 2, -g[1] / 2, -g[2] / 2, real_of(0),
                        g[0] / 2,   g[1] / 2, -g[0] / 2, real_of(0)};
    for (int i = 0; i < N * N; i++)
        H[i] = real_of(0);
    for (int i = 0; i < 9; i++) {
        ss[i] = k->ss[i] / 4;
        dd[i] = k->dd[i];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j, mirrored = 3 * j + i;
            const real even = ss[at] + dd[at], odd = (k->sd[at] + k->sd[mirrored]) / 2;
            const real across = ss[at] - dd[at] + (k->sd[at] - k->sd[mirrored]) / 2;
            const real toward_p = vs[at] - k->vd[at], toward_q = vs[at] + k->vd[at];
            H[(TP + i) * N + TP + j] = even - odd;
            H[(TQ + i) * N + TQ + j] = even + odd;
            H[(TP + i) * N + TQ + j] = H[(TQ + j) * N + TP + i] = across;
            H[(RQ + i) * N + TP + j] = H[(TP + j) * N + RQ + i] = toward_p;
            H[(RQ + i) * N + TQ + j] = H[(TQ + j) * N + RQ + i] = toward_q;
            H[(RP + i) * N + TP + j] = H[(TP + j) * N + RP + i] = -toward_p;
            H[(RP + i) * N + TQ + j] = H[(TQ + j) * N + RP + i] = -toward_q;
        }
}

/* Computes H [14 x 14]: the second derivatives of f . U + moment . psi. */
static inline void beamw_screw_forms_second(const screw *w, const real f[3], const real moment[3],
                                            real H[SCREW_COORDINATES * SCREW_COORDINATES])
{
    screw_work k;
    screw_form second;
    beamw_screw_rates_work(w, f, moment, &k);
    beamw_screw_forms_middle(w, &k, f, &second);
    beamw_screw_forms_nodes(w, &k, &second);
    beamw_screw_forms_nodal(w, &k, &second, H);
}

/* Helicoidal strains, which equal the strains of a beam if these are uniform. The screw
 * displacement that moves node p with its triad to node q has the rotation vector psi and, in axes
 * that rotate along the screw, the translation U. The strains are e1 = U_x - l0, e2 = l0 psi_x, e3,
 * e4 = l0 psi_y/2 -+ U_z, e5, e6 = l0 psi_z/2 +- U_y, e7, e8 = l0^2 a. The strains agree with J Eq.
 * 7 to first order, do not change when p and q are exchanged, and represent uniform strains of any
 * size exactly: U = l0 (e_x + gamma), psi = l0 kappa. J Eq. 7 uses sines of angles to the chord,
 * and is not exact for uniform strains with shear deformation. */

/* Each of e1 .. e6 is sign U_translation + part l0 psi_rotation. */
static const struct {
    int translation, rotation;
    double sign, part;
} beamw_helicoidal_strain[] = {{0, 0, 1, 0},   {0, 0, 0, 1},   {2, 1, -1, 0.5},
                               {2, 1, 1, 0.5}, {1, 2, 1, 0.5}, {1, 2, -1, 0.5}};
enum { BEAMW_HELICOIDAL_ALONG = 6 };

/* Computes the outputs of element_type.strain for one element or several in lanes. l0 is the
 * initial length [m]. */
static inline void beamw_helicoidal_evaluate(double l0, const node_real x[2], strain_real *out)
{
    enum { N = SCREW_COORDINATES };
    screw w;
    beamw_screw_of(l0, x, &w);
    if (out->e != NULL) {
        for (int k = 0; k < BEAMW_HELICOIDAL_ALONG; k++)
            out->e[k] =
                beamw_helicoidal_strain[k].sign * w.U[beamw_helicoidal_strain[k].translation] +
                beamw_helicoidal_strain[k].part * 2 * l0 * w.a[beamw_helicoidal_strain[k].rotation];
        out->e[6] = l0 * l0 * x[0].a;
        out->e[7] = l0 * l0 * x[1].a;
    }
    if (out->J != NULL) {
        screw_gradient g;
        beamw_screw_rates_gradient(&w, &g);
        for (int k = 0; k < BEAMW_HELICOIDAL_ALONG; k++)
            beamw_screw_rates_row(&g, beamw_helicoidal_strain[k].translation,
                                  beamw_helicoidal_strain[k].sign,
                                  beamw_helicoidal_strain[k].rotation,
                                  beamw_helicoidal_strain[k].part * l0, out->J + N * k);
        for (int i = 0; i < 2 * N; i++)
            out->J[6 * N + i] = real_of(0);
        out->J[6 * N + SCREW_AP] = out->J[7 * N + SCREW_AQ] = real_of(l0 * l0);
    }
    if (out->s != NULL && out->H != NULL) {
        const real *s = out->s, f[3] = {s[0], s[4] - s[5], s[3] - s[2]};
        const real t[3] = {l0 * s[1], l0 / 2 * (s[2] + s[3]), l0 / 2 * (s[4] + s[5])};
        beamw_screw_forms_second(&w, f, t, out->H);
    }
}

#endif
