/* Flexure hexapod whose six cranks rotate together, smoothly and in a given time, by the angle that
 * lifts the platform through the stroke of N section 4.3. The platform carries a load. The rods and
 * the bodies inside the joints have masses. Dimensions and masses are synthetic. */
#include <stddef.h>

#include "cases/shared/shared.h"

enum { CRANK_ANGLE = TIMED_PARAMETERS, DURATION };

static const parameter_type timed[] = {
    [TIMED_TIME] = {"time", "s", 0.25, 0, 100, NULL, "time of the output"},
    TIMED_HOW(0.01, "1/50 of the duration of the drive", 1e-3),
    [CRANK_ANGLE] = {"crank_angle", "rad", 0.2613, -1, 1, NULL,
                     "final angle of the cranks, for a stroke of 50 mm"},
    [DURATION] = {"duration", "s", 0.5, 1e-3, 100, NULL, "duration of the smooth drive"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static scene_body body(double mass, double radius)
{
    const double inertia = 0.4 * mass * radius * radius;
    return (scene_body){.mass = mass, .inertia = {inertia, inertia, inertia}};
}

static status build(const double value[], scene *s, fault *f)
{
    static const char *const name[] = {"platform_x", "platform_y", "platform_z"};
    const double *const how = value + HEXAPOD_PARAMETERS;
    hexapod_leg legs[HEXAPOD_LEGS];
    int profile = 0;
    const int platform = hexapod_platform(value, s),
              angle = timed_driver(s, how[CRANK_ANGLE], how[DURATION]);
    TRY(hexapod_add(value, s, angle, platform, &profile, legs, f));
    s->section[profile].density = 7800;
    scene_omit(s, FEATURE_ROTARY_INERTIA);
    scene_set_body(s, platform, body(5, 0.1));
    for (int i = 0; i < HEXAPOD_LEGS; i++) {
        scene_set_body(s, legs[i].rod, body(0.5, 0.1));
        for (int k = 0; k < 2; k++)
            scene_set_body(s, legs[i].joint[k], body(0.1, 0.03));
    }
    const int motion = timed_add(s, how, SCENE_NONE, (scene_start){.velocity = {0}});
    timed_places(s, motion, platform, 0.1, name);
    scene_add_quantity(s, "platform_turn", "rad", motion, scene_coordinate(platform, SCENE_RZ))
        ->near_zero = 0.01;
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 1, 2);
    return STATUS_OK;
}

const case_type case_hexapod_motion = {
    .name = "hexapod_motion",
    .summary = "flexure hexapod of twelve spherical joints, moved through its stroke by a drive",
    .source = "after N, section 4.3, with dimensions, masses and a duration chosen here",
    .parameters = {joint_parameters, hexapod_parameters, timed, case_mass_omit},
    .build = build,
};
