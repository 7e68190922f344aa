/* Rates along a path of constant spatial velocities and spins, in the axes of the middle: v of q
 * against p, s the mean of the nodes' spins and delta their difference.  The middle turns with w =
 * s - tau/2 a x delta and dpsi/dt = V^-1 delta,  dD/dt = v - w x D,  d(v, s, delta)/dt = -w x (v,
 * s, delta). */
#include "elements/beamw/helicoidal.h"

#include <string.h>

#include "elements/beamw/screw.h"
#include "elements/math/dense.h"

enum { STRAINS = 8, COORDINATES = 14 };
enum { RP = 0, TP = 3, AP = 6, RQ = 7, TQ = 10, AQ = 13 };

/* What works on the rates: sum of f . dU/dt + t . dpsi/dt = g . v + mean . s + difference . delta.
 */
typedef struct work {
    double g[3], t[3], m[3]; /* dual to D, to psi; m = D x g */
    double p[3];             /* V^-1 t */
    double mean[3], difference[3];
} work;

static work work_of(const screw *w, const double f[3], const double moment[3])
{
    work k;
    double tf[3], side[3];
    mat3_mul_vec(w->V, f, k.g); /* symmetric */
    mat3_transpose_mul_vec(w->T, f, tf);
    for (int i = 0; i < 3; i++)
        k.t[i] = moment[i] + tf[i];
    vec3_cross(w->D, k.g, k.m);
    mat3_mul_vec(w->V, k.t, k.p);
    vec3_cross(k.m, w->a, side);
    for (int i = 0; i < 3; i++) {
        k.mean[i] = -k.m[i];
        k.difference[i] = k.p[i] + w->f.tau[0] / 2 * side[i];
    }
    return k;
}

/* Row [14] on the nodes' coordinates. */
static void nodal_row(const screw *w, const work *k, double row[COORDINATES])
{
    double force[3], mean[3], difference[3];
    mat3_mul_vec(w->R, k->g, force);
    mat3_mul_vec(w->R, k->mean, mean);
    mat3_mul_vec(w->R, k->difference, difference);
    for (int i = 0; i < 3; i++) {
        row[RP + i] = -force[i];
        row[RQ + i] = force[i];
        row[TP + i] = mean[i] / 2 - difference[i];
        row[TQ + i] = mean[i] / 2 + difference[i];
    }
    row[AP] = row[AQ] = 0;
}

/* Symmetric form in (v, s, delta); v meets v in nothing. */
typedef struct form {
    double vs[9], vd[9], ss[9], sd[9], dd[9];
} form;

static void skew(const double v[3], double A[9])
{
    const double cross[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, cross, sizeof cross);
}

/* Second derivatives of f . U with respect to (D, psi): bent [psi, psi], mixed [psi, D]. */
static void second_of_translation(const screw *w, const double f[3], double bent[9],
                                  double mixed[9])
{
    const double square = vec3_dot(w->a, w->a), fD = vec3_dot(f, w->D), fa = vec3_dot(f, w->a),
                 across = fa * w->along - square * fD;
    double coupled[3];
    for (int i = 0; i < 3; i++)
        coupled[i] = f[i] * w->along + w->D[i] * fa - 2 * w->a[i] * fD;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double p = w->a[i], q = w->a[j];
            bent[3 * i + j] =
                w->f.nu[0] / 4 * (f[i] * w->D[j] + w->D[i] * f[j] - (i == j ? 2 * fD : 0)) +
                w->f.nu[1] / 2 * (p * coupled[j] + coupled[i] * q + (i == j ? across : 0)) +
                w->f.nu[2] * across * p * q;
            mixed[3 * i + j] = w->f.nu[0] / 2 * (f[i] * q + (i == j ? fa : 0) - 2 * p * f[j]) +
                               w->f.nu[1] * p * (q * fa - square * f[j]);
        }
}

/* In v, w and delta; the blocks of w stand where those of s will. */
static void form_of_middle(const screw *w, const work *k, const double f[3], form *out)
{
    double bent[9], mixed[9], Dx[9], VM[9], VMD[9], VB[9], moment[9];
    const screw_factors *c = &w->f;
    second_of_translation(w, f, bent, mixed);
    skew(w->D, Dx);
    skew(k->p, moment);
    mat3_mul(w->V, mixed, VM);
    mat3_mul(VM, Dx, VMD);
    mat3_mul(w->V, bent, VB);
    mat3_mul(VB, w->V, out->dd);
    double gx[9], side[3];
    skew(k->g, gx);
    vec3_cross(k->m, w->a, side);
    const double gD = vec3_dot(k->g, w->D), ma = vec3_dot(k->m, w->a), ta = vec3_dot(k->t, w->a);
    const double c1 = (c->tau[1] + c->tau[0] * c->nu[0] / 2) / 4,
                 c2 = (c->mu[1] + c->nu[0] * c->mu[0] / 2) / 2;
    const double c3 = ta * (c->nu[1] + c->nu[0] * c->nu[0]), c4 = ta * c->nu[0] * c->mu[0] / 2;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j, mirrored = 3 * j + i, same = i == j;
            const double *a = w->a;
            out->vs[at] = gx[mirrored];
            out->vd[at] = VM[mirrored];
            out->ss[at] = (k->g[i] * w->D[j] + w->D[i] * k->g[j]) / 2 - (same ? gD : 0);
            out->sd[at] = VMD[mirrored] +
                          (c->tau[0] / 2 * ((same ? ma : 0) - k->m[i] * a[j]) + moment[at]) / 2;
            out->dd[at] += c1 * (a[i] * side[j] + side[i] * a[j]) +
                           c2 * (a[i] * k->t[j] + k->t[i] * a[j]) + c3 * a[i] * a[j] +
                           (same ? c4 : 0);
        }
}

