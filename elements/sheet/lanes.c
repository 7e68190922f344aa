#define LANES 4
#include "elements/sheet/sheet.h"

#include "elements/shared/lanes.h"
#include "elements/sheet/deformation.h"
#include "elements/sheet/potential.h"

static const lanes_sizes sizes = {.nodes = 2, .strains = SHEET_STRAINS, .relative = 1};

static inline void strain(const element_data *d, const node_real x[], strain_real *out)
{
    sheet_deformation_evaluate(&((const sheet_base_data *)(const void *)d)->table, x, out);
}

void REAL_NAMED(sheet_lanes_strain)(int count, const element_data *const data[],
                                    const node_state x[], strain_output out[])
{
    lanes_strain_many(sizes, strain, count, data, x, out);
}

static inline real_truth second(const element_data *d, const real e[], const real inner[],
                                stress_real *out)
{
    (void)inner;
    sheet_linear_stress((const sheet_base_data *)(const void *)d, e, out);
    return real_true();
}

void REAL_NAMED(sheet_lanes_second)(int count, const element_data *const data[],
                                    const double *const e[], const double *const inner[],
                                    stress_output out[], status outcome[])
{
    lanes_stress_many(sizes, second, STATUS_OK, count, data, e, inner, out, outcome);
}

static inline real_truth third(const element_data *d, const real e[], const real inner[],
                               stress_real *out)
{
    (void)inner;
    return sheet_inverse_stress(sheet_inverse_of(d), e, out);
}

void REAL_NAMED(sheet_lanes_third)(int count, const element_data *const data[],
                                   const double *const e[], const double *const inner[],
                                   stress_output out[], status outcome[])
{
    lanes_stress_many(sizes, third, STATUS_SINGULAR, count, data, e, inner, out, outcome);
}

void REAL_NAMED(sheet_lanes_second_equations)(int count, const element_data *const data[],
                                              const node_state x[], const double *const e[],
                                              const double *const inner[], const double *const s[],
                                              equations_output out[], status outcome[])
{
    lanes_equations_many(sizes, strain, second, STATUS_OK, count, data, x, e, inner, s, out,
                         outcome);
}

void REAL_NAMED(sheet_lanes_third_equations)(int count, const element_data *const data[],
                                             const node_state x[], const double *const e[],
                                             const double *const inner[], const double *const s[],
                                             equations_output out[], status outcome[])
{
    lanes_equations_many(sizes, strain, third, STATUS_SINGULAR, count, data, x, e, inner, s, out,
                         outcome);
}
