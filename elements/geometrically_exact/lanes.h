/* Strains and stresses of several exact elements at once, the bits of one element at a time; of
 * each two, the second for processors with AVX2 (elements/math/real.h). Members of element_type. */
#ifndef BEAMWORK_EXACT_LANES_H
#define BEAMWORK_EXACT_LANES_H

#include "elements/geometrically_exact/strain.h"

typedef void exact_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
typedef void exact_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);

/* For data that begin with exact_gauss. */
exact_lanes_strains exact_lanes_gauss_strain_plain, exact_lanes_gauss_strain_avx2;
exact_lanes_stresses exact_lanes_gauss_stress_plain, exact_lanes_gauss_stress_avx2;

#endif
