/* The stress function of condensed internal modes (condensed.h), of one element or of several in
 * lanes. */
#ifndef BEAMWORK_BEAMW_EQUILIBRIUM_H
#define BEAMWORK_BEAMW_EQUILIBRIUM_H

#include <float.h>
#include <string.h>

#include "elements/beamw/hessian.h"

enum { BEAMW_EQUILIBRIUM_MOST = 30 }; /* iterations */

/* A step of Newton's method, dz and dq: what is to be subtracted; not a number where there is none.
 */
static inline void beamw_equilibrium_step(const beamw_condensed *d, const beamw_internal *s,
                                          real dz[3], real dq[3])
{
    enum { Z = BEAMW_INTERNAL_Z };
    beamw_hessian k;
    real w[BEAMW_CONDENSED_ROWS], right[6];
    beamw_internal_weights(d, s, w);
    beamw_hessian_evaluate(d, s, w, &k);
    for (int i = 0; i < 3; i++) {
        real force = d->Ka[i] * s->y[Z + i] - s->q[i], gap = s->h[i] - s->y[Z + i];
        for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++)
            force += w[r] * beamw_internal_inside(s, r)[i];
        for (int j = 0; j < 3; j++)
            gap -= d->f[3 * i + j] * s->q[j];
        right[i] = force;
        right[3 + i] = gap;
    }
    beamw_hessian_factorise(d, &k);
    beamw_hessian_solve(&k, right, right + 3, dz, dq);
    for (int lane = 0; lane < LANES; lane++) {
        double one[6];
        if (real_holds(k.regular, lane))
            continue;
        for (int i = 0; i < 6; i++)
            one[i] = real_lane(&right[i], lane);
        const int failed = beamw_hessian_pivoted(d, &k, lane, 1, one);
        for (int i = 0; i < 3; i++) {
            real_put(&dz[i], lane, failed ? NAN : one[i]);
            real_put(&dq[i], lane, failed ? NAN : one[3 + i]);
        }
    }
}

/* Newton's method for z and q. Returns where it converged; what has converged stays. */
static inline real_truth beamw_equilibrium_settle(const beamw_condensed *d, beamw_internal *s)
{
    enum { Z = BEAMW_INTERNAL_Z };
    const double close_enough =
        1e-7; /* relative to z: the remainder is of the order of its square */
    real_truth left = real_true(), good = real_true();
    for (int count = 0; count < BEAMW_EQUILIBRIUM_MOST && real_any(left); count++) {
        real change = real_of(0), size = real_of(0), dz[3], dq[3];
        beamw_equilibrium_step(d, s, dz, dq);
        for (int i = 0; i < 3; i++) {
            const real reach = s->reach[i] + real_abs(s->y[Z + i]);
            change += d->Ka[i] * dz[i] * dz[i];
            size += d->Ka[i] * reach * reach;
            dz[i] = real_choose(left, -dz[i], real_of(0));
            s->q[i] -= real_choose(left, dq[i], real_of(0));
        }
        beamw_internal_move(d, dz, s);
        good &= change <= DBL_MAX; /* of what has converged too: it is evaluated as before */
        left &= good & (change > close_enough * close_enough * size);
    }
    return good & (left == 0);
}

/* C_ee, half of it, and the mixed second derivatives of z and e, of q and e. */
typedef struct beamw_equilibrium_outside {
    real B[BEAMW_INTERNAL_U][BEAMW_STRAINS], C[BEAMW_STRAINS * BEAMW_STRAINS];
    real z[3 * BEAMW_STRAINS], q[3 * BEAMW_STRAINS];
} beamw_equilibrium_outside;

