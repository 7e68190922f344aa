#include "cases/shared/sheet.h"

#include <stddef.h>

#include <math.h>
#include <stdio.h>

const parameter_type sheet_parameters[] = {
    [SHEET_LENGTH] = {"length", "m", 0.1, 1e-9, 1e6, NULL, "length of the sheet"},
    [SHEET_WIDTH] = {"width", "m", 0.1, 1e-9, 1e6, NULL, "width, along z"},
    [SHEET_THICKNESS] = {"thickness", "m", 0.00225, 1e-12, 1e5, NULL, "thickness, along y"},
    [SHEET_YOUNG] = {"young", "Pa", 200e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [SHEET_POISSON] = {"poisson", "1", 0.3, -0.99, 0.49, NULL, "Poisson's ratio"},
    [SHEET_DEFLECTION] = {"tip_deflection", "m", 0.015, -1e6, 1e6, NULL,
                          "prescribed tip displacement along y"},
    [SHEET_TIP_WARPING] = {"tip_warping", "1", 0, 0, 1, NULL,
                           "warping at the tip: 0 fixed, 1 free"},
    [SHEET_WARPING] = {"warping", "1", 1, 0, 1, NULL, "1: restrained warping, 0: uniform torsion"},
    [SHEET_SHEAR] = {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"},
    [SHEET_TRAPEZE] = {"trapeze", "1", 1, 0, 1, NULL, "1: shortening of a twisted sheet (N Eq. 8)"},
    [SHEET_WAGNER] = {"wagner", "1", 0, 0, 1, NULL, "1: Wagner torque (N Eq. 46)"},
    [SHEET_SHEAR_FACTOR] = {"shear_factor", "1", 0, 0, 10, NULL,
                            "k of the shear stiffness; 0: 10 (1 + nu)/(12 + 11 nu)"},
    [SHEET_MOMENTS] = {"moment_convention", "", SCENE_MOMENTS_SPATIAL, 0, 0, SCENE_MOMENTS_CHOICES,
                       "moments on the tip while it turns, in C_*"},
    {0},
};

void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out)
{
    *out = section_spec_rectangle(young, young / (2 * (1 + poisson)), width, thickness);
    const double k = shear_factor > 0 ? shear_factor : 10 * (1 + poisson) / (12 + 11 * poisson);
    out->shear_factor[0] = out->shear_factor[1] = k;
    /* of a thin sheet: N Eq. 46, and (w t)^3/144 */
    out->given.wagner_torque = pow(width, 5) * thickness / 1440;
    out->given.Iw = width * width * width * thickness * thickness * thickness / 144;
}

status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f)
{
    const double length = value[SHEET_LENGTH];
    if (fabs(value[SHEET_DEFLECTION]) >= length)
        return fault_set(
            f, STATUS_REFUSED,
            "tip_deflection = %g m cannot be reached by a sheet of length %g m; give a smaller one",
            value[SHEET_DEFLECTION], length);
    section_spec spec;
    sheet_section(value[SHEET_WIDTH], value[SHEET_THICKNESS], value[SHEET_YOUNG],
                  value[SHEET_POISSON], value[SHEET_SHEAR_FACTOR], &spec);
    if (value[SHEET_WARPING] == 0)
        spec.given.Iw = 0;
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    *root = scene_add_node(s, 0, 0, 0);
    *tip = scene_add_node(s, length, 0, 0);
    scene_member *sheet = scene_member_at(s, scene_add_member(s, *root, *tip, profile, y_axis));
    sheet->warp_p = SCENE_WARP_FIXED;
    sheet->warp_q = value[SHEET_TIP_WARPING] == 0 ? SCENE_WARP_FIXED : SCENE_WARP_FREE;
    scene_hold_all(s, *root);
    scene_omit(s, (value[SHEET_SHEAR] == 0 ? FEATURE_SHEAR : 0) |
                      (value[SHEET_TRAPEZE] == 0 ? FEATURE_TRAPEZE : 0) |
                      (value[SHEET_WAGNER] == 0 ? FEATURE_WAGNER_TORQUE : 0));
    /* a far bent sheet of many widths settles late */
    const int meshes[] = {1, 2, 3, 4, 8, 16, 32, 64, 128, 256},
              is_narrow = length >= 10 * value[SHEET_WIDTH];
    scene_meshes(s, is_narrow ? 10 : 8, meshes);
    return STATUS_OK;
}

void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count)
{
    static const char *const response[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int i = 0; i < count; i++) {
        const int row = entries[i][0], column = entries[i][1];
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "C_%s_%s", response[row], load[column]);
        scene_quantity *q = scene_add_quantity(s, name, scene_compliance_unit(row, column),
                                               analysis, scene_compliance_entry(row, column));
        q->least_order = 1.8;
    }
}
