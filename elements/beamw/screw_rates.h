/* First derivatives of a screw with respect to the nodes' coordinates.  Along a path of constant
 * spatial velocities and spins, in the axes of the middle: v of q against p, s the mean of the
 * nodes' spins and delta their difference.  The middle turns with w = s - tau/2 a x delta and
 * dpsi/dt = V^-1 delta,  dD/dt = v - w x D,  d(v, s, delta)/dt = -w x (v, s, delta). */
#ifndef BEAMWORK_BEAMW_SCREW_RATES_H
#define BEAMWORK_BEAMW_SCREW_RATES_H

#include <string.h>

#include "elements/beamw/screw.h"

enum { SCREW_COORDINATES = 2 * NODE_COORDINATES };
enum { SCREW_RP = 0, SCREW_TP = 3, SCREW_AP = 6, SCREW_RQ = 7, SCREW_TQ = 10, SCREW_AQ = 13 };

/* Work conjugates of the rates: f . dU/dt + t . dpsi/dt = g . v + mean . s + difference . delta. */
typedef struct screw_work {
    real g[3], t[3], m[3]; /* dual to D, to psi; m = D x g = -mean */
    real p[3];             /* V^-1 t */
    real difference[3];
} screw_work;

/* The rest of it from g and t. */
static inline void beamw_screw_rates_complete(const screw *w, screw_work *k)
{
    real side[3];
    vec3_cross(w->D, k->g, k->m);
    mat3_mul_vec(w->V, k->t, k->p);
    vec3_cross(k->m, w->a, side);
    for (int i = 0; i < 3; i++)
        k->difference[i] = k->p[i] + w->f[SCREW_TAU] / 2 * side[i];
}

/* Work of forces f and moments. */
static inline void beamw_screw_rates_work(const screw *w, const real f[3], const real moment[3],
                                          screw_work *k)
{
    mat3_mul_vec(w->V, f, k->g); /* symmetric */
    mat3_transpose_mul_vec(w->T, f, k->t);
    for (int i = 0; i < 3; i++)
        k->t[i] += moment[i];
    beamw_screw_rates_complete(w, k);
}

/* Gradients in fixed axes: of U with respect to v, s and delta, by columns; that of psi with
 * respect to delta is that of U with respect to v. */
typedef struct screw_gradient {
    real v[9], s[9], delta[9];
} screw_gradient;

static inline void beamw_screw_rates_gradient(const screw *w, screw_gradient *out)
{
    real mean[9], difference[9];
    for (int i = 0; i < 3; i++) {
        screw_work k; /* of a unit force */
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

/* A row: sign of the gradient of U_translation and `part` of l0 times that of psi_rotation. */
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

#endif
