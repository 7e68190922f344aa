/* Frame of Lee: a column and a beam, both 120 m long, joined rigidly and hinged at their far ends,
 * under a force on the beam at a fifth of its length from the corner. The path snaps through and,
 * in the deflection of the loaded point, back. */
#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"

enum { PLANE, STEP };

static const parameter_type parameters[] = {
    [PLANE] = {"plane", "1", 1, 0, 1, NULL,
               "1: too stiff to leave its plane, 0: equal stiffness all round, the frame buckles "
               "out of its plane"},
    [STEP] = {"step", "1", 0.02, 1e-4, 0.2, NULL, "first step of the arc"},
    {0},
};

static const double length = 120, load_at = 24; /* [m] */

static int profile_of(int plane, scene *s)
{
    section_spec spec = section_spec_constants(720, 720 / 2.6);
    section *c = &spec.constants;
    c->A = 6;
    c->Iy = 2; /* in the plane */
    c->Iz = plane ? 2e6 : 2;
    c->Ip = c->Iy + c->Iz;
    c->It = plane ? 2e6 : 2.6;
    scene_omit(s, FEATURE_TRAPEZE);
    return scene_add_section(s, &spec);
}

static int hinge(scene *s, double x, double y)
{
    const int node = scene_add_node(s, x, y, 0);
    scene_hold(s, node, SCENE_UX, SCENE_RY);
    return node;
}

static void add_quantities(int plane, scene *s, int path, int node)
{
    static const char *const name[] = {"limit_load", "limit_load_back"},
                             *const at[] = {"deflection_at_limit", "deflection_at_limit_back"};
    for (int i = 0; i < 4; i++) {
        scene_quantity *q =
            scene_add_quantity(s, i < 2 ? name[i] : at[i - 2], i < 2 ? "N" : "m", path,
                               scene_critical_point(SCENE_LIMIT_POINT, i % 2,
                                                    i < 2 ? SCENE_LOAD_FACTOR : SCENE_CONTROL));
        q->factor = i < 2 ? 1 : -1;
        q->least_order = 1.8;
    }
    if (!plane)
        scene_add_quantity(s, "bifurcation_load", "N", path,
                           scene_critical_point(SCENE_BIFURCATION, 0, SCENE_LOAD_FACTOR))
            ->least_order = 1.8;
    scene_set_curve(scene_add_quantity(s, "curve", "N", path, scene_factor_at()), "deflection", "m",
                    -1, 0);
    scene_set_curve(
        scene_add_quantity(s, "sway_curve", "m", path, scene_coordinate(node, SCENE_UX)),
        "deflection", "m", -1, 0);
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double across[3] = {0, 0, 1};
    const int profile = profile_of(value[PLANE] != 0, s);
    const int foot = hinge(s, 0, 0), corner = scene_add_node(s, 0, length, 0),
              loaded = scene_add_node(s, load_at, length, 0), end = hinge(s, length, length);
    scene_add_member(s, foot, corner, profile, across);
    scene_add_member(s, corner, loaded, profile, across);
    scene_add_member(s, loaded, end, profile, across);
    scene_add_load(s, SCENE_FORCE, loaded, 0, -1, 0);

    const double far = -90;
    const int path = scene_add_continuation(s, 1, &far,
                                            (scene_control){.node = loaded,
                                                            .component = SCENE_UY,
                                                            .by_arc = 1,
                                                            .step = value[STEP],
                                                            .step_max = 5 * value[STEP]});
    add_quantities(value[PLANE] != 0, s, path, loaded);
    scene_meshes_doubled(s, 4, value[PLANE] != 0 ? 64 : 32);
    return STATUS_OK;
}

const case_type case_lee_frame = {
    .name = "lee_frame",
    .summary = "frame of Lee: snap-through and snap-back between two limit points",
    .source = "Lee, Manuel and Rossow, J. Eng. Mech. Div. ASCE 94 (1968); exact limit points "
              "(reference/derive/lee_frame.py)",
    .parameters = {parameters, case_omit},
    .build = build,
};
