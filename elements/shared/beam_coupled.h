/* Sections by their matrices (elements/section/matrices.h), dimensionless: the stiffness C of
 * (gamma, kappa), and the same with gamma expressed by the force. */
#ifndef BEAMWORK_BEAM_COUPLED_H
#define BEAMWORK_BEAM_COUPLED_H

#include "elements/shared/beam_constants.h"

/* C and mixed of out; EI [N m^2]: the unit. */
status beam_coupled_of(const section *profile, double l0, double EI, beam_constants *out, fault *f);

/* Inverse of a symmetric positive definite matrix [n x n], n <= 6; 0, or the failing pivot. */
int beam_coupled_inverse(int n, const double A[], double inverse[]);

/* Says that a matrix of an element of that length [m] could not be inverted. */
status beam_coupled_too_stiff(double length, fault *f);

#endif
