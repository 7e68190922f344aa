/* Third-order elements of N section 3: the deformation function of the second-order one, and a
 * stress function from the Hellinger-Reissner potential P = P0 + 1/2 b^T A^-1 b, whose coefficients
 * are integrated once per section and length. */
#ifndef BEAMWORK_SHEET_THIRD_H
#define BEAMWORK_SHEET_THIRD_H

#include "elements/sheet/base.h"

size_t sheet_third_data_size(const element_request *request);
/* printed: 1 takes the sign of u_y as printed in N Eq. 49. */
status sheet_third_prepare(const element_request *request, int printed, element_data *out,
                           fault *f);
status sheet_third_stress(const element_data *d, const double e[], const double inner[],
                          stress_output *out);
void sheet_third_stress_many(int count, const element_data *const data[], const double *const e[],
                             const double *const inner[], stress_output out[], status outcome[]);
void sheet_third_equations_many(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[]);
void sheet_third_geometric(const element_data *d, const double sigma[], double G[]);
double sheet_third_tension(const element_data *d, const double sigma[]);

/* In an element_type. */
#define SHEET_THIRD_TYPE                                                                           \
    SHEET_BASE_TYPE, SHEET_BASE_WITHOUT_SHEAR,                                                     \
        .limits = SHEET_BASE_LIMITS | LIMIT_FLAT_ARC | LIMIT_TENSION, .lacks = LACKS_SHEAR_Y,      \
        .lacks_by = "N Eq. 50", .data_size = sheet_third_data_size, .stress = sheet_third_stress,  \
        .stress_many = sheet_third_stress_many, .equations_many = sheet_third_equations_many,      \
        .geometric = sheet_third_geometric, .tension = sheet_third_tension

#endif
