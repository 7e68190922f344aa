/* The third-order element of N section 3 with the sign of u_y as printed in N Eq. 49. */
#include "elements/sheet/sheet.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return sheet_third_prepare(request, 1, out, f);
}

const element_type element_sheet_third_printed = {
    .name = "sheet_third_printed",
    .summary =
        "third-order sheet-flexure element as printed, with a wrong sign in the torsional moment",
    .source = "N Eqs. 37, 44-52, 55-65 as printed",
    SHEET_THIRD_TYPE,
    .prepare = prepare,
    .misprint = "N Eq. 49: the sign of the term with u_y",
};
