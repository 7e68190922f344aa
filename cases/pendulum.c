/* A rubber rod that swings about a pin under its weight, released from rest. */
#include <stddef.h>

#include "cases/shared/timed.h"

enum { STIFFENING = TIMED_PARAMETERS };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 0.125, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.005, "a hundredth of a swing", 6e-4),
    [STIFFENING] = {"stiffening", "1", 1, 1, 1e6, NULL, "of elongation"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    (void)f;
    const double r = 0.02, young = 5e6, density = 1100, A = 3.14159265358979323846 * r * r,
                 I = A * r * r / 4;
    const section_spec spec = timed_profile(&(timed_section){.EA = young * A * value[STIFFENING],
                                                             .GA = 0.3 * young * A,
                                                             .GJ = 0.6 * young * I,
                                                             .EI = young * I,
                                                             .mass = density * A,
                                                             .polar = 2 * density * I,
                                                             .rotary = density * I});
    const int profile = scene_add_section(s, &spec), pin = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, 1, 0, 0),
              member = scene_add_member(s, pin, tip, profile, y_axis);
    scene_hold(s, pin, SCENE_UX, SCENE_RY);
    scene_add_load(s, SCENE_GRAVITY, member, 0, -9.81, 0);
    const int motion = timed_add(s, value, SCENE_NONE);
    timed_places(s, motion, tip, 1, (const char *const[]){"tip_x", "tip_y", NULL});
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 8, 64);
    return STATUS_OK;
}

const case_type case_pendulum = {
    .name = "pendulum",
    .summary = "a rubber rod swings about a pin under its weight",
    .source = "equations of Simo and Reissner, solved twice (reference/truths)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
