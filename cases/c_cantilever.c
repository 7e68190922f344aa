/* C-shaped cantilever under a dead tip force parallel to the web, applied off the shear centre:
 * lateral-torsional deflection far beyond buckling. J section 5.2, Figs. 11-13; the table of
 * section sizes is lost, so both readings of them are offered. Turning: J Eqs. 73, 74 have rotary
 * inertia, hence the centrifugal moments of rotary_inertia=1 (7 % of the force at omega = 20, w =
 * 0.25); whether J's curves of Fig. 13 contain them is not said. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/shared/channel.h"

enum { LENGTH, SIZES, LOAD_POINT, LOAD_HEIGHT, SHEAR, WAGNER, OMEGA, DEFLECTION, STEP, ROTARY };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 9.0, 1e-3, 1e4, NULL, "length of the beam"},
    [SIZES] = {"sizes", "", 0, 0, 0, "overall|centreline",
               "30 x 10 cm are the section's outer sizes, or those of its centre line"},
    [LOAD_POINT] = {"load_point", "", 0, 0, 0, "D|E",
                    "end of the web that carries the force: D top, E bottom"},
    [LOAD_HEIGHT] = {"load_height", "", 0, 0, 0, "corner|edge",
                     "where the web ends: at the corner of the centre line, or at the outer face "
                     "of the flange"},
    [SHEAR] = {"shear", "1", 0, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"},
    [WAGNER] = {"wagner_moments", "1", 0, 0, 1, NULL,
                "1: with int y (y^2 + z^2) dA in the Wagner moments, 0: without, as J"},
    [OMEGA] = {"omega", "rad/s", 0, 0, 1e4, NULL,
               "angular velocity about the vertical axis through the root"},
    [DEFLECTION] = {"w", "m", 0.5, 1e-4, 5, NULL,
                    "deflection of the load point up to which the load is followed"},
    [STEP] = {"step", "m", 0, 0, 5, NULL, "steps of w, all of this size; 0: steps that adapt"},
    [ROTARY] = {"rotary_inertia", "1", 0, 0, 1, NULL,
                "where omega is not 0: 1: centrifugal moments and bimoments of the section too, 0: "
                "forces on the line of centroids"},
    {0},
};

/* Distance of the web's centre line from the centroid, along y [m]. */
static double web_offset(const channel *c)
{
    const double flanges = 2 * c->width * c->flange_thickness,
                 area = flanges + c->height * c->web_thickness;
    return flanges * c->width / 2 / area;
}

static int load_node(const double value[], scene *s, const channel *c, int tip)
{
    const double half = (c->height + (value[LOAD_HEIGHT] != 0 ? c->flange_thickness : 0)) / 2;
    return scene_add_attached(s, tip, value[LENGTH], web_offset(c),
                              value[LOAD_POINT] == 0 ? half : -half);
}

static void add_path(const double value[], scene *s, int node)
{
    const double end = -value[DEFLECTION], step = value[STEP];
    const int loading =
        scene_add_continuation(s, 1, &end,
                               (scene_control){.node = node,
                                               .component = SCENE_UZ,
                                               .step = step > 0 ? step : value[LENGTH] / 900,
                                               .step_max = step > 0 ? step : value[LENGTH] / 20,
                                               .constant_steps = step > 0});
    scene_set_rotating_frame(s, loading, (scene_rotating_frame){.omega = {0, 0, value[OMEGA]}});
    scene_add_quantity(s, "load_at_w", "N", loading, scene_factor_at())->least_order = 1.8;
    scene_add_quantity(s, "lateral", "m", loading, scene_coordinate(node, SCENE_UY))->least_order =
        1.8;
    scene_set_curve(scene_add_quantity(s, "curve", "N", loading, scene_factor_at()), "w", "m", -1,
                    0);
    scene_set_curve(
        scene_add_quantity(s, "lateral_curve", "m", loading, scene_coordinate(node, SCENE_UY)), "w",
        "m", -1, 0);
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const channel c = channel_of_cantilever(value[SIZES] != 0);
    section_spec spec;
    channel_section(&c, &spec);
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, value[LENGTH], 0, 0);
    scene_member_at(s, scene_add_member(s, root, tip, profile, y_axis))->warp_p = SCENE_WARP_FIXED;
    scene_hold_all(s, root);
    const int node = load_node(value, s, &c, tip);
    scene_add_load(s, SCENE_FORCE, node, 0, 0, -1);
    scene_omit(s, FEATURE_WAGNER_TORQUE | (value[SHEAR] == 0 ? FEATURE_SHEAR : 0) |
                      (value[WAGNER] == 0 ? FEATURE_WAGNER_MOMENTS : 0) |
                      (value[ROTARY] == 0 ? FEATURE_ROTARY_INERTIA : 0));
    add_path(value, s, node);
    scene_meshes_doubled(s, 5, 80);
    return STATUS_OK;
}

const case_type case_c_cantilever = {
    .name = "c_cantilever",
    .summary = "C-shaped cantilever under an eccentric tip force, far beyond lateral buckling",
    .source = "J section 5.2, Figs. 11-13",
    .parameters = {parameters, case_omit},
    .build = build,
};
