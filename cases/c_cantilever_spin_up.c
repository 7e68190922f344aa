/* The C-shaped cantilever of J section 5.2, spun up about the vertical axis through its root while
 * its own weight bends and twists it: the line of centroids is not that of shear centres.  No truth
 * is stored: what meshes go to is judged by its own uncertainty. */
#include <stddef.h>
#include <stdio.h>

#include "cases/shared/channel.h"
#include "cases/shared/timed.h"

enum { LENGTH = TIMED_PARAMETERS, SPEED, DURATION };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 0.5, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.01, "a fiftieth of the time of spinning up", 5e-4),
    [LENGTH] = {"length", "m", 9.0, 1e-3, 1e4, NULL, "length of the beam"},
    [SPEED] = {"omega", "rad/s", 1, -1e3, 1e3, NULL, "angular velocity that it comes to"},
    [DURATION] = {"duration", "s", 0.5, 1e-3, 100, NULL, "of spinning up, smoothly"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

/* Its rate rises as 3 s^2 - 2 s^3, s = t/T. */
static void spin(scene *s, int root, double speed, double duration)
{
    char text[200];
    const int turn = scene_add_moving_driver(s, "turn");
    snprintf(text, sizeof text, "%.17g*((t/%.17g)^3 - (t/%.17g)^4/2)", speed * duration, duration,
             duration);
    scene_drive_piece(s, turn, duration, text);
    snprintf(text, sizeof text, "%.17g*(t - %.17g)", speed, duration / 2);
    scene_drive_piece(s, turn, 0, text);
    scene_hold(s, root, SCENE_UX, SCENE_RY);
    scene_drive(s, root, SCENE_RZ, turn);
}

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    static const struct {
        const char *name, *unit;
        int component;
        double size;
    } seen[] = {{"tip_u1", "m", SCENE_UX, 0.01},
                {"tip_u2", "m", SCENE_UY, 0.1},
                {"tip_u3", "m", SCENE_UZ, 0.1},
                {"tip_twist", "rad", SCENE_RX, 0.01}};
    (void)f;
    const channel c = channel_of_cantilever(0);
    section_spec spec;
    channel_section(&c, &spec);
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, value[LENGTH], 0, 0),
              member = scene_add_member(s, root, tip, profile, y_axis);
    scene_member_at(s, member)->warp_p = SCENE_WARP_FIXED;
    scene_omit(s, FEATURE_WAGNER_TORQUE); /* as J */
    spin(s, root, value[SPEED], value[DURATION]);
    scene_add_load(s, SCENE_GRAVITY, member, 0, 0, -9.81);
    const int motion = timed_add(s, value, SCENE_NONE);
    for (int i = 0; i < 4; i++)
        scene_add_quantity(s, seen[i].name, seen[i].unit, motion,
                           scene_relative_to(tip, seen[i].component, root))
            ->near_zero = seen[i].size;
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 2, 16);
    return STATUS_OK;
}

const case_type case_c_cantilever_spin_up = {
    .name = "c_cantilever_spin_up",
    .summary = "C-shaped cantilever under its weight, spun up about the vertical axis at its root",
    .source = "after J section 5.2; time and speed are ours",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
