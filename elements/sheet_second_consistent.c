/* second-order sheet-flexure element with shear kept in its deformation function. */
#include "elements/sheet/second.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return second_prepare(request, 1, out, f);
}

const element_type element_sheet_second_consistent = {
    .name = "sheet_second_consistent",
    .summary = "second-order sheet-flexure element with shear kept in its deformation function",
    .source = "N Eqs. 7, 13-17, 33-36; reference/ERRATA.md, N 37",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_HARINGX | FEATURE_GEOMETRIC |
              FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT,
    .data_size = second_data_size,
    .prepare = prepare,
    .strain = second_strain,
    .stress = second_stress,
    .geometric = second_geometric,
    .inertia = second_inertia,
};
