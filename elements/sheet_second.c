/* The second-order element of N section 2. Its generalized strains omit the shear terms, so with
 * shear flexibility the element converges to a biased limit (reference/ERRATA.md, N 37). */
#include "elements/sheet/sheet.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return sheet_second_prepare(request, SHEET_BASE_PRINTED, out, f);
}

const element_type element_sheet_second = {
    .name = "sheet_second",
    .summary = "second-order sheet-flexure element (Hu-Washizu)",
    .source = "N Eqs. 33-37, 40-42",
    SHEET_SECOND_TYPE,
    SHEET_BASE_WITHOUT_SHEAR,
    .prepare = prepare,
};
