/* second-order sheet-flexure element (Hu-Washizu). */
#include "elements/sheet/second.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return second_prepare(request, 0, out, f);
}

const element_type element_sheet_second = {
    .name = "sheet_second",
    .summary = "second-order sheet-flexure element (Hu-Washizu)",
    .source = "N Eqs. 33-37, 40-42",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_HARINGX | FEATURE_ENGESSER | FEATURE_GEOMETRIC |
              FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT,
    .data_size = second_data_size,
    .prepare = prepare,
    .strain = second_strain,
    .stress = second_stress,
    .geometric = second_geometric,
    .inertia = second_inertia,
};
