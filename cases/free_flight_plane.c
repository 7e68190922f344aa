/* A flexible rod that a force and a moment at one end throw and that then flies freely in its plane
 * (after J.C. Simo, L. Vu-Quoc 1986).  Their load is a step, whose moment sends a jump of curvature
 * along the rod: meshes follow it slowly.  The smooth load has the same impulse. */
#include <stddef.h>

#include "cases/shared/timed.h"

enum { LOAD = TIMED_PARAMETERS, STIFFENING };
enum { SMOOTH, STEP };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 1, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.05, "a sixth of the quickest motion", 1e-4),
    [LOAD] = {"load", "", SMOOTH, 0, 0, "smooth|step", "how it comes and goes"},
    [STIFFENING] = {"stiffening", "1", 1, 1, 1e6, NULL, "of elongation and shear"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {4, 3, 0};
    (void)f;
    const double k = value[STIFFENING];
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 1e4 * k, .GA = 1e4 * k, .GJ = 100, .EI = 100, .mass = 1, .polar = 20, .rotary = 10});
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 8, 0),
              B = scene_add_node(s, 6, 0, 0);
    scene_add_member(s, A, B, profile, y_axis);
    const int loads[] = {scene_add_load(s, SCENE_FORCE, B, 8, 0, 0),
                         scene_add_load(s, SCENE_MOMENT, B, 0, 0, -80)};
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, loads[i], 2.5, value[LOAD] == SMOOTH ? "2*sin(pi*t/2.5)^2" : "1");
        scene_load_piece(s, loads[i], 0, "0");
    }
    const int motion = timed_add(s, value, SCENE_NONE);
    timed_places(s, motion, A, 1, (const char *const[]){"A_x", "A_y", NULL});
    timed_places(s, motion, B, 1, (const char *const[]){"B_x", "B_y", NULL});
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_add_quantity(s, "px", "kg m/s", motion, scene_balance_of(SCENE_PX));
    scene_add_quantity(s, "Lz", "kg m^2/s", motion, scene_balance_of(SCENE_LZ));
    scene_meshes_doubled(s, 16, 128);
    return STATUS_OK;
}

const case_type case_free_flight_plane = {
    .name = "free_flight_plane",
    .summary = "a flexible rod thrown by a force and a moment flies freely in its plane",
    .source = "after J.C. Simo, L. Vu-Quoc (1986)",
    .parameters = {parameters},
    .build = build,
};
