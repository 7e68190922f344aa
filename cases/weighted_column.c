/* Buckling of a column, clamped at its foot, under its own weight and a load on its head: one
 * stays, the other grows. L = 1 m, EI = 1 N m^2 in its weak plane. */
#include "cases/case.h"

#include <stddef.h>

enum { GROWS, STAYING };
enum { HEAD, WEIGHT };

static const parameter_type parameters[] = {
    [GROWS] = {"grows", "", HEAD, 0, 0, "head|weight", "the load whose critical value is sought"},
    [STAYING] =
        {"staying", "1", 3.0, -1e3, 7.8, NULL,
         "the other one: q L^3/EI (below 7.837) or P L^2/EI (below 2.467); negative: it pulls"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double y_axis[3] = {0, 1, 0}, zero = 0, one = 1, ends[2] = {0, 1};
    section_spec spec = section_spec_constants(1, 1);
    spec.density = 1e-6; /* 1 kg/m */
    spec.constants.A = 1e6;
    spec.constants.Iy = 3;
    spec.constants.Iz = spec.constants.It = 1;
    spec.constants.Ip = 4;
    const int profile = scene_add_section(s, &spec);
    scene_omit(s, FEATURE_TRAPEZE);
    const int foot = scene_add_node(s, 0, 0, 0), head = scene_add_node(s, 0, 0, 1);
    const int column = scene_add_member(s, foot, head, profile, y_axis);
    scene_hold_all(s, foot);
    const double size[] = {[HEAD] = value[GROWS] == HEAD ? 1 : value[STAYING],
                           [WEIGHT] = value[GROWS] == HEAD ? value[STAYING] : 1};
    const int load[] = {[HEAD] = scene_add_load(s, SCENE_FORCE, head, 0, 0, -size[HEAD]),
                        [WEIGHT] = scene_add_load(s, SCENE_GRAVITY, column, 0, 0, -size[WEIGHT])};
    const int grows = (int)value[GROWS];
    scene_set_factor(s, load[grows], 2, ends, ends);
    scene_set_factor(s, load[1 - grows], 1, &zero, &one);
    scene_quantity *q = scene_add_quantity(s, "load_factor", "1", scene_add_buckling(s, SCENE_NONE),
                                           scene_critical_factor(1, 0));
    q->least_order = 1.8;
    scene_meshes_doubled(s, 1, 32);
    return STATUS_OK;
}

const case_type case_weighted_column = {
    .name = "weighted_column",
    .summary = "buckling under weight and a load on the head, of which one stays",
    .source = "Timoshenko and Gere, Theory of Elastic Stability: a bar under its own weight and an "
              "end load",
    .parameters = {parameters, case_omit},
    .build = build,
};
