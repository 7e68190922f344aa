#ifndef BEAMWORK_BEAMW_EQUILIBRIUM_H
#define BEAMWORK_BEAMW_EQUILIBRIUM_H

#include <float.h>
#include <string.h>

#include "elements/beamw/variants.h"
#include "elements/math/dense.h"
#include "elements/shared/lanes.h"

/* Internal modes (variants.h) and the functions (u, h) of y = (e, z), for one element or several in
 * lanes. D contains the quadratic parts of the derivatives of (u, h). */

enum {
    BEAMW_INTERNAL_Y = BEAMW_MODIFIED_VARIABLES,
    BEAMW_INTERNAL_Z = BEAMW_STRAINS,   /* index of the first component of z */
    BEAMW_INTERNAL_U = 4,               /* number of components of u whose derivatives depend on
                                         * y */
    BEAMW_INTERNAL_H = BEAMW_INTERNAL_U /* row of h_y in D */
};

typedef struct beamw_internal {
    real y[BEAMW_INTERNAL_Y], q[3];
    real D[BEAMW_CONDENSED_ROWS * BEAMW_INTERNAL_Y +
           1]; /* rows of D, one after the other, where the last entry is not used */
    real u[BEAMW_CONDENSED_EVEN], h[3];
    real reach[3]; /* sum of the absolute values of the terms of h that are linear in e */
} beamw_internal;

static inline const real *beamw_internal_inside(const beamw_internal *s, int r)
{
    return s->D + BEAMW_INTERNAL_Y * r + BEAMW_INTERNAL_Z;
}

/* Adds the product of the columns of D that belong to z with dz to out[rows]. */
static inline void beamw_internal_along(const beamw_internal *s, const real dz[3],
                                        real out[BEAMW_CONDENSED_ROWS])
{
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++) {
        const real *D = beamw_internal_inside(s, r);
        out[r] += D[0] * dz[0] + D[1] * dz[1] + D[2] * dz[2];
    }
}

/* Adds half of the quadratic parts to u and h. */
static inline void beamw_internal_add_half(const beamw_condensed *d,
                                           const real quadratic[BEAMW_CONDENSED_ROWS],
                                           beamw_internal *s)
{
    enum { U = BEAMW_INTERNAL_U };
    for (int r = 0; r < U; r++)
        s->u[r] += quadratic[r] / 2;
    for (int i = 0; i < 2; i++)
        s->h[i] += quadratic[U + i] / 2;
    s->h[2] += d->share * (quadratic[1] / 2);
}

/* Adds to D the derivatives of the terms that are quadratic in z. */
static inline void beamw_internal_add_own(const beamw_condensed *d, const real z[BEAMW_INTERNAL_Y],
                                          beamw_internal *s)
{
    for (int t = d->own; t < d->terms; t++) {
        const beamw_quadratic_term *of = &d->term[t];
        s->D[of->to] += of->c * z[of->j];
        s->D[of->mirrored] += of->c * z[of->i];
    }
}

static inline void beamw_internal_linear(const beamw_condensed *d, beamw_internal *s)
{
    for (int r = 0; r < BEAMW_CONDENSED_EVEN; r++)
        s->u[r] = real_of(0);
    for (int i = 0; i < 3; i++)
        s->h[i] = s->reach[i] = real_of(0);
    for (int t = 0; t < d->linears; t++) {
        const int row = d->linear[t].row;
        const real part = d->linear[t].c * s->y[d->linear[t].i];
        if (row < BEAMW_CONDENSED_EVEN) {
            s->u[row] += part;
        } else {
            s->h[row - BEAMW_CONDENSED_EVEN] += part;
            s->reach[row - BEAMW_CONDENSED_EVEN] += real_abs(part);
        }
    }
}

