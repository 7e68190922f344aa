/* States of a cantilever whose exact solution is known: uniform ones, which every mesh should have,
 * and linear ones, which one element may have. */
#include <math.h>

#include "elements/math/pi.h"
#include "harness/certificate/beam.h"
#include "harness/certificate/measured.h"

enum { IRREGULAR = 4 };
static const double fraction[IRREGULAR] = {0.13, 0.37, 0.19, 0.31};

typedef struct state {
    const char *name;
    double thickness, width; /* [m] of a metre */
    int profile;
    unsigned needs;
    beam_analysis analysis;
    scene_load_kind load;
    int direction, component;
} state;

static const state states[] = {
    {"stretch", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 0, SCENE_UX},
    {"pure torsion", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX},
    {"pure bending about y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 1, SCENE_UZ},
    {"pure bending about z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 2, SCENE_UY},
    {"pure bending, a quarter turn", 0.05, 0.1, 0, FEATURE_LARGE, BEAM_LARGE, SCENE_MOMENT, 2,
     SCENE_UY},
    {"tip force along y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 1, SCENE_UY},
    {"tip force along z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 2, SCENE_UZ},
    {"constant shear along y, short", 0.5, 0.5, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 1,
     SCENE_UY},
    {"constant shear along z, short", 0.5, 0.5, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 2,
     SCENE_UZ},
    {"torsion, warping held", 0, 0, 1, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX},
};

/* Of the load's component, and the exact value that it gives. */
static double exact_of(const state *s, const section *c, double load)
{
    const double EIz = c->young * c->Iz, EIy = c->young * c->Iy, GI = c->shear_modulus * c->It;
    const double shear = s->needs & FEATURE_SHEAR ? 1 / c->shear_modulus : 0;
    if (s->profile) {
        const double k = sqrt(GI / (c->young * c->Iw));
        return load / GI * (1 - tanh(k) / k);
    }
    if (s->analysis == BEAM_LARGE) /* an arc of a quarter of a circle */
        return 2 / PI;
    if (s->load == SCENE_FORCE)
        return s->direction == 0   ? load / (c->young * c->A)
               : s->direction == 1 ? load * (1 / (3 * EIz) + shear * c->F[0])
                                   : load * (1 / (3 * EIy) + shear * c->F[4]);
    return s->direction == 0 ? load / GI : s->direction == 1 ? -load / (2 * EIy) : load / (2 * EIz);
}

static void measure_state(const formulation *chosen, const state *s, measures *out)
{
    measure *one = measures_add(out, s->name);
    beam_request r = {.chosen = chosen,
                      .thickness = s->thickness,
                      .width = s->width,
                      .profile = s->profile,
                      .needs = s->needs,
                      .analysis = s->analysis,
                      .load = s->load,
                      .component = s->component};
    section c;
    if (beam_section(&r, &c) != STATUS_OK)
        return;
    const double load = s->analysis == BEAM_LARGE ? c.young * c.Iz * PI / 2 : 1;
    r.vector[s->direction] = load;
    const double exact = exact_of(s, &c, load);
    r.elements = 1;
    if (!beam_point(&r, 1, exact, one))
        return;
    r.elements = IRREGULAR;
    r.fraction = fraction;
    beam_point(&r, IRREGULAR, exact, one);
}

void measured_states(const formulation *chosen, claims *c, measures *out)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++) {
        claims_doing(c, "a cantilever under %s", states[i].name);
        measure_state(chosen, &states[i], out);
    }
}
