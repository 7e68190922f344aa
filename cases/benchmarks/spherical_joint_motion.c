/* Spherical flexure joint whose end effector is tilted about the x axis in a given time and then
 * stops. A body with a tenth of the mass of the effector is free between the two sets of sheets.
 * The case is based on N section 4.2, where the motion is quasi-static. The masses are
 * synthetic. */
#include "cases/shared/shared.h"

#include <stddef.h>

enum { TILT = TIMED_PARAMETERS, DURATION };

static const parameter_type timed[] = {
    [TIMED_TIME] = {"time", "s", 0.25, 0, 100, NULL, "time of the output"},
    TIMED_HOW(0.01, "1/50 of the duration of the drive", 1e-4),
    [TILT] = {"tilt", "rad", 15 * JOINT_DEGREE, 0, 1, NULL, "rotation of the end effector"},
    [DURATION] = {"duration", "s", 0.5, 1e-3, 100, NULL, "duration of the smooth drive"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static scene_body ball(double mass, double radius)
{
    const double inertia = 0.4 * mass * radius * radius;
    return (scene_body){.mass = mass, .inertia = {inertia, inertia, inertia}};
}

static int add_joint(const double value[], scene *s, int effector, fault *f, status *outcome)
{
    static const double centre[3] = {0, 0, 0}, axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int profile = 0;
    *outcome = joint_prepare(value, s, &profile, f);
    if (*outcome != STATUS_OK)
        return SCENE_NONE;
    s->section[profile].density = 7800;
    scene_omit(s, FEATURE_ROTARY_INERTIA);
    const int base = scene_add_node(s, 0, 0, 0);
    scene_hold_all(s, base);
    return joint_add(value, s, profile, centre, axes, base, effector);
}

static status build(const double value[], scene *s, fault *f)
{
    static const char *const place[] = {"shift_x", "shift_y", "shift_z"};
    const double *const how = value + JOINT_PARAMETERS;
    status outcome;
    const int effector = scene_add_node(s, 0, 0, 0),
              body = add_joint(value, s, effector, f, &outcome);
    TRY(outcome);
    scene_set_body(s, effector, ball(1, 0.05));
    scene_set_body(s, body, ball(0.1, 0.03));
    scene_drive(s, effector, SCENE_RX, timed_driver(s, how[TILT], how[DURATION]));
    scene_hold(s, effector, SCENE_RY, SCENE_RZ);
    const int motion = timed_add(s, how, SCENE_NONE, (scene_start){.velocity = {0}});
    for (int i = 0; i < 3; i++)
        scene_add_quantity(s, place[i], "m", motion, scene_coordinate(effector, SCENE_UX + i))
            ->near_zero = 1e-3;
    scene_add_quantity(s, "body_tilt", "rad", motion, scene_coordinate(body, SCENE_RX));
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 1, 4);
    return STATUS_OK;
}

const case_type case_spherical_joint_motion = {
    .name = "spherical_joint_motion",
    .summary = "spherical flexure joint that is tilted by a drive within half a second",
    .source = "after N, section 4.2, with masses and a duration chosen here",
    .parameters = {joint_parameters, timed, case_mass_omit},
    .build = build,
};
