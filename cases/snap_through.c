/* Shallow frame of two hinged bars (von Mises) under a force at its apex: snap-through with two
 * limit points.
 *
 * Half of it: the bar of length L at the angle a, the apex guided. With N = EA (1 - cos a0/cos a),
 * F = 2 N sin a: the force has its extrema +-2 EA (1 - cos^(2/3) a0)^(3/2) at cos^3 a = cos a0. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"

enum { ANGLE, CONTROL, STEP };

static const parameter_type parameters[] = {
    [ANGLE] = {"angle", "rad", 0.3, 0.01, 1.5, NULL, "inclination of the bars"},
    [CONTROL] = {"control", "", 0, 0, 0, "arc|displacement",
                 "what is given along the path: the arc or the apex's deflection"},
    [STEP] = {"step", "1", 0.02, 1e-5, 1, NULL,
              "first step: of the arc, or of the deflection over the length"},
    {0},
};

static int stiff_bar(scene *s)
{
    section_spec spec = section_spec_constants(1, 1);
    /* EA = 1 N; bending so stiff that the bar does not buckle. */
    section *c = &spec.constants;
    c->A = c->Iy = c->Iz = c->It = 1;
    c->Ip = 2;
    scene_omit(s, FEATURE_TRAPEZE);
    return scene_add_section(s, &spec);
}

static void add_quantities(scene *s, int path, double height)
{
    static const char *const name[] = {"limit_load", "limit_load_back"};
    for (int i = 0; i < 2; i++)
        scene_add_quantity(s, name[i], "N", path,
                           scene_critical_point(SCENE_LIMIT_POINT, i, SCENE_LOAD_FACTOR));
    scene_add_quantity(s, "deflection_at_limit", "m", path,
                       scene_critical_point(SCENE_LIMIT_POINT, 0, SCENE_CONTROL))
        ->factor = -1;
    scene_set_at(scene_add_quantity(s, "load_inverted", "N", path, scene_factor_at()),
                 -2.5 * height);
    scene_set_curve(scene_add_quantity(s, "curve", "N", path, scene_factor_at()), "deflection", "m",
                    -1, 0);
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double height = sin(value[ANGLE]), y_axis[3] = {0, 0, 1};
    const int profile = stiff_bar(s);
    const int base = scene_add_node(s, -cos(value[ANGLE]), 0, 0),
              apex = scene_add_node(s, 0, height, 0);
    scene_add_member(s, base, apex, profile, y_axis);
    scene_hold(s, base, SCENE_UX, SCENE_RY);
    scene_hold(s, apex, SCENE_UX, SCENE_UX);
    scene_hold(s, apex, SCENE_UZ, SCENE_RY);
    scene_add_load(s, SCENE_FORCE, apex, 0, -0.5, 0);

    const double end = -2.5 * height;
    const int path = scene_add_continuation(s, 1, &end,
                                            (scene_control){.node = apex,
                                                            .component = SCENE_UY,
                                                            .by_arc = value[CONTROL] == 0,
                                                            .step = value[STEP],
                                                            .step_max = 5 * value[STEP]});
    add_quantities(s, path, height);
    scene_meshes_doubled(s, 1, 8);
    return STATUS_OK;
}

const case_type case_snap_through = {
    .name = "snap_through",
    .summary = "shallow frame of two hinged bars: snap-through with two limit points",
    .source = "closed form of the frame of von Mises",
    .parameters = {parameters, case_omit},
    .build = build,
};