static inline void beamw_equilibrium_rows(const beamw_condensed *d, const beamw_internal *s,
                                          const real w[BEAMW_CONDENSED_ROWS],
                                          beamw_equilibrium_outside *o)
{
    enum { E = BEAMW_STRAINS, Y = BEAMW_INTERNAL_Y, U = BEAMW_INTERNAL_U };
    for (int j = 0; j < E; j++) {
        for (int r = 0; r < U; r++)
            o->B[r][j] = s->D[Y * r + j];
        o->q[j] = s->D[Y * BEAMW_INTERNAL_H + j];
        o->q[E + j] = s->D[Y * (BEAMW_INTERNAL_H + 1) + j];
        o->q[2 * E + j] = d->share * s->D[Y + j];
    }
    for (int t = 0; t < d->linears; t++) {
        const int row = d->linear[t].row, i = d->linear[t].i;
        if (row < U)
            o->B[row][i] += d->linear[t].c;
        if (row >= BEAMW_CONDENSED_EVEN)
            o->q[E * (row - BEAMW_CONDENSED_EVEN) + i] += d->linear[t].c;
    }
    for (int i = 0; i < E; i++) {
        real kB[U];
        for (int r = 0; r < U; r++)
            kB[r] = d->k[r] * o->B[r][i];
        for (int j = i; j < E; j++) {
            real sum = real_of(d->odd[E * i + j]);
            for (int r = 0; r < U; r++)
                sum += kB[r] * o->B[r][j];
            o->C[E * i + j] = sum;
        }
        for (int j = 0; j < 3; j++) {
            real sum = kB[0] * beamw_internal_inside(s, 0)[j];
            for (int r = 1; r < U; r++)
                sum += kB[r] * beamw_internal_inside(s, r)[j];
            o->z[E * j + i] = sum;
        }
    }
    for (int t = 0; t < d->mixed; t++)
        o->C[d->term[t].entry] += d->term[t].c * w[d->term[t].row];
    for (int t = d->mixed; t < d->own; t++)
        o->z[d->term[t].entry] += d->term[t].c * w[d->term[t].row];
}

/* C of one lane whose Hessian is factorised with pivots. Returns 1; 0: it is singular. */
static inline int beamw_equilibrium_condense_pivoted(const beamw_condensed *d,
                                                     const beamw_internal *s,
                                                     const beamw_hessian *k, int lane, real C[])
{
    enum { E = BEAMW_STRAINS, INNER = 6 };
    beamw_equilibrium_outside o;
    real w[BEAMW_CONDENSED_ROWS];
    beamw_internal_weights(d, s, w);
    beamw_equilibrium_rows(d, s, w, &o);
    double mixed[INNER * E], solved[INNER * E];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < E; j++) {
            mixed[E * i + j] = real_lane(&o.z[E * i + j], lane);
            mixed[E * (3 + i) + j] = real_lane(&o.q[E * i + j], lane);
        }
    memcpy(solved, mixed, sizeof solved);
    if (beamw_hessian_pivoted(d, k, lane, E, solved) != 0)
        return 0;
    for (int i = 0; i < E; i++)
        for (int j = i; j < E; j++) {
            double sum = real_lane(&o.C[E * i + j], lane);
            for (int r = 0; r < INNER; r++)
                sum -= mixed[E * r + i] * solved[E * r + j];
            real_put(&C[E * i + j], lane, sum);
            real_put(&C[E * j + i], lane, sum);
        }
    return 1;
}

