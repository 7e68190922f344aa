/* BEAMW as published, with misprints corrected. The modified modes exclude shear deformation.
 * Therefore, in stability problems, BEAMW converges to the limit of neither shear theory
 * (reference/ERRATA.md). */
#include "elements/beamw/variants.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_DIAGONAL, BEAMW_PREPARE_PRINTED, out, f);
}

const element_type element_beamw = {
    .name = "beamw",
    .summary = "BEAMW as published, with misprints corrected: shear-deformable thin-walled beam, "
               "second order",
    .source = "J Eqs. 7, 66, App. A",
    BEAMW_VARIANT_TYPE,
    .offers = BEAMW_OFFERS | FEATURE_SHEAR,
    .shear_theories = SHEAR_OWN,
    .own_theory = "J Eq. 66: modified modes that exclude shear (reference/ERRATA.md, J 58/62/66)",
    .prepare = prepare,
};
