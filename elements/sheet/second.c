#include "elements/sheet/second.h"

#include "elements/sheet/linear.h"

size_t sheet_second_data_size(const element_request *request)
{
    (void)request;
    return sizeof(sheet_base_data);
}

status sheet_second_prepare(const element_request *request, sheet_base_shear shear,
                            element_data *out, fault *f)
{
    return sheet_base_prepare(request, shear, (sheet_base_data *)(void *)out, f);
}

status sheet_second_stress(const element_data *d, const double e[], const double inner[],
                           stress_output *out)
{
    (void)inner;
    sheet_linear_stress((const sheet_base_data *)(const void *)d, e, out);
    return STATUS_OK;
}

void sheet_second_stress_many(int count, const element_data *const data[], const double *const e[],
                              const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_second)(count, data, e, inner, out, outcome);
}

void sheet_second_equations_many(int count, const element_data *const data[], const node_state x[],
                                 const double *const e[], const double *const inner[],
                                 const double *const s[], equations_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_second_equations)(count, data, x, e, inner, s, out, outcome);
}
