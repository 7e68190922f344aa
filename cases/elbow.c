/* A right-angled cantilever whose elbow is pushed out of its plane and let go. */
#include <stddef.h>

#include "cases/shared/timed.h"

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 1, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.05, "twenty for each second", 1e-3),
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    (void)f;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 1e6, .GA = 1e6, .GJ = 1e3, .EI = 1e3, .mass = 1, .polar = 20, .rotary = 10});
    static const double across[] = {-1, 0, 0};
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              elbow = scene_add_node(s, 10, 0, 0), tip = scene_add_node(s, 10, 10, 0);
    scene_add_member(s, root, elbow, profile, y_axis);
    scene_add_member(s, elbow, tip, profile, across);
    scene_hold_all(s, root);
    const int force = scene_add_load(s, SCENE_FORCE, elbow, 0, 0, 1);
    scene_load_piece(s, force, 1, "50*t");
    scene_load_piece(s, force, 2, "100 - 50*t");
    scene_load_piece(s, force, 0, "0");
    const int motion = timed_add(s, value, SCENE_NONE);
    timed_places(s, motion, tip, 1, (const char *const[]){"tip_x", "tip_y", "tip_z"});
    timed_places(s, motion, elbow, 1, (const char *const[]){"elbow_x", "elbow_y", "elbow_z"});
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    return STATUS_OK;
}

const case_type case_elbow = {
    .name = "elbow",
    .summary = "a right-angled cantilever whose elbow is pushed out of its plane",
    .source = "after J.C. Simo, L. Vu-Quoc (1988)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
