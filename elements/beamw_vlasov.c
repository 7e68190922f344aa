/* BEAMW with Phi = 0 (Vlasov's theory), for any shear rigidities of the section. */
#include "elements/beamw/variants.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_variant(request, BEAMW_STIFFNESS_RIGID, BEAMW_PREPARE_PRINTED, out, f);
}

const element_type element_beamw_vlasov = {
    .name = "beamw_vlasov",
    .summary = "BEAMW in the shear-rigid limit (Vlasov)",
    .source = "J Eqs. 7, 66, App. A with Phi = 0",
    BEAMW_VARIANT_TYPE,
    .offers = BEAMW_OFFERS,
    .prepare = prepare,
};
