/* Deformation modes of the two-node beam: eight generalized strains [m] computed from the positions
 * and triads of the nodes (J Eq. 7). e1 is the elongation, e2 torsion, e3 and e4 bending in x-z, e5
 * and e6 bending in x-y, and e7 and e8 are l0^2 a. The header also provides their gradient (J Eq.
 * 13, three rows of which are misprinted) and their second derivatives in the exponential chart. n
 * is the unit vector from p to q. Every bending mode is l0 times n . v, where v is a vector fixed
 * to a node. */
#ifndef BEAMWORK_BEAMW_MODES_H
#define BEAMWORK_BEAMW_MODES_H

#include "elements/element.h"
#include "elements/math/vec3.h"
#include "elements/shared/lanes.h"

enum { MODES_COORDINATES = 2 * NODE_COORDINATES };
enum { MODES_RP = 0, MODES_TP = 3, MODES_AP = 6, MODES_RQ = 7, MODES_TQ = 10, MODES_AQ = 13 };

typedef struct beamw_modes {
    real n[3], l; /* direction and length of the chord */
    real e1;      /* l - l0 */
    real yp[3], zp[3], yq[3], zq[3];
} beamw_modes;

static inline void beamw_modes_of(double l0, const node_real x[2], beamw_modes *m)
{
    real d[3], moved[3];
    for (int i = 0; i < 3; i++) {
        moved[i] = x[1].u[i] - x[0].u[i];
        d[i] = x[1].r[i] - x[0].r[i];
        m->yp[i] = x[0].R[3 * i + 1];
        m->zp[i] = x[0].R[3 * i + 2];
        m->yq[i] = x[1].R[3 * i + 1];
        m->zq[i] = x[1].R[3 * i + 2];
    }
    m->l = real_sqrt(vec3_dot(d, d));
    m->e1 = vec3_elongation(d, moved, l0);
    for (int i = 0; i < 3; i++)
        m->n[i] = d[i] / m->l;
}

/* Computes the gradient of c n . v, where v is fixed to the node whose rotation columns begin at
 * `rotation`. */
static inline void beamw_modes_bending_row(const beamw_modes *m, double c, const real v[3],
                                           int rotation, real row[MODES_COORDINATES])
{
    real moment[3];
    const real along = vec3_dot(m->n, v), factor = c / m->l;
    vec3_cross(v, m->n, moment);
    for (int i = 0; i < 3; i++) {
        const real across = v[i] - along * m->n[i];
        row[MODES_RQ + i] = factor * across;
        row[MODES_RP + i] = -row[MODES_RQ + i];
        row[rotation + i] = c * moment[i];
    }
}

static inline void beamw_modes_gradient(double l0, const beamw_modes *m,
                                        real J[8 * MODES_COORDINATES])
{
    enum { N = MODES_COORDINATES };
    real first[3], second[3];
    for (int i = 0; i < 8 * N; i++)
        J[i] = real_of(0);
    vec3_cross(m->zp, m->yq, first);
    vec3_cross(m->yp, m->zq, second);
    for (int i = 0; i < 3; i++) {
        J[MODES_RP + i] = -m->n[i];
        J[MODES_RQ + i] = m->n[i];
        J[N + MODES_TP + i] = l0 / 2 * (first[i] - second[i]);
        J[N + MODES_TQ + i] = -J[N + MODES_TP + i];
    }
    beamw_modes_bending_row(m, -l0, m->zp, MODES_TP, J + 2 * N);
    beamw_modes_bending_row(m, l0, m->zq, MODES_TQ, J + 3 * N);
    beamw_modes_bending_row(m, l0, m->yp, MODES_TP, J + 4 * N);
    beamw_modes_bending_row(m, -l0, m->yq, MODES_TQ, J + 5 * N);
    J[6 * N + MODES_AP] = J[7 * N + MODES_AQ] = real_of(l0 * l0);
}

/* Adds c [sym(u v^T) - (u . v) I], the second derivative of c u . v with respect to the rotation of
 * one of the two vectors, to B. */
static inline void beamw_modes_turning(real c, const real u[3], const real v[3], real B[9])
{
    const real dot = c * vec3_dot(u, v), half = c / 2;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            B[3 * i + j] += half * (u[i] * v[j] + v[i] * u[j]);
        B[4 * i] -= dot;
    }
}

/* Adds c [(u . v) I - v u^T], the mixed second derivative of c u . v with respect to the rotations
 * of u and v, to B. */
static inline void beamw_modes_crossing(real c, const real u[3], const real v[3], real B[9])
{
    const real dot = c * vec3_dot(u, v);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            B[3 * i + j] -= c * v[i] * u[j];
        B[4 * i] += dot;
    }
}

/* Computes the second derivative of n . v with respect to the position of q and a rotation of v,
 * which is (v~ - n (n x v)^T)/l. */
static inline void beamw_modes_mixed(const beamw_modes *m, const real v[3], real rt[9])
{
    real across[3];
    vec3_cross(m->n, v, across);
    const real skew[9] = {real_of(0), -v[2], v[1], v[2],      real_of(0),
                          -v[0],      -v[1], v[0], real_of(0)};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            rt[3 * i + j] = (skew[3 * i + j] - m->n[i] * across[j]) / m->l;
}

