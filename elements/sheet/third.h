/* The third-order element of N section 3: the deformation function of the second-order one, and a stress function from the
 * Hellinger-Reissner potential P = P0 + 1/2 b^T A^-1 b, whose coefficients are integrated once per section and length. */
#ifndef BEAMWORK_SHEET_THIRD_H
#define BEAMWORK_SHEET_THIRD_H

#include "elements/sheet/relations.h"

size_t third_data_size(const element_request *);
/* printed: 1 takes the sign of u_y as printed in N Eq. 49. */
status third_prepare(const element_request *request, int printed, element_data *out, fault *f);
void third_strain(const element_data *d, const node_state x[], strain_output *out);
status third_stress(const element_data *d, const double e[], const double inner[], stress_output *out);
void third_geometric(const element_data *d, const double sigma[], double G[]);
status third_inertia(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out);

#endif
