/* A stress function of condensed internal modes, which follow the stress: bending, shear and
 * warping share the antisymmetric deformation h as equilibrium of the stressed element asks,
 * instead of as in the unstressed one.  With z the bending and warping part of h, energy =
 * stationary over z and q of  1/2 sum_r k_r u_r^2 + 1/2 z^T Ka z + q . (h - z) - 1/2 q^T F q/(G l),
 * where u = (e1, e2, e3 + e4, e5 + e6, (e7 - e8)/2) and h are those of ebar = e + 1/2 (e, z)^T Q
 * (e, z) (modified.h).  q is dual to h: F = 0 does no harm. */
#ifndef BEAMWORK_BEAMW_CONDENSED_H
#define BEAMWORK_BEAMW_CONDENSED_H

#include "elements/beamw/modified.h"

enum { BEAMW_CONDENSED_EVEN = 5, BEAMW_CONDENSED_ALL = BEAMW_CONDENSED_EVEN + 3 };

typedef struct beamw_condensed {
    double k[BEAMW_CONDENSED_EVEN];               /* [N/m] */
    double Ka[3];                                 /* [N m, N m, N m^3] */
    double f[3 * 3];                              /* F/(G l) */
    double hg[3 * BEAMW_STRAINS];                 /* z = hg e without stress */
    double P[BEAMW_CONDENSED_ALL][BEAMW_STRAINS]; /* (u, h) = P ebar */
    double Q[BEAMW_CONDENSED_ALL]
            [BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES]; /* and its quadratic part */
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