/* C = C_ee - (z, q)^T Hessian^-1 (z, q). Returns where the Hessian is regular. */
static inline real_truth beamw_equilibrium_condense(const beamw_condensed *d,
                                                    const beamw_internal *s, real C[])
{
    enum { E = BEAMW_STRAINS };
    beamw_hessian k;
    beamw_equilibrium_outside o;
    real w[BEAMW_CONDENSED_ROWS];
    real_truth good = real_true();
    beamw_internal_weights(d, s, w);
    beamw_hessian_evaluate(d, s, w, &k);
    beamw_hessian_factorise(d, &k);
    beamw_equilibrium_rows(d, s, w, &o);
    for (int j = 0; j < E; j++) {
        const real z[3] = {o.z[j], o.z[E + j], o.z[2 * E + j]},
                   q[3] = {o.q[j], o.q[E + j], o.q[2 * E + j]};
        real dz[3], dq[3];
        beamw_hessian_solve(&k, z, q, dz, dq);
        for (int i = 0; i <= j; i++) {
            real sum = o.C[E * i + j];
            for (int r = 0; r < 3; r++)
                sum -= o.z[E * r + i] * dz[r] + o.q[E * r + i] * dq[r];
            C[E * i + j] = C[E * j + i] = sum;
        }
    }
    for (int lane = 0; lane < LANES; lane++)
        if (!real_holds(k.regular, lane) && !beamw_equilibrium_condense_pivoted(d, s, &k, lane, C))
            real_deny(&good, lane);
    return good;
}

static inline real beamw_equilibrium_energy(const beamw_condensed *d, const beamw_internal *s)
{
    enum { Z = BEAMW_INTERNAL_Z };
    real sum = real_of(0);
    for (int r = 0; r < BEAMW_CONDENSED_EVEN; r++)
        sum += d->k[r] * s->u[r] * s->u[r] / 2;
    for (int i = 0; i < 3; i++) {
        sum += d->Ka[i] * s->y[Z + i] * s->y[Z + i] / 2 + s->q[i] * (s->h[i] - s->y[Z + i]);
        for (int j = 0; j < 3; j++)
            sum -= s->q[i] * d->f[3 * i + j] * s->q[j] / 2;
    }
    return sum;
}

/* sigma = d energy/de. */
static inline void beamw_equilibrium_forces(const beamw_condensed *d, const beamw_internal *s,
                                            real sigma[BEAMW_STRAINS])
{
    real w[BEAMW_CONDENSED_ROWS], dual[BEAMW_CONDENSED_ALL];
    beamw_internal_weights(d, s, w);
    for (int r = 0; r < BEAMW_CONDENSED_EVEN; r++)
        dual[r] = d->k[r] * s->u[r];
    for (int i = 0; i < 3; i++)
        dual[BEAMW_CONDENSED_EVEN + i] = s->q[i];
    for (int i = 0; i < BEAMW_STRAINS; i++) {
        real sum = w[0] * s->D[i];
        for (int r = 1; r < BEAMW_CONDENSED_ROWS; r++)
            sum += w[r] * s->D[BEAMW_INTERNAL_Y * r + i];
        sigma[i] = sum;
    }
    for (int t = 0; t < d->linears; t++)
        sigma[d->linear[t].i] += d->linear[t].c * dual[d->linear[t].row];
}

/* As element_type.stress; returns where there is an equilibrium. */
static inline real_truth beamw_equilibrium_stress(const beamw_condensed *d,
                                                  const real e[BEAMW_STRAINS], stress_real *out)
{
    enum { E = BEAMW_STRAINS };
    beamw_internal s;
    memcpy(s.y, e, E * sizeof *e);
    for (int i = 0; i < 3; i++) {
        s.y[E + i] = d->hg[E * i] * e[0];
        for (int k = 1; k < E; k++)
            s.y[E + i] += d->hg[E * i + k] * e[k];
        s.q[i] = d->Ka[i] * s.y[E + i];
    }
    beamw_internal_evaluate(d, &s);
    real_truth good = beamw_equilibrium_settle(d, &s);
    if (!real_any(good))
        return good;
    beamw_internal_finish(d, &s);
    if (out->energy != NULL)
        *out->energy = beamw_equilibrium_energy(d, &s);
    if (out->sigma != NULL)
        beamw_equilibrium_forces(d, &s, out->sigma);
    if (out->residual != NULL)
        *out->residual = real_of(0);
    if (out->C != NULL)
        good &= beamw_equilibrium_condense(d, &s, out->C);
    return good;
}

#endif