static inline void beamw_internal_evaluate(const beamw_condensed *d, beamw_internal *s)
{
    enum { Y = BEAMW_INTERNAL_Y, Z = BEAMW_INTERNAL_Z };
    real quadratic[BEAMW_CONDENSED_ROWS];
    beamw_internal_linear(d, s);
    for (int i = 0; i < BEAMW_CONDENSED_ROWS * Y; i++)
        s->D[i] = real_of(0);
    for (int t = 0; t < d->mixed; t++) {
        const beamw_quadratic_term *of = &d->term[t];
        s->D[of->to] += of->c * s->y[of->j];
        s->D[of->mirrored] += of->c * s->y[of->i];
    }
    for (int t = d->mixed; t < d->own; t++)
        s->D[d->term[t].mirrored] += d->term[t].c * s->y[d->term[t].i];
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++) {
        quadratic[r] = s->D[Y * r] * s->y[0];
        for (int i = 1; i < Z; i++)
            quadratic[r] += s->D[Y * r + i] * s->y[i];
    }
    beamw_internal_along(s, s->y + Z, quadratic); /* products of e and z, then of z with itself */
    beamw_internal_add_own(d, s->y, s);
    beamw_internal_along(s, s->y + Z, quadratic);
    beamw_internal_add_half(d, quadratic, s);
}

static inline void beamw_internal_move(const beamw_condensed *d, const real dz[3],
                                       beamw_internal *s)
{
    enum { Z = BEAMW_INTERNAL_Z };
    real quadratic[BEAMW_CONDENSED_ROWS], step[BEAMW_INTERNAL_Y];
    for (int i = 0; i < 3; i++) {
        step[Z + i] = dz[i];
        s->y[Z + i] += dz[i];
    }
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++)
        quadratic[r] = real_of(0);
    beamw_internal_along(s, dz, quadratic);
    beamw_internal_add_own(d, step, s);
    beamw_internal_along(s, dz, quadratic);
    beamw_internal_add_half(d, quadratic, s);
}

/* Adds the effect of z to the columns of D that belong to e, after z has been computed. */
static inline void beamw_internal_finish(const beamw_condensed *d, beamw_internal *s)
{
    for (int t = d->mixed; t < d->own; t++)
        s->D[d->term[t].to] += d->term[t].c * s->y[d->term[t].j];
}

/* Computes the weights conjugate to the rows of D. */
static inline void beamw_internal_weights(const beamw_condensed *d, const beamw_internal *s,
                                          real w[BEAMW_CONDENSED_ROWS])
{
    for (int r = 0; r < BEAMW_INTERNAL_U; r++)
        w[r] = d->k[r] * s->u[r];
    w[1] += d->share * s->q[2];
    w[BEAMW_INTERNAL_H] = s->q[0];
    w[BEAMW_INTERNAL_H + 1] = s->q[1];
}

/* The Hessian of (z, q), [Kzz, G^T; G, -f] (variants.h). G = dh/dz - 1 is close to -1 in every
 * state, while Kzz may have any sign. Therefore G is eliminated first: dz = H (q + f dq), X dq = z
 * - Kzz H q. */

/* The Hessian. After factorisation, H = G^-1, H f and X^-1 with X = G^T + Kzz H f. */
typedef struct beamw_hessian {
    real Kzz[9], G[9], H[9], Hf[9], inverse[9];
    real_truth regular;
} beamw_hessian;

/* Computes dh/dz - 1 and Kzz. */
static inline void beamw_hessian_evaluate(const beamw_condensed *d, const beamw_internal *s,
                                          const real w[BEAMW_CONDENSED_ROWS], beamw_hessian *k)
{
    const real *D[BEAMW_CONDENSED_ROWS];
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++)
        D[r] = beamw_internal_inside(s, r);
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            real sum = real_of(i == j ? d->Ka[i] : 0);
            for (int r = 0; r < BEAMW_INTERNAL_U; r++)
                sum += d->k[r] * D[r][i] * D[r][j];
            k->Kzz[3 * i + j] = sum;
        }
    for (int t = d->own; t < d->terms; t++)
        k->Kzz[d->term[t].entry] += d->term[t].c * w[d->term[t].row];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++)
            k->Kzz[3 * i + j] = k->Kzz[3 * j + i];
    for (int j = 0; j < 3; j++) {
        k->G[j] = D[BEAMW_INTERNAL_H][j] - (j == 0);
        k->G[3 + j] = D[BEAMW_INTERNAL_H + 1][j] - (j == 1);
        k->G[6 + j] = d->share * D[1][j] - (j == 2);
    }
}

