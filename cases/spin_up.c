/* A beam that is spun up about an axis through its root (after T.R. Kane, R.R. Ryan, A.K. Banerjee
 * 1987 and J.C. Simo, L. Vu-Quoc 1986): seen from its root it lags behind, swings back and stays
 * stretched. */
#include <stddef.h>

#include "cases/shared/timed.h"

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 5, 0, 30, NULL, "when it is looked at"},
    TIMED_HOW(0.025, "a hundredth of the first period", 1e-5),
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    const section_spec spec = timed_profile(&(timed_section){.EA = 2.8e7,
                                                             .GA = 1e7,
                                                             .GJ = 1e4,
                                                             .EI = 1.4e4,
                                                             .mass = 1.2,
                                                             .polar = 12e-4,
                                                             .rotary = 6e-4});
    (void)f;
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, 10, 0, 0);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold(s, root, SCENE_UX, SCENE_RY);
    const int turn = scene_add_moving_driver(s, "turn");
    scene_drive_piece(s, turn, 15, "0.4*(t^2/2 + (7.5/pi)^2*(cos(2*pi*t/15) - 1))");
    scene_drive_piece(s, turn, 0, "6*t - 45");
    scene_drive(s, root, SCENE_RZ, turn);
    const double end = 1;
    const int steady = scene_add_static(s, 1, &end, 1);
    scene_set_rotating_frame(s, steady, (scene_rotating_frame){.omega = {0, 0, 6}});
    scene_add_quantity(s, "steady_stretch", "m", steady, scene_coordinate(tip, SCENE_UX));
    const int motion = timed_add(s, value, SCENE_NONE);
    for (int i = 0; i < 3; i++) {
        static const struct {
            const char *name, *unit;
            int component;
            double size;
        } seen[] = {{"tip_u1", "m", SCENE_UX, 1e-3},
                    {"tip_u2", "m", SCENE_UY, 0.1},
                    {"tip_rotation", "rad", SCENE_RZ, 0.01}};
        scene_add_quantity(s, seen[i].name, seen[i].unit, motion,
                           scene_relative_to(tip, seen[i].component, root))
            ->near_zero = seen[i].size;
    }
    scene_meshes_doubled(s, 2, 32);
    return STATUS_OK;
}

const case_type case_spin_up = {
    .name = "spin_up",
    .summary = "a beam spun up about an axis through its root",
    .source = "after T.R. Kane et al. (1987); J.C. Simo, L. Vu-Quoc (1986)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
