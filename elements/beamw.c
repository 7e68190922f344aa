/* BEAMW as printed, misprints corrected.  Its modified modes do not see shear, so that they belong to neither theory of shear in
 * stability: it has one of its own and converges to neither (reference/ERRATA.md). */
#include "elements/beamw/inertia.h"
#include "elements/beamw/prepare.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_DIAGONAL, BEAMW_PREPARE_PRINTED, out, f);
}

const element_type element_beamw = {
    .name = "beamw",
    .summary =
        "BEAMW as printed, misprints corrected: shear-deformable thin-walled beam, second order",
    .source = "J Eqs. 7, 66, App. A",
    .family = "beamw",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WARPING | FEATURE_ECCENTRIC |
              FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_QUARTER_TURN,
    .shear_theories = SHEAR_OWN,
    .own_theory = "J Eq. 66: modified modes that see no shear (reference/ERRATA.md, J 58/62/66)",
    .options = {beamw_prepare_mass},
    .judged = beamw_prepare_judged,
    .data_size = beamw_variants_data_size,
    .prepare = prepare,
    .strain = beamw_variants_strain,
    .stress = beamw_variants_stress,
    .geometric = beamw_variants_geometric,
    .inertia = beamw_inertia_of,
};
