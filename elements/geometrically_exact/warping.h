/* Energy of non-uniform torsion along an element whose twist rate is known at Gauss points.  The
 * warping amplitude a(x) is any function with the given values at the ends; with P the projection
 * on the polynomials that the points stand for, the twist rate is P kappa + a - P a, and without
 * warping shear P kappa = P a.  Given kappa at the points the best a is a polynomial plus the two
 * boundary layers exp(-lambda x), exp(-lambda (1 - x)), lambda^2 = GJ/EIw, so that long elements
 * need no mesh for their ends (derived here).  Everything is linear and eliminated once.
 * Dimensionless (beam_constants.h). */
#ifndef BEAMWORK_EXACT_WARPING_H
#define BEAMWORK_EXACT_WARPING_H

#include "elements/shared/beam_constants.h"

enum { EXACT_WARPING_MAX_STAGES = 8, EXACT_WARPING_MAX = EXACT_WARPING_MAX_STAGES + 2 };

/* Energy 1/2 z . S z beyond GJ kappa^2/2 at the points, with z = (twist rate less the shear that
 * Q_y and Q_z make, at the stages; amplitude at p, at q).  x, w [stages]: Gauss points and weights.
 */
void exact_warping_energy(const beam_constants *c, int stages, const double x[], const double w[],
                          double S[EXACT_WARPING_MAX * EXACT_WARPING_MAX]);

#endif
