/* Motions in time. */
#include <string.h>

#include "cases/format/builder.h"
#include "elements/shared/choice.h"

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
                             "%s applies to the integrator alpha only; remove it", of_alpha[i]);
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

static void read_steps(const fields *f, scene_motion *how)
{
    const int steps = fields_have(f, "step"), count = how->path.stations;
    const double last = count > 0 ? how->path.value[count - 1] : 0;
    if (!steps)
        how->step = usual_step * (last > 0 ? last : 1);
    if (!steps && !fields_have(f, "tolerance"))
        how->tolerance = how->scheme == SCENE_RADAU ? usual_of_radau : usual_tolerance;
    if (!steps && how->tolerance == 0)
        document_mistake(f->b->mistakes, document_find(f->map, "tolerance"), 0,
                         "without a tolerance all steps are alike; give 'step' [s]");
}

void builder_in_time(const fields *f, scene_motion *how)
{
    how->scheme = scheme_of(f);
    how->alpha = alpha_of(f);
    check_parameters(f, how->scheme);
    if (how->path.value != NULL)
        read_steps(f, how);
}
