/* Strains and stresses of several BEAMW elements at once, the bits of one element at a time; of
 * each two, the second for processors with AVX2 (elements/math/real.h). Members of element_type. */
#ifndef BEAMWORK_BEAMW_LANES_H
#define BEAMWORK_BEAMW_LANES_H

#include "elements/element.h"

typedef void beamw_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
typedef void beamw_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);
beamw_lanes_strains beamw_lanes_modes_plain, beamw_lanes_modes_avx2;
beamw_lanes_strains beamw_lanes_helicoidal_plain, beamw_lanes_helicoidal_avx2;
beamw_lanes_stresses beamw_lanes_modified_plain, beamw_lanes_modified_avx2;
/* Stresses of beamw_prepare_consistent, following or not. */
beamw_lanes_stresses beamw_lanes_consistent_plain, beamw_lanes_consistent_avx2;

#endif
