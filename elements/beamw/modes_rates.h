/* Time derivatives of the gradients of the deformation modes (modes.h) as the nodes move. */
#ifndef BEAMWORK_BEAMW_MODES_RATES_H
#define BEAMWORK_BEAMW_MODES_RATES_H

#include "elements/element.h"

/* slope[8 x 14] = H x' of each mode, H its second derivatives in the exponential chart, at rates
 * x'[14]: the rate of the gradient J less 1/2 w x J at the rotations of each node. Then the second
 * derivative of a mode in time without accelerations is slope . x'. */
void beamw_modes_slopes(double l0, const node_state x[2], const double J[8 * 14],
                        const double rate[14], double slope[8 * 14]);

#endif
