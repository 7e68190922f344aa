/* Fork-ended column of an unsymmetric, branched thin-walled section under an axial force at the
 * centroid: buckling load, and natural frequencies of the loaded column.  Closed form: one
 * half-wave at a time (reference/derive/column.py). */
#include "cases/case.h"
#include "cases/shared/forks.h"
#include "cases/shared/frequencies.h"

#include <stddef.h>

enum { LENGTH, YOUNG, SHEAR_MODULUS, DENSITY, SHEAR, SHEAR_STABILITY, ROTARY_INERTIA, AXIAL_LOAD };
enum { FREQUENCIES = 6 };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 3.0, 1e-6, 1e6, NULL, "length of the column"},
    [YOUNG] = {"young", "Pa", 210e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [SHEAR_MODULUS] = {"shear_modulus", "Pa", 80e9, 1e-6, 1e15, NULL, "shear modulus"},
    [DENSITY] = {"density", "kg/m^3", 7850.0, 1e-9, 1e9, NULL, "density"},
    [SHEAR] = {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"},
    [SHEAR_STABILITY] = {"shear_stability", "", 0, 0, 0, "engesser|haringx",
                         "theory of shear in stability"},
    [ROTARY_INERTIA] = {"rotary_inertia", "1", 1, 0, 1, NULL,
                        "1: rotary and warping inertia, 0: translations and twist only"},
    [AXIAL_LOAD] = {"axial_load", "N", 5000.0, -1e9, 1e9, NULL,
                    "compression under which the column vibrates"},
    {0},
};

/* Five points, four walls of different thickness [m]. */
static void branched_section(const double value[], section_spec *spec)
{
    static const double point[5][2] = {{0, 0}, {0.05, 0}, {0.05, 0.08}, {0.02, 0.08}, {0.05, 0.1}};
    static const int ends[4][2] = {{0, 1}, {1, 2}, {2, 3}, {2, 4}};
    static const double thickness[4] = {0.002, 0.003, 0.004, 0.001};
    *spec = section_spec_walls(value[YOUNG], value[SHEAR_MODULUS], 4, point, ends, thickness);
    spec->density = value[DENSITY];
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    section_spec spec;
    branched_section(value, &spec);
    const double load = value[AXIAL_LOAD] != 0 ? value[AXIAL_LOAD] : 1;
    int ends[2];
    forks_column(s, &spec, value[LENGTH], ends);
    scene_add_load(s, SCENE_FORCE, ends[1], -load, 0, 0);
    s->shear_theory = value[SHEAR_STABILITY] == 0 ? SCENE_SHEAR_ENGESSER : SCENE_SHEAR_HARINGX;
    scene_omit(s, FEATURE_WAGNER_MOMENTS | (value[SHEAR] == 0 ? FEATURE_SHEAR : 0) |
                      (value[ROTARY_INERTIA] == 0 ? FEATURE_ROTARY_INERTIA : 0));

    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_quantity *critical = scene_add_quantity(s, "buckling_load", "N", buckling,
                                                  scene_critical_factor(load > 0 ? 1 : -1, 0));
    critical->factor = load;
    critical->least_order = 1.8;
    const int loading = scene_add_linear(s),
              modal = scene_add_modal(s, value[AXIAL_LOAD] != 0 ? loading : SCENE_NONE);
    frequencies_add(s, "frequency", modal, SCENE_NOT_AXIAL, FREQUENCIES);
    scene_meshes_doubled(s, 2, 64);
    return STATUS_OK;
}

const case_type case_unsymmetric_column = {
    .name = "unsymmetric_column",
    .summary =
        "fork-ended column of an unsymmetric section: buckling load, frequencies under axial load",
    .source = "closed form of the thin-walled column, one half-wave at a time",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
