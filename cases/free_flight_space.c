/* A flexible rod that a force and a moment throw and that then flies freely in space. */
#include <stddef.h>

#include "cases/shared/thrown.h"

enum { STIFFENING = TIMED_PARAMETERS };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 1, 0, 100, NULL, "when it is looked at"},
    TIMED_HOW(0.05, "a sixth of the quickest motion", 5e-4),
    [STIFFENING] = {"stiffening", "1", 1, 1, 1e6, NULL, "of elongation and shear"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const char *const at_A[] = {"A_x", "A_y", "A_z"}, *const at_B[] = {"B_x", "B_y", "B_z"};
    (void)f;
    const thrown rod = thrown_add(s, &(thrown_rod){.stiffening = value[STIFFENING],
                                                   .bending = 500,
                                                   .A = {0, 0, 8},
                                                   .y = {0, 1, 0},
                                                   .force = {0.1, 0, 0},
                                                   .moment = {0, 1, 0.5}});
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, rod.load[i], 2.5, "80*t");
        scene_load_piece(s, rod.load[i], 5, "400 - 80*t");
        scene_load_piece(s, rod.load[i], 0, "0");
    }
    const int motion = timed_add(s, value, SCENE_NONE);
    timed_places(s, motion, rod.A, 1, at_A);
    timed_places(s, motion, rod.B, 1, at_B);
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    static const char *const momentum[] = {"px", "py", "pz", "Lx", "Ly", "Lz"};
    for (int i = 0; i < 6; i++) {
        scene_quantity *q = scene_add_quantity(s, momentum[i], i < 3 ? "kg m/s" : "kg m^2/s",
                                               motion, scene_balance_of(SCENE_PX + i));
        q->near_zero = i < 3 ? 1 : 10;
    }
    return STATUS_OK;
}

const case_type case_free_flight_space = {
    .name = "free_flight_space",
    .summary = "a flexible rod thrown by a force and a moment flies freely in space",
    .source = "after J.C. Simo, L. Vu-Quoc (1988)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
