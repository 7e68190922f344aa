/* Flexure-based hexapod with six cranks, six rods, twelve spherical flexure joints, and a platform
 * that moves along z. The quantity is the support stiffness along z with the cranks fixed (N
 * section 4.3, Fig. 10). The paper does not state the dimensions, which are therefore synthetic. */
#include <stddef.h>
#include <stdio.h>

#include "cases/shared/shared.h"

enum { STROKE = HEXAPOD_PARAMETERS, STEPS };
enum { MAX_STEPS = 101 };

static const parameter_type parameters[] = {
    {"stroke", "m", 0.05, 0, 1e2, NULL, "the platform moves from -stroke to +stroke"},
    {"steps", "1", 11, 2, MAX_STEPS, NULL, "number of positions of the platform"},
    {0},
};

static void add_stiffnesses(scene *s, int compliance, const double station[], int steps)
{
    for (int i = 0; i <= steps; i++) {
        char name[SCENE_NAME] = "support_stiffness_curve";
        if (i < steps)
            snprintf(name, sizeof name, "support_stiffness_%d", i + 1);
        scene_quantity *q =
            scene_add_quantity(s, name, "N/m", compliance, scene_stiffness_entry(SCENE_UZ));
        q->least_order = 1.5;
        if (i < steps)
            scene_set_at(q, station[i]);
        else
            scene_set_curve(q, "position", "1", 1, 0);
    }
}

static status build(const double value[], scene *s, fault *f)
{
    int profile;
    hexapod_leg legs[HEXAPOD_LEGS];
    const int platform = hexapod_platform(value, s);
    const int steps = (int)value[STEPS];
    double station[MAX_STEPS + 1], height[MAX_STEPS + 1];
    for (int k = 0; k <= steps; k++) {
        station[k] = k;
        height[k] = k == 0 ? 0 : value[STROKE] * (2.0 * (k - 1) / (steps - 1) - 1);
    }
    const int lift = scene_add_driver(s, "platform_height", steps + 1, station, height);
    scene_drive(s, platform, SCENE_UZ, lift);
    const int angle = scene_add_unknown_driver(s, "crank_angle", platform, SCENE_UZ, lift);
    TRY(hexapod_add(value, s, angle, platform, &profile, legs, f));

    const int lifting = scene_add_static(s, steps, station + 1, 1);
    /* the prescribed height is released, and the cranks keep their angles */
    const int compliance = scene_add_compliance(
        s, lifting, (scene_compliance){.node = platform, .released = 1u << SCENE_UZ});
    add_stiffnesses(s, compliance, station + 1, steps);
    scene_add_quantity(s, "crank_angle", "rad", lifting, scene_driver_value(angle));
    scene_meshes_doubled(s, 1, 8);
    return STATUS_OK;
}

const case_type case_hexapod = {
    .name = "hexapod",
    .summary = "flexure hexapod of twelve spherical joints: support stiffness along its stroke",
    .source = "N, section 4.3, Fig. 10; synthetic dimensions",
    .parameters = {joint_parameters, hexapod_parameters, parameters, case_omit},
    .build = build,
};
