/* The third-order element of N section 3 with the sign of u_y in N Eq. 49 corrected
 * (reference/ERRATA.md, N 49). */
#include "elements/sheet/sheet.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return sheet_third_prepare(request, 0, out, f);
}

const element_type element_sheet_third = {
    .name = "sheet_third",
    .summary =
        "third-order sheet-flexure element (Hellinger-Reissner), with one sign in the torsional "
        "moment corrected",
    .source = "N Eqs. 37, 44-52, 55-65; reference/ERRATA.md, N 49",
    SHEET_THIRD_TYPE,
    .prepare = prepare,
};
