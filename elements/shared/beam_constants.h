/* Section constants made dimensionless with the length l0 of an element and one of its bending
 * stiffnesses, limited to the requested physics. */
#ifndef BEAMWORK_SHARED_BEAM_CONSTANTS_H
#define BEAMWORK_SHARED_BEAM_CONSTANTS_H

#include "elements/element.h"

/* Forces in units of EI/l0^2, moments of EI/l0, bimoments of EI, lengths of l0. */
typedef struct beam_constants {
    double energy; /* unit of energy EI/l0 [J], with the smaller EI */
    double EA, EIy, EIz, GJ, EIw;
    double F[9];   /* shear flexibility F/G: (g_y, g_z, g_w) = F (Q_y, Q_z, M_w); zero: rigid */
    double ys, zs; /* shear centre */
    double trapeze, bend_y, bend_z; /* N, My, Mz act on gamma_x, kappa_y, kappa_z plus these factors
                                       times kappa_x^2/2 */
    double torque;                  /* energy torque kappa_x^4 per length */
    double initial[3];              /* strains gx, gy, gz of the stress-free element */
    int warping;
    int coupled;      /* 1: a section given by matrices; only the members below, energy, initial and
                         warping = 0 are used */
    double C[36];     /* (N, Q, M) = C (gamma, kappa) */
    double mixed[36]; /* (M, -gamma) = mixed (kappa, N) */
} beam_constants;

status beam_constants_of(const element_request *request, beam_constants *out, fault *f);

/* For element_type: members common to geometrically exact beams with warping. */
#define EXACT_TYPE                                                                                 \
    .family = "reissner", .abi = ELEMENT_ABI, .shear_theories = SHEAR_HARINGX,                     \
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |              \
              FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE | FEATURE_HARINGX |                   \
              FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_CURVATURE | FEATURE_MASS |               \
              FEATURE_ROTARY_INERTIA | FEATURE_COUPLED

/* Sections given by matrices (elements/section/section.h), dimensionless: the stiffness C of
 * (gamma, kappa), and its mixed form with gamma expressed by the force. */

/* Sets out->C and out->mixed, made dimensionless by EI [N m^2]. */
status beam_coupled_of(const section *profile, double l0, double EI, beam_constants *out, fault *f);

/* Computes the inverse of a symmetric positive definite matrix [n x n], n <= 6. Returns 0, or the
 * number of a failing pivot. */
int beam_coupled_inverse(int n, const double A[], double inverse[]);

/* Reports that a matrix of an element of this length [m] could not be inverted. */
status beam_coupled_too_stiff(double length, fault *f);

#endif
