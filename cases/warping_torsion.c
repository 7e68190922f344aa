/* Non-uniform torsion of a shear-rigid cantilever under a tip torque: hyperbolic functions against
 * cubic ones. twist_ratio = phi GJ/(T L): 1 - tanh(kL)/(kL) with a free tip, 1 - tanh(kL/2)/(kL/2)
 * when the tip cannot warp. */
#include "cases/case.h"

#include <stddef.h>

enum { LENGTH, KL, ENDS };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 1.0, 1e-6, 1e6, NULL, "length of the beam"},
    [KL] = {"kL", "1", 1.0, 1e-4, 1e5, NULL, "length times sqrt(GJ/EIw)"},
    [ENDS] = {"ends", "", 0, 0, 0, "cantilever|fixed",
              "warping at the tip: free (cantilever) or fixed"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double length = value[LENGTH], k = value[KL] / length;
    section_spec spec = section_spec_constants(200e9, 80e9);
    spec.constants.A = 1e-3;
    spec.constants.Iy = 2e-6;
    spec.constants.Iz = 3e-6;
    spec.constants.Ip = 5e-6;
    spec.constants.It = 4e-8;
    spec.constants.Iw = spec.shear_modulus * spec.constants.It / (spec.young * k * k);
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    const int member = scene_add_member(s, root, tip, profile, y_axis);
    scene_member_at(s, member)->warp_p = SCENE_WARP_FIXED;
    scene_member_at(s, member)->warp_q = value[ENDS] == 0 ? SCENE_WARP_FREE : SCENE_WARP_FIXED;
    scene_hold_all(s, root);
    scene_add_load(s, SCENE_MOMENT, tip, 1, 0, 0);
    const int linear = scene_add_linear(s);
    scene_quantity *twist =
        scene_add_quantity(s, "twist_ratio", "1", linear, scene_coordinate(tip, SCENE_RX));
    twist->factor = spec.shear_modulus * spec.constants.It / length;
    twist->least_order = 3.5;
    scene_meshes_doubled(s, 1, 32);
    return STATUS_OK;
}

const case_type case_warping_torsion = {
    .name = "warping_torsion",
    .summary = "cantilever in non-uniform torsion, shear-rigid",
    .source = "Vlasov torsion, closed form",
    .parameters = {parameters, case_omit},
    .build = build,
};
