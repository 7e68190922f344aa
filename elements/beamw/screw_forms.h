/* Second derivatives of a screw with respect to the nodes' coordinates, in the exponential chart:
 * symmetric forms in (v, s, delta) of screw_rates.h, in the axes of the middle first, then fixed.
 */
#ifndef BEAMWORK_BEAMW_SCREW_FORMS_H
#define BEAMWORK_BEAMW_SCREW_FORMS_H

#include "elements/beamw/screw_rates.h"

/* v meets v in nothing; in s as g turns. ss and dd are symmetric. */
typedef struct screw_form {
    real vd[9], ss[9], sd[9], dd[9];
} screw_form;

/* Second derivatives of f . U with respect to (D, psi): bent [psi, psi], mixed [psi, D]. */
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

/* In v, w and delta; the blocks of w stand where those of s will. */
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

/* w = s + C delta, C = -tau/2 a~. */
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

/* R A R^T. */
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

/* H [14 x 14]: second derivatives of f . U + moment . psi. */
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

#endif
