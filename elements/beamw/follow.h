/* A stress function whose inside follows the stress: bending, shear and warping share the antisymmetric deformation h as
 * equilibrium of the stressed element asks, instead of as in the unstressed one.  With z the bending and warping part of h,
 *   energy = stationary over z and q of  1/2 sum_r k_r u_r^2 + 1/2 z^T Ka z + q . (h - z) - 1/2 q^T F q/(G l),
 * where u = (e1, e2, e3 + e4, e5 + e6, (e7 - e8)/2) and h are those of ebar = e + 1/2 (e, z)^T Q (e, z) (modified.h).  q is dual to
 * h: F = 0 does no harm. */
#ifndef BEAMWORK_BEAMW_FOLLOW_H
#define BEAMWORK_BEAMW_FOLLOW_H

#include "elements/beamw/modified.h"

enum { FOLLOW_EVEN = 5, FOLLOW_ALL = FOLLOW_EVEN + 3 };

typedef struct follow {
    double k[FOLLOW_EVEN];                                         /* [N/m] */
    double Ka[3];                                                  /* [N m, N m, N m^3] */
    double f[3 * 3];                                               /* F/(G l) */
    double hg[3 * FORMS_STRAINS];                                  /* z = hg e without stress */
    double P[FOLLOW_ALL][FORMS_STRAINS];                           /* (u, h) = P ebar */
    double Q[FOLLOW_ALL][MODIFIED_VARIABLES * MODIFIED_VARIABLES]; /* and its quadratic part */
} follow;

/* Q as of modified_consistent; warping 0: e7 = e8 = e2, nothing warps. */
void follow_prepare(const section *c, double l0, int shear, int warping, const twist *t,
                    const stiffness_fields *fields,
                    double Q[FORMS_MODIFIED][MODIFIED_VARIABLES * MODIFIED_VARIABLES], follow *out);

/* As element_type.stress; NOT_CONVERGED where the inside has no equilibrium. */
status follow_stress(const follow *d, const double e[FORMS_STRAINS], stress_output *out);

#endif
