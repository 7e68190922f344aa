/* A cantilever that is held aside by a small force at its tip and let go: linear vibration.
 * Bernoulli: L = 1 m, EI = 1 N m^2, 1 kg/m, so that the time is in sqrt(rho A L^4/EI). Timoshenko:
 * steel, 1 m long, 0.1 m high in the plane of motion and 0.05 m wide, with rotary inertia. Its tip
 * may carry a body without size. */
#include <stddef.h>

#include "cases/shared/cantilever.h"
#include "cases/shared/frequencies.h"
#include "cases/shared/timed.h"

enum { MODEL = TIMED_PARAMETERS, AMPLITUDE, AXIAL, BODY };
enum { BERNOULLI, TIMOSHENKO };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 0.25, 0, 1e9, NULL, "when it is looked at"},
    TIMED_HOW(0.01, "a hundredth of the first period", 2e-4),
    [MODEL] = {"model", "", BERNOULLI, 0, 0, "bernoulli|timoshenko",
               "rigid in shear without rotary inertia, or flexible with it"},
    [AMPLITUDE] = {"amplitude", "m", 1e-5, 1e-7, 1e-2, NULL, "deflection of the tip at the begin"},
    [AXIAL] = {"axial", "1", 1e6, 1, 1e15, NULL, "EA L^2/EI of Bernoulli's beam"},
    [BODY] = {"body", "1", 0, 0, 1e15, NULL, "mass at the tip in masses of the beam"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static double add_beam(const double value[], scene *s, int *tip)
{
    const double E = 200e9, A = 0.1 * 0.05, I = 0.05 * 0.1 * 0.1 * 0.1 / 12;
    const cantilever_stiffness thin = {.EA = value[AXIAL],
                                       .GJ = 1,
                                       .EI = 1,
                                       .density = 1 / value[AXIAL]},
                               thick = {.EA = E * A,
                                        .GA = E / 2.6 * A * 5 / 6,
                                        .GJ = E * I,
                                        .EI = E * I,
                                        .density = 7800 / E},
                               *k = value[MODEL] == BERNOULLI ? &thin : &thick;
    int root;
    cantilever_build(1, k, s, &root, tip);
    if (value[BODY] > 0)
        scene_set_body(s, *tip, (scene_body){.mass = value[BODY] * k->density * k->EA});
    return 1 / (1 / (3 * k->EI) + (k->GA > 0 ? 1 / k->GA : 0));
}

static status build(const double value[], scene *s, fault *f)
{
    int tip;
    (void)f;
    const double stiffness = add_beam(value, s, &tip), force = stiffness * value[AMPLITUDE];
    scene_load_piece(s, scene_add_load(s, SCENE_FORCE, tip, 0, force, 0), 0, "0");
    frequencies_add(s, "frequency", scene_add_modal(s, SCENE_NONE), SCENE_BENDING_Z, 3);
    const int held = cantilever_path(s),
              motion = timed_add_started(s, value, held, (scene_start){.velocity = {0}});
    cantilever_quantity(s, "flexibility", "m/N", held, tip, SCENE_UY, 1 / force, 0);
    cantilever_quantity(s, "tip", "1", motion, tip, SCENE_UY, 1 / value[AMPLITUDE], 0);
    s->quantity[s->quantities - 1].near_zero = 1;
    if (value[BODY] > 0) {
        scene_quantity *q =
            scene_add_quantity(s, "energy", "1", motion, scene_balance_of(SCENE_ENERGY));
        q->factor = 2 / (force * value[AMPLITUDE]);
    }
    scene_meshes_doubled(s, 6, 48);
    return STATUS_OK;
}

const case_type case_release = {
    .name = "release",
    .summary = "a cantilever is held aside by a small force and let go",
    .source = "exact modes of Bernoulli's and Timoshenko's beam (reference/derive/release.py)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
