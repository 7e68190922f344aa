/* BEAMW as printed, misprints corrected.  Its modified modes do not see shear, so that they belong to neither theory of shear in
 * stability: it offers both and converges to neither (reference/ERRATA.md). */
#include "elements/beamw/inertia.h"
#include "elements/beamw/prepare.h"

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return prepare_form(request, STIFFNESS_DIAGONAL, PREPARE_PRINTED, out, f);
}

const element_type element_beamw = {
    .name = "beamw",
    .summary =
        "BEAMW as printed, misprints corrected: shear-deformable thin-walled beam, second order",
    .source = "J Eqs. 7, 66, App. A",
    .abi = ELEMENT_ABI,
    .offers = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_ENGESSER | FEATURE_HARINGX |
              FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_GEOMETRIC | FEATURE_LARGE |
              FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_QUARTER_TURN,
    .shear_theories = SHEAR_OWN,
    .own_theory = "J Eq. 66: modified modes that see no shear (reference/ERRATA.md, J 58/62/66)",
    .options = prepare_options,
    .data_size = forms_data_size,
    .prepare = prepare,
    .strain = forms_strain,
    .stress = forms_stress,
    .geometric = forms_geometric,
    .inertia = inertia_of,
};
