/* Pinned column of a solid square section: shear in stability after Engesser and after Haringx.
 * Engesser P_E/(1 + P_E/GA_s), Haringx GA_s (sqrt(1 + 4 P_E/GA_s) - 1)/2, with A_s = 5/6 A. */
#include "cases/case.h"
#include "cases/shared/forks.h"

#include <stddef.h>

enum { LENGTH, SIDE, YOUNG, SHEAR_MODULUS, SHEAR_STABILITY };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 1.0, 1e-6, 1e6, NULL, "length of the column"},
    [SIDE] = {"side", "m", 0.02, 1e-9, 1e3, NULL, "side of the square"},
    [YOUNG] = {"young", "Pa", 70e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [SHEAR_MODULUS] = {"shear_modulus", "Pa", 27e9, 1e-6, 1e15, NULL, "shear modulus"},
    [SHEAR_STABILITY] = {"shear_stability", "", 0, 0, 0, "engesser|haringx",
                         "theory of shear in stability"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    section_spec spec =
        section_spec_rectangle(value[YOUNG], value[SHEAR_MODULUS], value[SIDE], value[SIDE]);
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0;
    int ends[2];
    forks_column(s, &spec, value[LENGTH], ends);
    scene_add_load(s, SCENE_FORCE, ends[1], -1, 0, 0);
    scene_omit(s, FEATURE_TRAPEZE);
    s->shear_theory = value[SHEAR_STABILITY] == 0 ? SCENE_SHEAR_ENGESSER : SCENE_SHEAR_HARINGX;
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_quantity *load =
        scene_add_quantity(s, "buckling_load", "N", buckling, scene_critical_factor(1, 0));
    load->least_order = 1.8;
    scene_meshes_doubled(s, 2, 32);
    return STATUS_OK;
}

const case_type case_shear_column = {
    .name = "shear_column",
    .summary = "pinned column, flexible in shear: Engesser against Haringx",
    .source = "closed forms of Engesser and Haringx",
    .parameters = {parameters, case_omit},
    .build = build,
};
