/* Order of convergence in the number of elements, beside the one that is declared. */
#include <gsl/gsl_sf_ellint.h>
#include <math.h>
#include <stdio.h>

#include "elements/math/pi.h"
#include "harness/experiments/beam.h"
#include "harness/experiments/measured.h"

enum { MESHES = 6 };
static const double noise =
    1e-8; /* errors below it show no order: the column is not infinitely thin */

typedef struct orders_question {
    const char *name;
    beam_analysis analysis;
    element_analysis declared;
    unsigned needs;
} orders_question;

static const orders_question questions[] = {
    {"statics, linear: tip force", BEAM_LINEAR, ELEMENT_STATICS, 0},
    {"statics, large: tip force", BEAM_LARGE, ELEMENT_STATICS, FEATURE_LARGE},
    {"vibration: first bending mode", BEAM_VIBRATION, ELEMENT_VIBRATION, FEATURE_MASS},
    {"buckling: clamped column", BEAM_BUCKLING, ELEMENT_BUCKLING, FEATURE_GEOMETRIC},
};

/* The elastica under a force across it whose end turns by `angle`: (P L^2/EI, deflection/L). */
static void elastica(double angle, double *load, double *deflection)
{
    const double k = sqrt((1 + sin(angle)) / 2), phi = asin(1 / (k * sqrt(2)));
    const double root =
        gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE) - gsl_sf_ellint_F(phi, k, GSL_PREC_DOUBLE);
    *load = root * root;
    *deflection =
        1 -
        2 * (gsl_sf_ellint_Ecomp(k, GSL_PREC_DOUBLE) - gsl_sf_ellint_E(phi, k, GSL_PREC_DOUBLE)) /
            root;
}

/* The load that is set, and the exact value that it gives. */
static double orders_exact_of(const orders_question *q, const section *c, beam_request *r)
{
    const double EI = c->young * c->Iz, lambda = 1.8751040687119611;
    double load, deflection;
    switch (q->analysis) {
    case BEAM_LARGE:
        elastica(1, &load, &deflection);
        r->vector[1] = load * EI;
        return deflection;
    case BEAM_VIBRATION:
        return lambda * lambda * sqrt(EI / (c->density * c->A)) / (2 * PI);
    case BEAM_BUCKLING:
        r->vector[0] = -EI;
        return PI * PI / 4;
    default:
        r->vector[1] = EI;
        return 1.0 / 3;
    }
}

/* Of the finest two meshes whose errors say something: the second of them; 0: there are none. */
static int telling(const element_measure *one)
{
    int last = 0;
    for (int i = 1; i < one->points; i++)
        if (fabs(one->error[i]) > noise && fabs(one->error[i - 1]) > noise)
            last = i;
    return last;
}

/* The least order is a claim. */
static void hold_against_declared(const orders_question *q, int last, const element_measure *one,
                                  claims *c)
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    char name[CLAIM_NAME];
    snprintf(name, sizeof name, "order of %s", q->name);
    claim *claimed = claims_open(c, name, 0.3);
    if (last == 0 && fabs(one->error[one->points - 1]) <= noise)
        claims_asks(claimed, 1, "%s", "");
    else if (last > 1 && one->order < 0.1 && one->least > 0)
        claims_asks(claimed, 0,
                    "order: its errors do not fall: %.2g, %.2g, %.2g with %g, %g and %g elements "
                    "(%s): the limit is wrong; correct the element, or its section's constants",
                    fabs(one->error[last - 2]), fabs(one->error[last - 1]), fabs(one->error[last]),
                    one->at[last - 2], one->at[last - 1], one->at[last], q->name);
    else if (last > 0)
        claims_departs(
            claimed, one->least - one->order,
            "order: at least %d is declared in %s, and %s shows %.1f: errors of %.2g and "
            "%.2g with %g and %g elements; declare what there is, or correct it",
            one->least, analysis[q->declared], q->name, one->order, fabs(one->error[last - 1]),
            fabs(one->error[last]), one->at[last - 1], one->at[last]);
}

static void measure_order(const formulation *chosen, const orders_question *q, claims *c,
                          measures *out)
{
    element_measure *one = measures_add(out, q->name);
    const element_order declared = element_order_in(chosen->type, q->declared, chosen->option);
    beam_request r = {.chosen = chosen,
                      .thickness = 1e-4,
                      .width = 3e-4,
                      .needs = q->needs,
                      .analysis = q->analysis,
                      .load = SCENE_FORCE,
                      .component = SCENE_UY};
    section constants;
    if (beam_section(&r, &constants) != STATUS_OK)
        return;
    const double exact = orders_exact_of(q, &constants, &r);
    one->least = declared.least;
    one->highest = declared.highest;
    for (int i = 0; i < MESHES; i++) {
        r.elements = 1 << i;
        if (!beam_point(&r, r.elements, exact, one))
            return;
    }
    const int last = telling(one);
    if (last > 0)
        one->order = log(fabs(one->error[last - 1] / one->error[last])) /
                     log(one->at[last] / one->at[last - 1]);
    hold_against_declared(q, last, one, c);
}

void measured_orders(const formulation *chosen, claims *c, measures *out)
{
    for (size_t i = 0; i < sizeof questions / sizeof questions[0]; i++) {
        claims_doing(c, "%s", questions[i].name);
        measure_order(chosen, &questions[i], c, out);
    }
}
