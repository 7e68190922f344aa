/* The third-order element of N section 3 with the sign of u_y in N Eq. 49 corrected (reference/ERRATA.md, N 49). */
#include "elements/sheet/third.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return sheet_third_prepare(request, 0, out, f);
}

const element_type element_sheet_third = {
    .name = "sheet_third",
    .summary = "third-order sheet-flexure element (Hellinger-Reissner), sign of u_y corrected",
    .source = "N Eqs. 37, 44-52, 55-65; reference/ERRATA.md, N 49",
    .family = "sheet",
    .abi = ELEMENT_ABI,
    .offers = SHEET_BASE_OFFERS,
    .limits = SHEET_BASE_LIMITS,
    .lacks = LACKS_SHEAR_Y,
    .lacks_by = "N Eq. 50",
    .shear_theories = SHEAR_OWN,
    .own_theory = "N Eq. 37: generalized strains that see no shear (reference/ERRATA.md, N 37)",
    .data_size = sheet_third_data_size,
    .prepare = prepare,
    .strain = sheet_base_strain,
    .stress = sheet_third_stress,
    .geometric = sheet_third_geometric,
    .inertia = sheet_base_inertia,
};
