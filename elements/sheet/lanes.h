/* Strains and stresses of several sheet elements at once, the bits of one element at a time; of
 * each two, the second for processors with AVX2 (elements/math/real.h). Members of element_type. */
#ifndef BEAMWORK_SHEET_LANES_H
#define BEAMWORK_SHEET_LANES_H

#include "elements/element.h"

typedef void sheet_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
sheet_lanes_strains sheet_lanes_strain_plain, sheet_lanes_strain_avx2;

typedef void sheet_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);
sheet_lanes_stresses sheet_lanes_second_plain, sheet_lanes_second_avx2;
sheet_lanes_stresses sheet_lanes_third_plain, sheet_lanes_third_avx2;

typedef void sheet_lanes_equations(int count, const element_data *const data[],
                                   const node_state x[], const double *const e[],
                                   const double *const inner[], const double *const s[],
                                   equations_output out[], status outcome[]);
sheet_lanes_equations sheet_lanes_second_equations_plain, sheet_lanes_second_equations_avx2;
sheet_lanes_equations sheet_lanes_third_equations_plain, sheet_lanes_third_equations_avx2;

#endif
