/* States of a cantilever whose exact solution is known: uniform ones, which every mesh should have,
 * and linear ones, which one element may have. */
#include <math.h>
#include <stdio.h>

#include "elements/math/pi.h"
#include "harness/experiments/beam.h"
#include "harness/experiments/measured.h"

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
    const char *doubt; /* what is wrong of a linear one that no mesh mends */
} state;

static const state states[] = {
    {"stretch", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 0, SCENE_UX, "E A?"},
    {"pure torsion", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX, "G It?"},
    {"pure bending about y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 1, SCENE_UZ, "E Iy?"},
    {"pure bending about z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 2, SCENE_UY, "E Iz?"},
    {"pure bending, a quarter turn", 0.05, 0.1, 0, FEATURE_LARGE, BEAM_LARGE, SCENE_MOMENT, 2,
     SCENE_UY, ""},
    {"tip force along y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 1, SCENE_UY,
     "E Iz, or does it lock?"},
    {"tip force along z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 2, SCENE_UZ,
     "E Iy, or does it lock?"},
    {"constant shear along y, short", 0.5, 0.5, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 1,
     SCENE_UY, "G A with its shear factor, E Iz?"},
    {"constant shear along z, short", 0.5, 0.5, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 2,
     SCENE_UZ, "G A with its shear factor, E Iy?"},
    {"torsion, warping held", 0, 0, 1, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX, "G It, E Iw?"},
};

/* Of the load's component, and the exact value that it gives. */
static double states_exact_of(const state *s, const section *c, double load)
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

/* An error that more elements leave as it is comes from the section, not from the mesh. */
static void states_conclude(const state *s, element_measure *one)
{
    const double coarse = fabs(one->error[0]), fine = fabs(one->error[1]);
    one->astray = fine > 1e-6 && fine > 0.8 * coarse;
    if (one->astray)
        snprintf(one->words, sizeof one->words,
                 "%.2g %% with one element and %.2g %% with four: a stiffness of the section is "
                 "wrong (%s)",
                 100 * coarse, 100 * fine, s->doubt);
}

static void measure_state(const formulation *chosen, const state *s, measures *out)
{
    element_measure *one = measures_add(out, s->name);
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
    const double exact = states_exact_of(s, &c, load);
    r.elements = 1;
    if (!beam_point(&r, 1, exact, one))
        return;
    r.elements = IRREGULAR;
    r.fraction = fraction;
    beam_point(&r, IRREGULAR, exact, one);
    if (s->analysis == BEAM_LINEAR)
        states_conclude(s, one);
}

/* Where all linear ones are apart by the same power of a thousand: units. */
static void compare_units(measures *out)
{
    double times = NAN;
    for (int i = 0; i < out->count; i++) {
        const element_measure *one = &out->measure[i];
        if (states[i].analysis != BEAM_LINEAR || one->points < 2 || isnan(one->error[1]))
            continue;
        const double here = 1 + one->error[1];
        if (isnan(times))
            times = here;
        if (!(here > 0) || fabs(here / times - 1) > 1e-3)
            return;
    }
    const double thousands = log10(times) / 3;
    if (!(fabs(thousands) > 0.5) || fabs(thousands - round(thousands)) > 1e-3)
        return;
    snprintf(out->words, sizeof out->words, "everything is %.0e times too %s: units?",
             fmax(times, 1 / times), times > 1 ? "soft" : "stiff");
}

void measured_states(const formulation *chosen, claims *c, measures *out)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++) {
        claims_doing(c, "a cantilever under %s", states[i].name);
        measure_state(chosen, &states[i], out);
    }
    compare_units(out);
}
