/* third-order sheet-flexure element with the printed sign of u_y. */
#include "elements/sheet/third.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return third_prepare(request, 1, out, f);
}

const element_type element_sheet_third_printed = {
    .name = "sheet_third_printed",
    .summary = "third-order sheet-flexure element with the printed sign of u_y",
    .source = "N Eqs. 37, 44-50, 55-65 as printed",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_HARINGX | FEATURE_ENGESSER |
              FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT,
    .data_size = third_data_size,
    .prepare = prepare,
    .strain = third_strain,
    .stress = third_stress,
    .geometric = third_geometric,
    .inertia = third_inertia,
};
