#ifndef BEAMWORK_TEST_MOVING_H
#define BEAMWORK_TEST_MOVING_H

#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

enum { MOVING_STATIONS = 20 };

/* Makes the structure of a case at parameters "name=value;...", without its analyses and
 * quantities. */
static inline void moving_case(const case_type *type, const char *parameters, scene *s)
{
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    parameters_default(type, value);
    if (parameters_parse(type, parameters, value, NULL, &f) != STATUS_OK)
        gsl_test(1, "%s", f.text);
    scene_init(s, type->name);
    gsl_test(case_build(type, value, s, &f) != STATUS_OK, "%s: built (%s)", type->name, f.text);
    for (int i = 0; i < s->analyses; i++)
        if (scene_path_of(&s->analysis[i]) != NULL)
            free(scene_path_of(&s->analysis[i])->value);
    s->analyses = s->quantities = 0;
}

static inline void moving_unload(scene *s)
{
    for (int i = 0; i < s->loads; i++) {
        free(s->load[i].path);
        free(s->load[i].factor);
        function_free(&s->load[i].function);
    }
    s->loads = 0;
}

/* Adds a motion to `end` [s] with stations at equal distances. */
static inline int motion_added(scene *s, scene_scheme by, double step, double end)
{
    double path[MOVING_STATIONS];
    for (int i = 0; i < MOVING_STATIONS; i++)
        path[i] = end * (i + 1) / MOVING_STATIONS;
    return scene_add_motion(
        s, SCENE_NONE, MOVING_STATIONS, path,
        (scene_motion){
            .scheme = by, .alpha = scene_alpha_of_radius(0.9), .step = step, .mass = SCENE_LUMPED});
}

/* Adds the quantities NAME_max and NAME_min, the extremes of an energy or momentum over the
 * stations. */
static inline void moving_range(scene *s, const char *name, int motion, scene_balance what)
{
    char full[SCENE_NAME];
    for (int i = 0; i < 2; i++) {
        snprintf(full, sizeof full, "%s_%s", name, i ? "min" : "max");
        scene_add_quantity(s, full, "J", motion, scene_balance_of(what))->reduction =
            i ? SCENE_MIN : SCENE_MAX;
    }
}

static inline double moving_largest(const answer *a, const char *name)
{
    char full[SCENE_NAME];
    double largest = 0;
    for (int i = 0; i < 2; i++) {
        snprintf(full, sizeof full, "%s_%s", name, i ? "min" : "max");
        const double value = answer_of(a, full);
        largest = isnan(value) || fabs(value) > largest ? fabs(value) : largest;
    }
    return largest;
}

#endif
