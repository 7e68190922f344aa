/* BEAMW without its second-order terms, for comparisons that show the effect of these terms. */
#include "elements/beamw/variants.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_DIAGONAL, BEAMW_PREPARE_FIRST_ORDER, out,
                                 f);
}

const element_type element_beamw_first = {
    .name = "beamw_first",
    .summary = "BEAMW with linear modes: without second-order terms inside the element",
    .source = "J Eq. 7, App. A",
    BEAMW_VARIANT_TYPE,
    .offers = BEAMW_OFFERS | FEATURE_SHEAR | FEATURE_ENGESSER,
    .shear_theories = SHEAR_ENGESSER,
    .prepare = prepare,
};
