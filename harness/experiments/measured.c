#include "harness/experiments/experiments_impl.h"

#include <gsl/gsl_sf_ellint.h>
#include <math.h>
#include <string.h>

#include "elements/math/scalar.h"

const measured_group measured_groups[MEASURED_GROUPS] = {
    {"states",
     "uniform and linear states of a cantilever: error with 1 element and with 4 unequal elements",
     measured_states},
    {"locking", "errors with 8 elements, for ratios of thickness to length from 1 to 1e-6",
     measured_locking},
    {"orders", "orders of convergence, and errors with 1 to 32 elements", measured_orders},
    {"paths", "changes due to superposed full turns and after closed cycles, 24 steps each",
     measured_paths},
};

/* Errors over thickness/length, from 1 to 1e-6. Locking makes the errors increase as the element
 * becomes thinner. */

enum { THICKNESSES = 7, ELEMENTS = 8 };

/* Returns the exact displacement of the end of a cantilever due to a force of 1 N, or of a quarter
 * ring due to a force of 1 N towards its centre. For BEAM_LARGE, returns the displacement for an
 * end moment that bends the beam to a quarter circle. */
static double exact_of(const beam_request *r, const section *c)
{
    const double EI = c->young * c->Iz, EA = c->young * c->A,
                 shear = r->needs & FEATURE_SHEAR ? c->F[0] / c->shear_modulus : 0, radius = 2 / PI;
    if (r->analysis == BEAM_LARGE)
        return 2 / PI; /* for a quarter circle */
    if (r->quarter)
        return PI / 4 * radius * (radius * radius / EI + 1 / EA + shear);
    return 1 / (3 * EI) + shear;
}

