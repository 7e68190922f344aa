/* BEAMW without its second-order terms: what they are worth is measured by leaving them out. */
#include "elements/beamw/inertia.h"
#include "elements/beamw/prepare.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_DIAGONAL, BEAMW_PREPARE_FIRST_ORDER, out,
                                 f);
}

const element_type element_beamw_first = {
    .name = "beamw_first",
    .summary = "BEAMW with linear modes: no second-order terms inside the element",
    .source = "J Eqs. 7, App. A",
    .family = "beamw",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_ENGESSER | FEATURE_WARPING |
              FEATURE_ECCENTRIC | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS |
              FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_QUARTER_TURN,
    .shear_theories = SHEAR_ENGESSER,
    .options = {beamw_prepare_mass},
    .judged = beamw_prepare_judged,
    .data_size = beamw_variants_data_size,
    .prepare = prepare,
    .strain = beamw_variants_strain,
    .stress = beamw_variants_stress,
    .geometric = beamw_variants_geometric,
    .inertia = beamw_inertia_of,
};
