/* A cantilever with a rigid body at its end, at rest and turning steadily.  L = 1 m, EI = 1 N m^2,
 * rho A = 1 kg/m, so that frequencies are in sqrt(EI/(rho A L^4)).  The body is symmetric about the
 * beam's axis, about which it has no inertia (a thin rod); its centre of mass is beyond the end.
 * The axis of rotation passes through the root, normal to the beam: flap is motion in the plane of
 * beam and axis, lag across it.  No shear, no rotary inertia of the beam. */
#include <math.h>
#include <stddef.h>

#include "cases/shared/cantilever.h"
#include "cases/shared/frequencies.h"

enum { BODY, OVERHANG, GYRATION, OMEGA };
enum { MODES = 3, SLENDERNESS = 1000 };

static const parameter_type parameters[] = {
    [BODY] = {"body", "1", 1, 0, 1e4, NULL, "mass of the body, over that of the beam"},
    [OVERHANG] = {"overhang", "1", 0.2, -1, 10, NULL,
                  "of the body's centre of mass beyond the end of the beam, in L"},
    [GYRATION] = {"gyration", "1", 0.3, 0, 10, NULL,
                  "the body's radius of gyration about axes across the beam, in L"},
    [OMEGA] = {"omega_star", "1", 4, 0, 1e3, NULL, "angular velocity in sqrt(EI/(rho A L^4))"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double area = (double)SLENDERNESS * SLENDERNESS, path = 1, mass = value[BODY],
                 inertia = mass * value[GYRATION] * value[GYRATION];
    const cantilever_stiffness k = {.EA = area, .GJ = 1, .EI = 1, .density = 1 / area};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    scene_set_body(s, tip,
                   (scene_body){.mass = mass,
                                .centre = {mass > 0 ? value[OVERHANG] : 0, 0, 0},
                                .inertia = {0, inertia, inertia}});
    frequencies_add_angular(s, "rest", scene_add_modal(s, SCENE_NONE), SCENE_BENDING_Z, MODES);
    const int rotation = scene_add_rotation(s, 1, &path, 1, 2 * MODES,
                                            (scene_rotating_frame){.omega = {0, 0, value[OMEGA]}});
    frequencies_add_angular(s, "flap", rotation, SCENE_BENDING_Z, MODES);
    frequencies_add_angular(s, "lag", rotation, SCENE_BENDING_Y, MODES);
    cantilever_turning(s, rotation, root, tip);
    return STATUS_OK;
}

const case_type case_tip_body = {
    .name = "tip_body",
    .summary = "cantilever with a rigid body at its end, at rest and turning steadily: frequencies",
    .source = "exact frequencies of the beam with such an end (reference/derive/tip_body.py)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
