/* The second-order element of N section 2 with the shear terms included in the generalized strains.
 * The error converges with order four in the element length, and the limit is exact for small shear
 * strains and elongations. */
#include "elements/sheet/sheet.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return sheet_second_prepare(request, SHEET_BASE_CONSISTENT, out, f);
}

const element_type element_sheet_second_consistent = {
    .name = "sheet_second_consistent",
    .summary = "second-order sheet-flexure element whose deformation function includes shear",
    .source = "N Eqs. 7, 13-17, 33-36; reference/ERRATA.md, N 37",
    SHEET_SECOND_TYPE,
    .offers = SHEET_BASE_OFFERS | FEATURE_HARINGX, /* Simo-Reissner: the axial force does work on
                                                      the rotation of the cross-section */
    .shear_theories = SHEAR_HARINGX,
    .prepare = prepare,
};
