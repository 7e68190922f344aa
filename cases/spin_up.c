/* A beam that is spun up about an axis through its root (after T.R. Kane, R.R. Ryan, A.K. Banerjee
 * 1987 and J.C. Simo, L. Vu-Quoc 1986): seen from its root it lags behind, swings back and stays
 * stretched. */
#include <stddef.h>

#include "cases/shared/timed.h"

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 7.5, 0, 30, NULL, "when it is looked at"},
    TIMED_HOW(0.025, "a hundredth of the first period"),
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
    const int motion = timed_add(s, value, SCENE_NONE);
    scene_add_quantity(s, "tip_u1", "m", motion, scene_relative_to(tip, SCENE_UX, root));
    scene_add_quantity(s, "tip_u2", "m", motion, scene_relative_to(tip, SCENE_UY, root));
    scene_add_quantity(s, "tip_rotation", "rad", motion, scene_relative_to(tip, SCENE_RZ, root));
    return STATUS_OK;
}

const case_type case_spin_up = {
    .name = "spin_up",
    .summary = "a beam spun up about an axis through its root",
    .source = "after T.R. Kane et al. (1987); J.C. Simo, L. Vu-Quoc (1986)",
    .parameters = {parameters},
    .build = build,
};
