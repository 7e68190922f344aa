/* Mass along a two-node element that moves in time: what its motion takes, with derivatives. The
 * masses lie on the displacements of spread.h, that of warping at the nodes; without rotary inertia
 * the twist is linear between these. A rigid motion of the nodes is one of all. */
#ifndef BEAMWORK_BEAMW_IN_TIME_H
#define BEAMWORK_BEAMW_IN_TIME_H

#include "elements/beamw/spread.h"

/* out += M, taken, C and K at its rate; of M the upper half counts. The second for processors with
 * AVX2, the same bits (elements/math/real.h). */
typedef void beamw_in_time(const beamw_spread *, const node_state x[2], inertia_output *out);
beamw_in_time beamw_in_time_plain, beamw_in_time_avx2;

#endif
