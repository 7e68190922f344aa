/* Energy of non-uniform torsion along an element whose twist rate is known at Gauss points.  The warping amplitude is a
 * polynomial through its value at the start and one value per stage; that it has the given value at the end is a condition
 * whose multiplier is the bimoment there.  Everything is linear, so that all but the multiplier is eliminated once.
 * Dimensionless (constants.h). */
#ifndef BEAMWORK_EXACT_WARPING_H
#define BEAMWORK_EXACT_WARPING_H

#include "elements/exact/constants.h"

enum { WARPING_MAX_STAGES = 8, WARPING_MAX = WARPING_MAX_STAGES + 3 };

/* Energy 1/2 z . S z (stationary in the multiplier) with z = (twist rate less the shear that Q_y and Q_z make, at the stages;
 * amplitude at p, at q; multiplier).  x, w [stages]: Gauss points and weights. */
void warping_energy(const constants *c, int stages, const double x[], const double w[], double S[WARPING_MAX * WARPING_MAX]);

#endif