static void conclude(element_measure *one)
{
    const double thick = fabs(one->error[0]), thin = fabs(one->error[one->points - 1]);
    one->locks = thin > 10 * thick + 0.01;
    if (one->locks)
        snprintf(one->words, sizeof one->words,
                 "the element locks: its error increases from %.2g %% to %.2g %% as the element "
                 "becomes thinner",
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

static unsigned shear_of(const element_type *t)
{
    return t->lacks & LACKS_SHEAR_Y ? 0 : t->offers & FEATURE_SHEAR;
}

void measured_locking(const formulation *chosen, check_results *c, measures *out)
{
    const unsigned shear = shear_of(chosen->type);
    beam_request r = {.chosen = chosen,
                      .elements = ELEMENTS,
                      .needs = shear,
                      .load = SCENE_FORCE,
                      .component = SCENE_UY};
    checks_current(c, "a cantilever that becomes thinner");
    over_thickness(&r, shear ? "cantilever with shear, force" : "cantilever, force", out);
    r.quarter = 1;
    checks_current(c, "a quarter ring that becomes thinner");
    over_thickness(&r, "quarter ring, straight elements", out);
    r.quarter = 0;
    r.load = SCENE_MOMENT;
    r.needs = shear | FEATURE_LARGE;
    r.analysis = BEAM_LARGE;
    checks_current(c, "a beam that is bent by a quarter turn and becomes thinner");
    over_thickness(&r, "bent by a quarter turn, moment", out);
}

/* States of a cantilever with a known exact solution. Uniform states must be exact on every mesh.
 * Linear states can be exact with one element. */

enum { IRREGULAR = 4 };
static const double fraction[IRREGULAR] = {0.13, 0.37, 0.19, 0.31};

typedef struct state {
    const char *name;
    double thickness, width;
    int profile;
    unsigned needs;
    beam_analysis analysis;
    scene_load_kind load;
    int direction, component;
    const char *reason;
} state;

static const state states[] = {
    {"stretch", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 0, SCENE_UX, "E A"},
    {"pure torsion", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX, "G It"},
    {"pure bending about y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 1, SCENE_UZ, "E Iy"},
    {"pure bending about z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_MOMENT, 2, SCENE_UY, "E Iz"},
    {"pure bending, a quarter turn", 0.05, 0.1, 0, FEATURE_LARGE, BEAM_LARGE, SCENE_MOMENT, 2,
     SCENE_UY, "E Iz, unless large rotations are wrong"},
    {"tip force along y", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 1, SCENE_UY,
     "E Iz, unless the element locks"},
    {"tip force along z", 0.05, 0.1, 0, 0, BEAM_LINEAR, SCENE_FORCE, 2, SCENE_UZ,
     "E Iy, unless the element locks"},
    {"constant shear along y, short beam", 0.5, 0.4, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 1,
     SCENE_UY, "G A times the shear factor, or E Iz"},
    {"constant shear along z, short beam", 0.5, 0.4, 0, FEATURE_SHEAR, BEAM_LINEAR, SCENE_FORCE, 2,
     SCENE_UZ, "G A times the shear factor, or E Iy"},
    {"torsion, warping held", 0, 0, 1, 0, BEAM_LINEAR, SCENE_MOMENT, 0, SCENE_RX, "G It or E Iw"},
};

static double states_exact_of(const state *s, const section *c, double load)
{
    const double EIz = c->young * c->Iz, EIy = c->young * c->Iy, GI = c->shear_modulus * c->It;
    const double shear = s->needs & FEATURE_SHEAR ? 1 / c->shear_modulus : 0;
    if (s->profile) {
        const double k = sqrt(GI / (c->young * c->Iw));
        return load / GI * (1 - tanh(k) / k);
    }
    if (s->analysis == BEAM_LARGE) /* a large deflection into an arc of a quarter circle */
        return 2 / PI;
    if (s->load == SCENE_FORCE)
        return s->direction == 0   ? load / (c->young * c->A)
               : s->direction == 1 ? load * (1 / (3 * EIz) + shear * c->F[0])
                                   : load * (1 / (3 * EIy) + shear * c->F[4]);
    return s->direction == 0 ? load / GI : s->direction == 1 ? -load / (2 * EIy) : load / (2 * EIz);
}

/* Sets wrong_limit if the error with four elements exceeds 1e-6 and half of the error with one
 * element. */
static void states_conclude(const state *s, element_measure *one)
{
    const double coarse = fabs(one->error[0]), fine = fabs(one->error[1]);
    one->wrong_limit = fine > 1e-6 && fine > 0.5 * coarse;
    if (one->wrong_limit && coarse < 1e-9)
        snprintf(one->words, sizeof one->words,
                 "the result is exact with one element, but has an error of %.2g %% with four; "
                 "correct the coupling of the nodes, its sign or a power of the length",
                 100 * fine);
    else if (one->wrong_limit)
        snprintf(one->words, sizeof one->words,
                 "the error is %.2g %% with one element and %.2g %% with four; correct the "
                 "stiffness of the section (probably %s)",
                 100 * coarse, 100 * fine, s->reason);
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
    snprintf(out->words, sizeof out->words,
             "the element is %.0e times too %s in every state; check the units",
             fmax(times, 1 / times), times > 1 ? "soft" : "stiff");
}

static void hold_limits(check_results *c, const measures *m)
{
    if (m->words[0] != '\0') {
        checks_require(checks_open(c, "units", 0), 0, "%s", m->words);
        return;
    }
    for (int i = 0; i < m->count; i++) {
        const element_measure *one = &m->measure[i];
        char name[CHECK_NAME + 8];
        snprintf(name, sizeof name, "limit of %s", one->name);
        if (one->points > 1 && states[i].analysis == BEAM_LINEAR)
            checks_require(checks_open(c, name, 0), !one->wrong_limit, "%s: %s", one->name,
                           one->words);
    }
}

void measured_states(const formulation *chosen, check_results *c, measures *out)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++) {
        checks_current(c, "a cantilever under %s", states[i].name);
        measure_state(chosen, &states[i], out);
    }
    compare_units(out);
    hold_limits(c, out);
}

enum { MESHES = 6, MESHES_Z = 4 };
static const double noise = 1e-8;

typedef struct orders_question {
    const char *name;
    beam_analysis analysis;
    element_analysis declared;
    unsigned needs;
    int plane; /* 1: displacements along y; 2: along z */
} orders_question;

static const orders_question questions[] = {
    {"statics, linear: tip force", BEAM_LINEAR, ELEMENT_STATICS, 0, 1},
    {"statics, linear: force along z", BEAM_LINEAR, ELEMENT_STATICS, 0, 2},
    {"statics, large: tip force", BEAM_LARGE, ELEMENT_STATICS, FEATURE_LARGE, 1},
    {"statics, large: force along z", BEAM_LARGE, ELEMENT_STATICS, FEATURE_LARGE, 2},
    {"vibration: first bending mode", BEAM_VIBRATION, ELEMENT_VIBRATION, FEATURE_MASS, 1},
    {"vibration: first mode along z", BEAM_VIBRATION, ELEMENT_VIBRATION, FEATURE_MASS, 2},
    {"buckling: clamped column", BEAM_BUCKLING, ELEMENT_BUCKLING, FEATURE_GEOMETRIC, 1},
    {"buckling: column along z", BEAM_BUCKLING, ELEMENT_BUCKLING, FEATURE_GEOMETRIC, 2},
};

/* Computes P L^2/EI and deflection/L of the elastica under a transverse end force, for a given
 * rotation of the end. */
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

static double orders_exact_of(const orders_question *q, const section *c, beam_request *r)
{
    const double EI = c->young * (q->plane == 1 ? c->Iz : c->Iy), lambda = 1.8751040687119611;
    double load, deflection;
    switch (q->analysis) {
    case BEAM_LARGE:
        elastica(1, &load, &deflection);
        r->vector[q->plane] = load * EI;
        return deflection;
    case BEAM_VIBRATION:
        return lambda * lambda * sqrt(EI / (c->density * c->A)) / (2 * PI);
    case BEAM_BUCKLING:
        r->vector[0] = -EI;
        return PI * PI / 4;
    default:
        r->vector[q->plane] = EI;
        return 1.0 / 3;
    }
}

/* Finds the finest pair of consecutive meshes whose errors both exceed `noise`. Returns the index
 * of the finer mesh; 0: none. */
static int informative_points(const element_measure *one)
{
    int last = 0;
    for (int i = 1; i < one->points; i++)
        if (fabs(one->error[i]) > noise && fabs(one->error[i - 1]) > noise)
            last = i;
    return last;
}

static void hold_against_declared(const orders_question *q, int last, const element_measure *one,
                                  check_results *c)
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    char name[CHECK_NAME];
    snprintf(name, sizeof name, "order of %s", q->name);
    check_result *claimed = checks_open(c, name, 0.3);
    if (last == 0 && fabs(one->error[one->points - 1]) <= noise)
        checks_require(claimed, 1, "%s", "");
    else if (last > 1 && one->order < 0.1 && one->least > 0)
        checks_require(claimed, 0,
                       "order: the errors of '%s' do not decrease (%.2g, %.2g, %.2g with %g, %g "
                       "and %g elements), so the limit is wrong; correct the element, or the "
                       "constants of its section",
                       q->name, fabs(one->error[last - 2]), fabs(one->error[last - 1]),
                       fabs(one->error[last]), one->at[last - 2], one->at[last - 1], one->at[last]);
    else if (last > 0)
        checks_deviation(claimed, one->least - one->order,
                         "order: the declared order in %s is at least %d, but the observed order "
                         "of '%s' is %.1f (errors of %.2g and %.2g with %g and %g elements); "
                         "correct the element, or declare the observed order",
                         analysis[q->declared], one->least, q->name, one->order,
                         fabs(one->error[last - 1]), fabs(one->error[last]), one->at[last - 1],
                         one->at[last]);
}

static void measure_order(const formulation *chosen, const orders_question *q, check_results *c,
                          measures *out)
{
    element_measure *one = measures_add(out, q->name);
    const element_order declared = element_order_in(chosen->type, q->declared, chosen->option);
    beam_request r = {.chosen = chosen,
                      .thickness = q->plane == 1 ? 1e-4 : 3e-4,
                      .width = q->plane == 1 ? 3e-4 : 1e-4,
                      .needs = q->needs,
                      .analysis = q->analysis,
                      .load = SCENE_FORCE,
                      .component = q->plane == 1 ? SCENE_UY : SCENE_UZ};
    section constants;
    if (beam_section(&r, &constants) != STATUS_OK)
        return;
    const double exact = orders_exact_of(q, &constants, &r);
    one->least = declared.least;
    one->highest = declared.highest;
    for (int i = 0; i < (q->plane == 1 ? MESHES : MESHES_Z); i++) {
        r.elements = 1 << i;
        if (!beam_point(&r, r.elements, exact, one))
            return;
    }
    const int last = informative_points(one);
    if (last > 0)
        one->order = log(fabs(one->error[last - 1] / one->error[last])) /
                     log(one->at[last] / one->at[last - 1]);
    hold_against_declared(q, last, one, c);
}

void measured_orders(const formulation *chosen, check_results *c, measures *out)
{
    for (size_t i = 0; i < sizeof questions / sizeof questions[0]; i++) {
        checks_current(c, "%s", questions[i].name);
        measure_order(chosen, &questions[i], c, out);
    }
}