/* Blocks of the second derivatives: with respect to the chord, with respect to the chord and a
 * rotation, and with respect to two rotations. */
typedef struct beamw_modes_blocks {
    real rr[9], rp[9], rq[9], pp[9], qq[9], pq[9];
} beamw_modes_blocks;

static inline void beamw_modes_second(double l0, const beamw_modes *m, const real s[8],
                                      beamw_modes_blocks *b)
{
    real vp[3], vq[3], v[3], same[9];
    for (int i = 0; i < 3; i++) {
        vp[i] = l0 * (s[4] * m->yp[i] - s[2] * m->zp[i]);
        vq[i] = l0 * (s[3] * m->zq[i] - s[5] * m->yq[i]);
        v[i] = vp[i] + vq[i];
    }
    const real dot = vec3_dot(m->n, v), square = m->l * m->l, e1 = s[0] / m->l;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const real nn = m->n[i] * m->n[j], same_one = real_of(i == j);
            b->rr[3 * i + j] =
                (-(m->n[i] * v[j] + v[i] * m->n[j]) - same_one * dot + 3 * dot * nn) / square +
                e1 * (same_one - nn);
        }
    beamw_modes_mixed(m, vp, b->rp);
    beamw_modes_mixed(m, vq, b->rq);
    const real c = l0 / 2 * s[1];
    for (int i = 0; i < 9; i++)
        b->pq[i] = same[i] = real_of(0);
    beamw_modes_turning(c, m->zp, m->yq, same);
    beamw_modes_turning(-c, m->yp, m->zq, same);
    beamw_modes_crossing(c, m->zp, m->yq, b->pq);
    beamw_modes_crossing(-c, m->yp, m->zq, b->pq);
    for (int i = 0; i < 9; i++)
        b->pp[i] = b->qq[i] = same[i];
    beamw_modes_turning(real_of(1), m->n, vp, b->pp);
    beamw_modes_turning(real_of(1), m->n, vq, b->qq);
}

static inline void beamw_modes_place(const beamw_modes_blocks *b,
                                     real H[MODES_COORDINATES * MODES_COORDINATES])
{
    enum { N = MODES_COORDINATES, RP = MODES_RP, TP = MODES_TP, RQ = MODES_RQ, TQ = MODES_TQ };
    for (int i = 0; i < N * N; i++)
        H[i] = real_of(0);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int at = 3 * i + j;
            H[(RP + i) * N + RP + j] = H[(RQ + i) * N + RQ + j] = b->rr[at];
            H[(RP + i) * N + RQ + j] = H[(RQ + i) * N + RP + j] = -b->rr[at];
            H[(RQ + i) * N + TP + j] = H[(TP + j) * N + RQ + i] = -b->rp[at];
            H[(RP + i) * N + TP + j] = H[(TP + j) * N + RP + i] = b->rp[at];
            H[(RQ + i) * N + TQ + j] = H[(TQ + j) * N + RQ + i] = -b->rq[at];
            H[(RP + i) * N + TQ + j] = H[(TQ + j) * N + RP + i] = b->rq[at];
            H[(TP + i) * N + TP + j] = b->pp[at];
            H[(TQ + i) * N + TQ + j] = b->qq[at];
            H[(TP + i) * N + TQ + j] = H[(TQ + j) * N + TP + i] = b->pq[at];
        }
}

/* Computes the outputs of element_type.strain. l0 is the initial length [m]. */
static inline void beamw_modes_evaluate(double l0, const node_real x[2], strain_real *out)
{
    beamw_modes m;
    beamw_modes_of(l0, x, &m);
    if (out->e != NULL) {
        out->e[0] = m.e1;
        out->e[1] = l0 / 2 * (vec3_dot(m.zp, m.yq) - vec3_dot(m.yp, m.zq));
        out->e[2] = -l0 * vec3_dot(m.n, m.zp);
        out->e[3] = l0 * vec3_dot(m.n, m.zq);
        out->e[4] = l0 * vec3_dot(m.n, m.yp);
        out->e[5] = -l0 * vec3_dot(m.n, m.yq);
        out->e[6] = l0 * l0 * x[0].a;
        out->e[7] = l0 * l0 * x[1].a;
    }
    if (out->J != NULL)
        beamw_modes_gradient(l0, &m, out->J);
    if (out->s != NULL && out->H != NULL) {
        beamw_modes_blocks b;
        beamw_modes_second(l0, &m, out->s, &b);
        beamw_modes_place(&b, out->H);
    }
}

/* Computes slope[8 x 14] = H x' of each mode at the rates x'[14]. H is the matrix of second
 * derivatives of the mode in the exponential chart. The slope is the time derivative of the
 * gradient J minus 1/2 w x J in the rotations of each node. Without accelerations, the second time
 * derivative of a mode is slope . x'. */
void beamw_modes_slopes(double l0, const node_state x[2], const double J[8 * 14],
                        const double rate[14], double slope[8 * 14]);

#endif
