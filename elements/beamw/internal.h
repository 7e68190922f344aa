/* Internal modes (condensed.h) and what they are a function of: (u, h) of y = (e, z), with D the
 * quadratic parts of its derivatives; of one element or of several in lanes. */
#ifndef BEAMWORK_BEAMW_INTERNAL_H
#define BEAMWORK_BEAMW_INTERNAL_H

#include "elements/beamw/condensed.h"
#include "elements/shared/lanes.h"

enum {
    BEAMW_INTERNAL_Y = BEAMW_MODIFIED_VARIABLES,
    BEAMW_INTERNAL_Z = BEAMW_STRAINS,   /* where z begins */
    BEAMW_INTERNAL_U = 4,               /* u whose derivatives change */
    BEAMW_INTERNAL_H = BEAMW_INTERNAL_U /* row of h_y in D */
};

typedef struct beamw_internal {
    real y[BEAMW_INTERNAL_Y], q[3];
    real D[BEAMW_CONDENSED_ROWS * BEAMW_INTERNAL_Y + 1]; /* by rows; the last one counts nowhere */
    real u[BEAMW_CONDENSED_EVEN], h[3];
    real reach[3]; /* sum of the absolute terms of h, linear in e */
} beamw_internal;

/* Row r of D at z. */
static inline const real *beamw_internal_inside(const beamw_internal *s, int r)
{
    return s->D + BEAMW_INTERNAL_Y * r + BEAMW_INTERNAL_Z;
}

/* D dz of the columns of z. */
static inline void beamw_internal_along(const beamw_internal *s, const real dz[3],
                                        real out[BEAMW_CONDENSED_ROWS])
{
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++) {
        const real *D = beamw_internal_inside(s, r);
        out[r] += D[0] * dz[0] + D[1] * dz[1] + D[2] * dz[2];
    }
}

/* Half of the quadratic parts into u and h. */
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

/* Terms of z alone, of what z has moved by. */
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

/* u, h and D of y; but for what z does to the columns of e. */
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
    beamw_internal_along(s, s->y + Z, quadratic); /* e meets z, and z meets e ... */
    beamw_internal_add_own(d, s->y, s);
    beamw_internal_along(s, s->y + Z, quadratic); /* ... and itself */
    beamw_internal_add_half(d, quadratic, s);
}

/* The same after z has moved by dz. */
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

/* Effect of z on the columns of e, once z is known. */
static inline void beamw_internal_finish(const beamw_condensed *d, beamw_internal *s)
{
    for (int t = d->mixed; t < d->own; t++)
        s->D[d->term[t].to] += d->term[t].c * s->y[d->term[t].j];
}

/* Quantities that the rows of D are dual to. */
static inline void beamw_internal_weights(const beamw_condensed *d, const beamw_internal *s,
                                          real w[BEAMW_CONDENSED_ROWS])
{
    for (int r = 0; r < BEAMW_INTERNAL_U; r++)
        w[r] = d->k[r] * s->u[r];
    w[1] += d->share * s->q[2];
    w[BEAMW_INTERNAL_H] = s->q[0];
    w[BEAMW_INTERNAL_H + 1] = s->q[1];
}

#endif
