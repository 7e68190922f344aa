/* A stress function of condensed internal modes, which follow the stress: bending, shear and
 * warping share the antisymmetric deformation h as equilibrium of the stressed element asks,
 * instead of as in the unstressed one.  With z the bending and warping part of h, energy =
 * stationary over z and q of  1/2 sum_r k_r u_r^2 + 1/2 z^T Ka z + q . (h - z) - 1/2 q^T F q/(G l),
 * where u = (e1, e2, e3 + e4, e5 + e6, (e7 - e8)/2) and h are those of ebar = e + 1/2 (e, z)^T Q
 * (e, z) (modified.h).  q is dual to h: F = 0 does no harm. */
#ifndef BEAMWORK_BEAMW_CONDENSED_H
#define BEAMWORK_BEAMW_CONDENSED_H

#include "elements/beamw/modified.h"
#include "elements/beamw/quadratic.h"

enum {
    BEAMW_CONDENSED_EVEN = 5,
    BEAMW_CONDENSED_ALL = BEAMW_CONDENSED_EVEN + 3,
    BEAMW_CONDENSED_ROWS = 6, /* u1 .. u4, h_y, h_z: u5 is linear, h_w follows u2 */
    BEAMW_CONDENSED_TERMS =
        BEAMW_CONDENSED_ROWS * BEAMW_MODIFIED_VARIABLES * (BEAMW_MODIFIED_VARIABLES + 1) / 2
};

/* c e_i of a row of (u, h). */
typedef struct beamw_condensed_linear {
    double c;
    short row, i;
} beamw_condensed_linear;

typedef struct beamw_condensed {
    double k[BEAMW_CONDENSED_EVEN];            /* [N/m] */
    double Ka[3];                              /* [N m, N m, N m^3] */
    double f[3 * 3];                           /* F/(G l) */
    double hg[3 * BEAMW_STRAINS];              /* z = hg e without stress */
    double share;                              /* of the quadratic part of u2 in h_w [1/m^2] */
    double odd[BEAMW_STRAINS * BEAMW_STRAINS]; /* d2/de2 of 1/2 k5 u5^2 [N/m] */
    int linears;                               /* (u, h), rows as in k and behind them, of e */
    beamw_condensed_linear linear[BEAMW_CONDENSED_ALL * BEAMW_STRAINS];
    int mixed, own, terms; /* of e alone, for an entry of [8 x 8]; of e_i, z_j from `mixed`, of (j,
                              i) in [3 x 8]; of z alone from `own`, of [3 x 3] */
    beamw_quadratic_term term[BEAMW_CONDENSED_TERMS];
} beamw_condensed;

/* Q as of beamw_modified_consistent; warping 0: e7 = e8 = e2, nothing warps. */
void beamw_condensed_prepare(
    const section *c, double l0, int shear, int warping, const beamw_twist *t,
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES],
    beamw_condensed *out);

/* As element_type.stress; NOT_CONVERGED where the internal modes have no equilibrium. */
status beamw_condensed_stress(const beamw_condensed *d, const double e[BEAMW_STRAINS],
                              stress_output *out);

#endif
