/* A step that keeps energy and both momenta of any formulation, from `strain` at three states and
 * `stress` at the end. With the strains e of its ends,
 *   s = (sigma_n + sigma_1)/2,   W = (P''(e_n) + P''(e_1))/2,
 *   d = sum_g w_g J(x(s_g)) (dr^, phi, da),   sigma_m = s + k W d,
 *   k = sum [P(e_1) - P(e_n) - s.d]/sum d.W d   (one number for the whole structure):
 * sum sigma_m.d is the change of energy, and forces A^T sigma_m have no resultant in any rigid
 * motion (cayley.h). Translations m (v1 - v)/h = f - F with dr = h (v + v1)/2; rotations by Cayley
 * vectors R_n^T c = h (W + W1)/2, (R_1 J W1 - R_n J W)/h = m - M. After Simo, Tarnow & Doblare
 * (1995), Gonzalez (1996) and Sansour et al. (2004); the common turn of an element, its two points
 * and the one number are not theirs. W is not P'' at rest: where stresses inside an element depend
 * on how far it is bent, its stiff directions move with the strains, and k W d would press against
 * them. */
#ifndef BEAMWORK_CONSERVING_H
#define BEAMWORK_CONSERVING_H

#include "harness/time/scheme.h"

/* REFUSED: several angles of a node in sequence; no rotation has inertia. Rates of what has none
 * are those of the mean of a step. */
status conserving_alloc(const scheme_request *, motion_scheme **, fault *);

#endif
