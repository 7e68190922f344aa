/* The 45-degree bend: a cantilever along an arc of radius 100, loaded at its tip across the arc's
 * plane. Bathe and Bolourchi (1979); 1 x 1 square section, E = 1e7, nu = 0 (units of the source
 * taken as SI). */
#include "cases/case.h"

#include <math.h>
#include <stddef.h>

enum { FORCE, TORSION };

static const parameter_type parameters[] = {
    [FORCE] = {"force", "N", 600.0, -1e4, 1e4, NULL, "dead tip force across the plane of the arc"},
    [TORSION] = {"torsion", "", 0, 0, 0, "exact|polar",
                 "exact: J of the square and k = 5/6; polar: J = 1/6 and k = 1, as published tip "
                 "positions need"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double radius = 100, angle = 0.78539816339744830962, side = 1;
    const int polar = value[TORSION] != 0;
    section_spec spec = section_spec_rectangle(1e7, 5e6, side, side);
    spec.shear_factor[0] = spec.shear_factor[1] = polar ? 1 : 5.0 / 6;
    spec.given.Iw = 0; /* uniform torsion */
    if (polar)
        spec.given.It = 1.0 / 6;
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0);
    const int tip =
        scene_add_node(s, radius * sin(angle), 2 * radius * sin(angle / 2) * sin(angle / 2), 0);
    scene_member_at(s, scene_add_member(s, root, tip, profile, y_axis))->curvature[2] = 1 / radius;
    scene_hold_all(s, root);
    scene_add_load(s, SCENE_FORCE, tip, 0, 0, value[FORCE]);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);

    const double end = 1;
    const int path = scene_add_static(s, 1, &end, 1);
    static const char *const name[3] = {"u_tangent", "u_radial", "u_load"};
    for (int i = 0; i < 3; i++) {
        scene_quantity *q = scene_add_quantity(s, name[i], "m", path, scene_coordinate(tip, i));
        q->least_order = 1.8;
    }
    scene_meshes_doubled(s, 1, 32);
    return STATUS_OK;
}

const case_type case_bend_45 = {
    .name = "bend_45",
    .summary = "45-degree bend under a force across its plane",
    .source = "Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979); exact Simo-Reissner beam",
    .parameters = {parameters, case_omit},
    .build = build,
};
