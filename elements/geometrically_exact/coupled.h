/* Sections by their matrices (elements/section/matrices.h) in the elements of this folder: energy
 * 1/2 (gamma, kappa) . C (gamma, kappa) per length and no other terms. */
#ifndef BEAMWORK_EXACT_COUPLED_H
#define BEAMWORK_EXACT_COUPLED_H

#include "elements/shared/beam_constants.h"

/* S [strains x strains] [N/m] of Gauss points that each stand for their part.  At one point the
 * moment is linear along the element with the slope M' = -e_x x N, which adds the flexibility int
 * M' . (C^-1) M' to that of the forces: end loads are carried exactly (stiffness.h).  Amplitudes of
 * warping have no stiffness. */
status exact_coupled_stiffness(const beam_constants *c, int points, int strains, double length,
                               double S[], fault *f);

#endif
