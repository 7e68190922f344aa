/* The second-order element of N section 2, whose generalized strains leave the shear terms out: with flexible shear it
 * converges to a limit of its own (reference/ERRATA.md, N 37). */
#include "elements/sheet/second.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return second_prepare(request, BASE_PRINTED, out, f);
}

const element_type element_sheet_second = {
    .name = "sheet_second",
    .summary = "second-order sheet-flexure element (Hu-Washizu)",
    .source = "N Eqs. 33-37, 40-42",
    .abi = ELEMENT_ABI,
    .offers = BASE_OFFERS,
    .limits = BASE_LIMITS,
    .shear_theories = SHEAR_OWN,
    .own_theory = "N Eq. 37: generalized strains that see no shear (reference/ERRATA.md, N 37)",
    .data_size = second_data_size,
    .prepare = prepare,
    .strain = base_strain,
    .stress = second_stress,
    .inertia = base_inertia,
};
