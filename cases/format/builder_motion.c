/* Motions in time, and what other analyses are about. */
#include <string.h>

#include "cases/format/builder.h"
#include "elements/shared/choice.h"

int builder_about(const fields *f, int index)
{
    const int follows = fields_entry(f, "about", SCENE_ANALYSES);
    if (follows >= index)
        document_mistake(f->b->mistakes, document_find(f->map, "about"), 0,
                         "'%s' does not stand before this one; move it up",
                         fields_text(f, "about", ""));
    return follows < index ? follows : SCENE_NONE;
}

/* Where neither a step nor a tolerance is given: 0.1 % of the motion. The step is of the last
 * station. */
static const double usual_tolerance = 1e-3, usual_of_radau = 1e-5, usual_step = 1e-3;

/* A number of one parameter set of alpha, between two. */
static double between(const fields *f, const char *key, double otherwise, double least, double most,
                      const char *range)
{
    const double value = fields_number(f, key, otherwise);
    if (value >= least && value <= most)
        return value;
    document_mistake(f->b->mistakes, document_find(f->map, key), 0, "%s = %g; give %s", key, value,
                     range);
    return otherwise;
}

static scene_alpha alpha_of(const fields *f)
{
    double pair[2];
    if (fields_vector(f, "parameters", 2, pair))
        return (scene_alpha){pair[0], pair[1]};
    if (fields_have(f, "hht"))
        return (scene_alpha){0, between(f, "hht", 0, 0, 1. / 3,
                                        "alpha of Hilber, Hughes and Taylor, from 0 to 1/3")};
    if (fields_word(f, "trapezoidal", "no|yes", 0))
        return (scene_alpha){0, 0};
    return scene_alpha_of_radius(between(f, "rho", 0.9, 0, 1, "a spectral radius from 0 to 1"));
}

static const char *const of_alpha[] = {"rho", "hht", "trapezoidal", "parameters"};

/* Without an integrator: by a parameter that no other one has, or by steps that are all alike. */
static int asks_for_alpha(const fields *f)
{
    int asks = fields_have(f, "step") && !fields_have(f, "tolerance");
    for (int i = 0; i < 4; i++)
        asks |= fields_have(f, of_alpha[i]);
    return asks;
}

/* Parameters of alpha that another integrator does not have, unless that is a parameter's choice.
 */
static void check_parameters(const fields *f, scene_scheme scheme)
{
    const int chosen = choice_index(SCENE_SCHEME_CHOICES, fields_text(f, "integrator", "")) < 0;
    for (int i = 0; i < 4 && scheme != SCENE_ALPHA && !chosen; i++)
        if (fields_have(f, of_alpha[i]))
            document_mistake(f->b->mistakes, document_find(f->map, of_alpha[i]), 0,
                             "%s is of the integrator alpha; leave it out", of_alpha[i]);
}

/* Parameter sets of alpha have names of their own where integrators are compared (motion -u). */
static scene_scheme scheme_of(const fields *f)
{
    static const char *const set[][2] = {{"hht", "hht: 0.1"}, {"trapezoidal", "trapezoidal: yes"}};
    const char *given = fields_text(f, "integrator", "");
    for (int i = 0; i < 2; i++)
        if (strcmp(given, set[i][0]) == 0) {
            document_mistake(f->b->mistakes, document_find(f->map, "integrator"), 0,
                             "integrator: %s is alpha with a parameter; give 'integrator: alpha' "
                             "and '%s'",
                             given, set[i][1]);
            return SCENE_ALPHA;
        }
    return (scene_scheme)fields_word(f, "integrator", SCENE_SCHEME_CHOICES,
                                     asks_for_alpha(f) ? SCENE_ALPHA : SCENE_RADAU);
}

static double last_of(int count, const double value[])
{
    return count > 0 && value[count - 1] > 0 ? value[count - 1] : 1;
}

static void read_steps(const fields *f, double last, scene_motion *how)
{
    const int steps = fields_have(f, "step");
    const double usual = how->scheme == SCENE_RADAU ? usual_of_radau : usual_tolerance;
    how->tolerance = fields_number(f, "tolerance", steps ? 0 : usual);
    how->step = fields_number(f, "step", usual_step * last);
    if (!steps && how->tolerance == 0)
        document_mistake(f->b->mistakes, document_find(f->map, "tolerance"), 0,
                         "without a tolerance all steps are alike; give 'step' [s]");
}

static scene_mass mass_of(const fields *f)
{
    const int given = fields_word(f, "mass", SCENE_MASS_CHOICES, 0);
    return fields_have(f, "mass") ? (scene_mass)(SCENE_LUMPED + given) : SCENE_MASS_USUAL;
}

void builder_in_time(const fields *f, int index)
{
    double *stations;
    const fields start = fields_below(f, "start");
    const int count = fields_values(f, "stations", &stations);
    scene_motion how = {.scheme = scheme_of(f), .alpha = alpha_of(f), .mass = mass_of(f)};
    check_parameters(f, how.scheme);
    read_steps(f, last_of(count, stations), &how);
    fields_vector(&start, "velocity", 3, how.start.velocity);
    fields_vector(&start, "spin", 3, how.start.spin);
    fields_vector(&start, "centre", 3, how.start.centre);
    scene_add_motion(f->b->scene, builder_about(f, index), count, stations, how);
}
