/* Section constants limited to the requested physics. They are made dimensionless with the length
 * l0 of an element and one of its bending stiffnesses. */
#ifndef BEAMWORK_SHARED_BEAM_CONSTANTS_H
#define BEAMWORK_SHARED_BEAM_CONSTANTS_H

#include "elements/element.h"

/* Constants whose unit of force is EI/l0^2, of moment EI/l0, of bimoment EI, and of length l0. */
typedef struct beam_constants {
    double energy; /* unit of energy EI/l0 [J], where EI is the smaller bending stiffness */
    double EA, EIy, EIz, GJ, EIw;
    double F[9];   /* shear flexibility F/G: (g_y, g_z, g_w) = F (Q_y, Q_z, M_w); zero: rigid */
    double ys, zs; /* coordinates of the shear centre */
    double trapeze, bend_y, bend_z; /* N, My, Mz do work on gamma_x, kappa_y, kappa_z plus these
                                       factors times kappa_x^2/2 */
    double torque;                  /* coefficient of kappa_x^4 in the energy per length */
    double initial[3];              /* strains gx, gy, gz of the stress-free element */
    int warping;
    /* 1 if the section is given by matrices. Then only the members below, `energy` and `initial`
     * are used, and `warping` is 0 */
    int coupled;
    double C[36];     /* (N, Q, M) = C (gamma, kappa) */
    double mixed[36]; /* (M, -gamma) = mixed (kappa, N) */
} beam_constants;

status beam_constants_of(const element_request *request, beam_constants *out, fault *f);

#define EXACT_TYPE                                                                                 \
    .family = "reissner", .abi = ELEMENT_ABI, .shear_theories = SHEAR_HARINGX,                     \
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |              \
              FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE | FEATURE_HARINGX |                   \
              FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_CURVATURE | FEATURE_MASS |               \
              FEATURE_ROTARY_INERTIA | FEATURE_COUPLED

/* Sets out->C, the stiffness of (gamma, kappa), and out->mixed, which expresses gamma by the force,
 * for a section given by matrices. Both are made dimensionless with l0 [m] and EI [N m^2]. Returns
 * REFUSED if the block of gamma in C cannot be inverted. */
status beam_coupled_of(const section *profile, double l0, double EI, beam_constants *out, fault *f);

/* Computes the inverse of a symmetric positive definite matrix [n x n], n <= 6. Returns 0, or the
 * number of the pivot that fails, counted from 1. */
int beam_coupled_inverse(int n, const double A[], double inverse[]);

/* Returns REFUSED unless the length [m] of the element is finite and positive. */
status beam_length_check(double length, fault *f);
status beam_overflow(double length, fault *f);

status beam_coupled_too_stiff(double length, fault *f);

#endif
