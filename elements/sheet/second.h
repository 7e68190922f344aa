/* The second-order element of N sections 2.3-2.4: quadratic deformation function, linear stress function (N Eqs. 33-36). */
#ifndef BEAMWORK_SHEET_SECOND_H
#define BEAMWORK_SHEET_SECOND_H

#include "elements/sheet/relations.h"

size_t second_data_size(const element_request *);
/* consistent: 1 keeps shear in the deformation function. */
status second_prepare(const element_request *request, int consistent, element_data *out, fault *f);
void second_strain(const element_data *d, const node_state x[], strain_output *out);
status second_stress(const element_data *d, const double e[], const double inner[], stress_output *out);
void second_geometric(const element_data *d, const double sigma[], double G[]);
status second_inertia(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out);

#endif