/* w = s + C delta, C = -tau/2 a~. */
static void form_of_nodes(const screw *w, form *k)
{
    double C[9], vsC[9], ssC[9], CsC[9], Csd[9];
    skew(w->a, C);
    for (int i = 0; i < 9; i++)
        C[i] *= -w->f.tau[0] / 2;
    mat3_mul(k->vs, C, vsC);
    mat3_mul(k->ss, C, ssC);
    mat3_transpose_mul(C, ssC, CsC);
    mat3_transpose_mul(C, k->sd, Csd);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j, mirrored = 3 * j + i;
            k->vd[at] += vsC[at];
            k->sd[at] += ssC[at];
            k->dd[at] += CsC[at] + Csd[at] + Csd[mirrored];
        }
}

/* R A R^T. */
static void turned(const double R[9], double A[9])
{
    double RA[9];
    mat3_mul(R, A, RA);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = vec3_dot(RA + 3 * i, R + 3 * j);
}

static void nodal_form(const screw *w, form *k, double H[COORDINATES * COORDINATES])
{
    double *const blocks[] = {k->vs, k->vd, k->ss, k->sd, k->dd};
    for (int b = 0; b < 5; b++)
        turned(w->R, blocks[b]);
    memset(H, 0, COORDINATES * COORDINATES * sizeof *H);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j, mirrored = 3 * j + i, n = COORDINATES;
            const double even = k->ss[at] / 4 + k->dd[at], odd = (k->sd[at] + k->sd[mirrored]) / 2;
            const double across = k->ss[at] / 4 - k->dd[at] + (k->sd[at] - k->sd[mirrored]) / 2;
            const double toward_p = k->vs[at] / 2 - k->vd[at], toward_q = k->vs[at] / 2 + k->vd[at];
            H[(TP + i) * n + TP + j] = even - odd;
            H[(TQ + i) * n + TQ + j] = even + odd;
            H[(TP + i) * n + TQ + j] = H[(TQ + j) * n + TP + i] = across;
            H[(RQ + i) * n + TP + j] = H[(TP + j) * n + RQ + i] = toward_p;
            H[(RQ + i) * n + TQ + j] = H[(TQ + j) * n + RQ + i] = toward_q;
            H[(RP + i) * n + TP + j] = H[(TP + j) * n + RP + i] = -toward_p;
            H[(RP + i) * n + TQ + j] = H[(TQ + j) * n + RP + i] = -toward_q;
        }
}

/* e from U less l0, from l0 psi and l0^2 a: rows of n. */
static void arrange(int n, const double U[], const double kappa[], double e[])
{
    for (int k = 0; k < n; k++) {
        const double half[2] = {kappa[n + k] / 2, kappa[2 * n + k] / 2};
        e[k] = U[k];
        e[1 * n + k] = kappa[k];
        e[2 * n + k] = half[0] - U[2 * n + k];
        e[3 * n + k] = half[0] + U[2 * n + k];
        e[4 * n + k] = half[1] + U[1 * n + k];
        e[5 * n + k] = half[1] - U[1 * n + k];
    }
}

void beamw_helicoidal_strain(const element_data *d, const node_state x[], strain_output *out)
{
    const double l0 = d->l0;
    const screw w = beamw_screw(l0, x);
    if (out->e != NULL) {
        const double kappa[3] = {2 * l0 * w.a[0], 2 * l0 * w.a[1], 2 * l0 * w.a[2]};
        arrange(1, w.U, kappa, out->e);
        out->e[6] = l0 * l0 * x[0].a;
        out->e[7] = l0 * l0 * x[1].a;
    }
    if (out->J != NULL) {
        double U[3 * COORDINATES], kappa[3 * COORDINATES];
        for (int i = 0; i < 3; i++) {
            const double none[3] = {0}, f[3] = {i == 0, i == 1, i == 2},
                         t[3] = {l0 * f[0], l0 * f[1], l0 * f[2]};
            const work translating = work_of(&w, f, none), turning = work_of(&w, none, t);
            nodal_row(&w, &translating, U + COORDINATES * i);
            nodal_row(&w, &turning, kappa + COORDINATES * i);
        }
        memset(out->J, 0, STRAINS * COORDINATES * sizeof *out->J);
        arrange(COORDINATES, U, kappa, out->J);
        out->J[6 * COORDINATES + AP] = out->J[7 * COORDINATES + AQ] = l0 * l0;
    }
    if (out->s != NULL && out->H != NULL) {
        const double *s = out->s, f[3] = {s[0], s[4] - s[5], s[3] - s[2]};
        const double t[3] = {l0 * s[1], l0 / 2 * (s[2] + s[3]), l0 / 2 * (s[4] + s[5])};
        const work k = work_of(&w, f, t);
        form second;
        form_of_middle(&w, &k, f, &second);
        form_of_nodes(&w, &second);
        nodal_form(&w, &second, out->H);
    }
}
