/* Second-order elements of N sections 2.3-2.4: quadratic deformation function, linear stress
 * function (N Eqs. 33-36). */
#ifndef BEAMWORK_SHEET_SECOND_H
#define BEAMWORK_SHEET_SECOND_H

#include "elements/sheet/base.h"

size_t sheet_second_data_size(const element_request *request);
status sheet_second_prepare(const element_request *request, sheet_base_shear shear,
                            element_data *out, fault *f);
status sheet_second_stress(const element_data *d, const double e[], const double inner[],
                           stress_output *out);
void sheet_second_stress_many(int count, const element_data *const data[], const double *const e[],
                              const double *const inner[], stress_output out[], status outcome[]);
void sheet_second_equations_many(int count, const element_data *const data[], const node_state x[],
                                 const double *const e[], const double *const inner[],
                                 const double *const s[], equations_output out[], status outcome[]);

/* In an element_type. */
#define SHEET_SECOND_TYPE                                                                          \
    SHEET_BASE_TYPE, .limits = SHEET_BASE_LIMITS, .data_size = sheet_second_data_size,             \
        .stress = sheet_second_stress, .stress_many = sheet_second_stress_many,                    \
        .equations_many = sheet_second_equations_many

#endif
