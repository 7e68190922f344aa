/* A flexible rod that a force and a moment at one end throw and that then flies freely in its plane
 * (after J.C. Simo, L. Vu-Quoc 1986).  Their load is a step, whose moment sends a jump of curvature
 * along the rod: meshes follow it slowly.  The smooth load has the same impulse. */
#include <stddef.h>

#include "cases/shared/thrown.h"

enum { LOAD = TIMED_PARAMETERS, STIFFENING };
enum { SMOOTH, STEP };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 1, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.05, "a sixth of the quickest motion", 3e-5),
    [LOAD] = {"load", "", SMOOTH, 0, 0, "smooth|step", "how it comes and goes"},
    [STIFFENING] = {"stiffening", "1", 1, 1, 1e6, NULL, "of elongation and shear"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const thrown rod = thrown_add(s, &(thrown_rod){.stiffening = value[STIFFENING],
                                                   .bending = 100,
                                                   .A = {0, 8, 0},
                                                   .y = {4, 3, 0},
                                                   .force = {8, 0, 0},
                                                   .moment = {0, 0, -80}});
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, rod.load[i], 2.5, value[LOAD] == SMOOTH ? "2*sin(pi*t/2.5)^2" : "1");
        scene_load_piece(s, rod.load[i], 0, "0");
    }
    const int motion = timed_add(s, value, SCENE_NONE);
    timed_places(s, motion, rod.A, 1, (const char *const[]){"A_x", "A_y", NULL});
    timed_places(s, motion, rod.B, 1, (const char *const[]){"B_x", "B_y", NULL});
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
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
