/* Pinned column of a solid square section: shear in stability after Engesser and after Haringx.
 * Engesser P_E/(1 + P_E/GA_s), Haringx GA_s (sqrt(1 + 4 P_E/GA_s) - 1)/2, with A_s = 5/6 A. */
#include "cases/case.h"

#include <stddef.h>

enum { LENGTH, SIDE, YOUNG, SHEAR_MODULUS, SHEAR_STABILITY };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 1.0, 1e-6, 1e6, NULL, "length of the column"},
    [SIDE] = {"side", "m", 0.02, 1e-9, 1e3, NULL, "side of the square"},
    [YOUNG] = {"young", "Pa", 70e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [SHEAR_MODULUS] = {"shear_modulus", "Pa", 27e9, 1e-6, 1e15, NULL, "shear modulus"},
    [SHEAR_STABILITY] = {"shear_stability", "", 0, 0, 0, "engesser|haringx",
                         "theory of shear in stability"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    section_spec spec =
        section_spec_rectangle(value[YOUNG], value[SHEAR_MODULUS], value[SIDE], value[SIDE]);
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0;
    const int profile = scene_add_section(s, &spec);
    const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0};
    const int foot = scene_add_node(s, 0, 0, 0), head = scene_add_node(s, value[LENGTH], 0, 0);
    scene_add_member(s, foot, head, profile, y_axis);
    scene_hold(s, foot, SCENE_UX, SCENE_UZ);
    scene_hold(s, head, SCENE_UY, SCENE_UZ);
    scene_fork(s, foot, x_axis, y_axis);
    scene_fork(s, head, x_axis, y_axis);
    scene_add_load(s, SCENE_FORCE, head, -1, 0, 0);
    scene_need(s,
               FEATURE_SHEAR | (value[SHEAR_STABILITY] == 0 ? FEATURE_ENGESSER : FEATURE_HARINGX));
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_quantity *load =
        scene_add_quantity(s, "buckling_load", "N", buckling, scene_critical_factor(1, 0));
    load->least_order = 1.8;
    const int meshes[] = {2, 4, 8, 16, 32};
    scene_meshes(s, 5, meshes);
    return STATUS_OK;
}

const case_type case_shear_column = {
    .name = "shear_column",
    .summary = "pinned column, flexible in shear: Engesser against Haringx",
    .source = "closed forms of Engesser and Haringx",
    .parameters = {parameters},
    .build = build,
};
