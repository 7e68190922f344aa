/* BEAMW with Phi = 0 whatever the section's shear rigidities: Vlasov's theory. */
#include "elements/beamw/inertia.h"
#include "elements/beamw/prepare.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_RIGID, BEAMW_PREPARE_PRINTED, out, f);
}

const element_type element_beamw_vlasov = {
    .name = "beamw_vlasov",
    .summary = "BEAMW in the shear-rigid limit (Vlasov)",
    .source = "J Eqs. 7, 66, App. A with Phi = 0",
    .family = "beamw",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_TRAPEZE | FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_GEOMETRIC |
              FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_QUARTER_TURN,
    .options = {beamw_prepare_mass},
    .judged = beamw_prepare_judged,
    .data_size = beamw_variants_data_size,
    .prepare = prepare,
    .strain = beamw_variants_strain,
    .stress = beamw_variants_stress,
    .geometric = beamw_variants_geometric,
    .inertia = beamw_inertia_of,
};