/* Computes A^-1 by cofactors, whose accuracy does not depend on the units of rows and columns.
 * Returns the lanes in which the determinant of A is below -1/10. G and X are -I if there is no
 * stress or no flexibility. */
static inline real_truth beamw_hessian_invert(const real A[9], real inverse[9])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (int c = 0; c < 3; c++) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            inverse[3 * c + i] = A[3 * j + d] * A[3 * k + e] - A[3 * j + e] * A[3 * k + d];
        }
    }
    const real determinant = A[0] * inverse[0] + A[1] * inverse[3] + A[2] * inverse[6],
               factor = 1 / determinant;
    for (int i = 0; i < 9; i++)
        inverse[i] *= factor;
    return determinant < -0.1;
}

static inline void beamw_hessian_factorise(const beamw_condensed *d, beamw_hessian *k)
{
    real X[9];
    k->regular = beamw_hessian_invert(k->G, k->H);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k->Hf[3 * i + j] = k->H[3 * i] * d->f[j] + k->H[3 * i + 1] * d->f[3 + j] +
                               k->H[3 * i + 2] * d->f[6 + j];
    mat3_mul(k->Kzz, k->Hf, X);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            X[3 * i + j] += k->G[3 * j + i];
    k->regular &= beamw_hessian_invert(X, k->inverse);
}

/* Computes (dz, dq) = Hessian^-1 (z, q). */
static inline void beamw_hessian_solve(const beamw_hessian *k, const real z[3], const real q[3],
                                       real dz[3], real dq[3])
{
    real Hq[3], KHq[3], more[3];
    mat3_mul_vec(k->H, q, Hq);
    mat3_mul_vec(k->Kzz, Hq, KHq);
    for (int i = 0; i < 3; i++)
        KHq[i] = z[i] - KHq[i];
    mat3_mul_vec(k->inverse, KHq, dq);
    mat3_mul_vec(k->Hf, dq, more);
    for (int i = 0; i < 3; i++)
        dz[i] = Hq[i] + more[i];
}

/* Solves with the Hessian of one lane, with pivoting, for the columns of right[6 x columns] in
 * place. Returns 0, or 1 if the Hessian is singular. */
static inline int beamw_hessian_pivoted(const beamw_condensed *d, const beamw_hessian *k, int lane,
                                        int columns, double right[])
{
    enum { INNER = 6 };
    double K[INNER * INNER];
    int pivot[INNER];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            K[INNER * i + j] = real_lane(&k->Kzz[3 * i + j], lane);
            K[INNER * (3 + i) + j] = K[INNER * j + 3 + i] = real_lane(&k->G[3 * i + j], lane);
            K[INNER * (3 + i) + 3 + j] = -d->f[3 * i + j];
        }
    if (dense_lu(INNER, K, pivot) != 0)
        return 1;
    dense_lu_solve(INNER, columns, K, pivot, right);
    return 0;
}

enum { BEAMW_EQUILIBRIUM_MOST = 30 };

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

/* Solves for z and q by Newton's method. Returns the lanes that have converged. */
static inline real_truth beamw_equilibrium_solve(const beamw_condensed *d, beamw_internal *s)
{
    enum { Z = BEAMW_INTERNAL_Z };
    const double close_enough = 1e-7;
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
        good &= change <= DBL_MAX; /* true for converged lanes, whose z does not change */
        left &= good & (change > close_enough * close_enough * size);
    }
    return good & (left == 0);
}

/* B = du/de, C_ee, and the mixed second derivatives with respect to (z, e) and to (q, e). */
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

/* Computes C for one lane and factors its Hessian with pivoting. Returns 1, or 0 if the Hessian is
 * singular. */
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

/* Computes C = C_ee - (z, q)^T Hessian^-1 (z, q), where z and q stand for the mixed second
 * derivatives. Returns the lanes in which the Hessian is regular. */
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

/* Computes the outputs of element_type.stress. Returns the lanes in which an equilibrium was found
 * and, if C is requested, the Hessian is regular. */
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
    real_truth good = beamw_equilibrium_solve(d, &s);
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
