/* Errors over thickness by length, 1 to 1e-6: what locks grows where it becomes thin. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/experiments/beam.h"
#include "harness/experiments/measured.h"

enum { THICKNESSES = 7, ELEMENTS = 8 };

/* Of a straight cantilever under a force, and of a quarter ring under one towards its centre. */
static double exact_of(const beam_request *r, const section *c)
{
    const double EI = c->young * c->Iz, EA = c->young * c->A,
                 shear = r->needs & FEATURE_SHEAR ? c->F[0] / c->shear_modulus : 0, radius = 2 / PI;
    if (r->analysis == BEAM_LARGE)
        return 2 / PI; /* a quarter of a circle */
    if (r->quarter)
        return PI / 4 * radius * (radius * radius / EI + 1 / EA + shear);
    return 1 / (3 * EI) + shear;
}

/* Thin, the error is that of the thick one, or much more. */
static void conclude(element_measure *one)
{
    const double thick = fabs(one->error[0]), thin = fabs(one->error[one->points - 1]);
    one->locks = thin > 10 * thick + 0.01;
    if (one->locks)
        snprintf(one->words, sizeof one->words,
                 "it locks: the error grows from %.2g %% to %.2g %% as it becomes thin",
                 100 * thick, 100 * thin);
}

static void over_thickness(beam_request *r, const char *name, measures *out)
{
    element_measure *one = measures_add(out, name);
    double thickness = 1;
    memset(r->vector, 0, sizeof r->vector);
    for (int i = 0; i < THICKNESSES; i++, thickness /= 10) {
        section c;
        r->thickness = r->width = thickness;
        if (beam_section(r, &c) != STATUS_OK)
            return;
        r->vector[r->load == SCENE_MOMENT ? 2 : 1] =
            r->analysis == BEAM_LARGE ? c.young * c.Iz * PI / 2 : 1;
        if (!beam_point(r, thickness, exact_of(r, &c), one))
            return;
    }
    conclude(one);
}

/* With shear where it is offered in that direction. */
static unsigned shear_of(const element_type *t)
{
    return t->lacks & LACKS_SHEAR_Y ? 0 : t->offers & FEATURE_SHEAR;
}

void measured_locking(const formulation *chosen, claims *c, measures *out)
{
    const unsigned shear = shear_of(chosen->type);
    beam_request r = {.chosen = chosen,
                      .elements = ELEMENTS,
                      .needs = shear,
                      .load = SCENE_FORCE,
                      .component = SCENE_UY};
    claims_doing(c, "a cantilever that becomes thin");
    over_thickness(&r, shear ? "cantilever with shear, force" : "cantilever, force", out);
    r.quarter = 1;
    claims_doing(c, "a quarter ring that becomes thin");
    over_thickness(&r, "quarter ring, straight elements", out);
    r.quarter = 0;
    r.load = SCENE_MOMENT;
    r.needs = shear | FEATURE_LARGE;
    r.analysis = BEAM_LARGE;
    claims_doing(c, "a beam bent by a quarter turn that becomes thin");
    over_thickness(&r, "bent by a quarter turn, moment", out);
}
