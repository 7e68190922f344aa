/* Stiffness of the BEAMW variants as a sum of squares (J section 3.2, App. A), and the linear shear
 * functionals. */
#ifndef BEAMWORK_BEAMW_STIFFNESS_H
#define BEAMWORK_BEAMW_STIFFNESS_H

#include "elements/beamw/twist.h"

typedef enum beamw_stiffness_shear {
    BEAMW_STIFFNESS_RIGID,    /* Phi = 0: Vlasov */
    BEAMW_STIFFNESS_DIAGONAL, /* J App. A, whose Phi see only the diagonal of D */
    BEAMW_STIFFNESS_COUPLED   /* the whole of D: nodally exact for any positive definite D if It = 0
                                 or with hyperbolic twist */
} beamw_stiffness_shear;

/* Linear functionals of e that stiffness, modified modes and inertia are made of. */
typedef struct beamw_stiffness_fields {
    double h[3][8]; /* [1/m, 1/m, 1/m^2] mean antisymmetric deformation (y, z, omega) = bending part
                       + shear strain */
    double hg[3][8]; /* its bending part (warping part for omega) */
    double g[3][8];  /* shear strains g_y, g_z [1], g_w [1/m] */
    double A[8];     /* (e7 - e8)/2 */
    double tw[8];    /* l0^2 hg_w */
} beamw_stiffness_fields;

/* t: beamw_twist_of the same section, length and shear. */
void beamw_stiffness_of(const section *c, double l0, beamw_stiffness_shear kind,
                        const beamw_twist *t, beamw_stiffness_fields *fields, double S[8 * 8]);

#endif
