/* Second-order elements of N sections 2.3-2.4: quadratic deformation function, linear stress function (N Eqs. 33-36). */
#ifndef BEAMWORK_SHEET_SECOND_H
#define BEAMWORK_SHEET_SECOND_H

#include "elements/sheet/base.h"

size_t second_data_size(const element_request *request);
status second_prepare(const element_request *request, base_shear shear, element_data *out,
                      fault *f);
status second_stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out);

#endif
