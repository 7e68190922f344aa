/* Linear buckling where one load stays and another grows: along one line the critical factor is
 * less by what stays. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/scenes.h"

enum { NO_MODE, PUSHES, PULLS, BOTH_GROW, CRITICAL, BENT, WAYS };

/* A clamped bar of EI = 1 and 2 along x, pushed by the growing load 1. */
static void staying_column(int way, scene *s)
{
    static const double stays[WAYS] = {0, -1.5, 2, -0.5, -4, 0}, zero = 0, one = 1,
                        ends[3] = {0, 0.5, 1};
    const double growing[3] = {0.5, 0.75, 1}, bent[3] = {0, 0.6, 1};
    const section_spec spec = sections_of(1e6, 2, 1, 1);
    scene_init(s, "column");
    const int tip = scenes_cantilever(s, &spec);
    const int push = scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    if (way == BOTH_GROW) /* from a half to the whole */
        scene_set_factor(s, push, 3, ends, growing);
    else if (way == BENT)
        scene_set_factor(s, push, 3, ends, bent);
    else if (way != NO_MODE)
        scene_set_factor(s, scene_add_load(s, SCENE_FORCE, tip, stays[way], 0, 0), 1, &zero, &one);
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_add_quantity(s, "first", "N", buckling, scene_critical_factor(1, 0));
    scene_add_quantity(s, "second", "N", buckling, scene_critical_factor(1, 1));
}

static int answered(const element_type *e, ask_tally *tally, int way, answer *a)
{
    scene s;
    staying_column(way, &s);
    ask_scene(&s, e, NULL, 4, a);
    scene_free(&s);
    return ask_count(tally, a, "column %d", way);
}

static void staying_refuses(const element_type *e, int way, const char *words)
{
    answer a;
    scene s;
    staying_column(way, &s);
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (e->offers & FEATURE_GEOMETRIC)
        gsl_test(a.status != STATUS_REFUSED || strstr(a.reason, words) == NULL, "%s: refused (%s)",
                 e->name, a.reason);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        static answer alone, other;
        if (answered(e, &tally, NO_MODE, &alone)) {
            if (answered(e, &tally, PUSHES, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], alone.value[k] - 1.5, 1e-8,
                                 "%s: what pushes stays", e->name);
            if (answered(e, &tally, PULLS, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], alone.value[k] + 2, 1e-8, "%s: what pulls stays",
                                 e->name);
            if (answered(e, &tally, BOTH_GROW, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], (alone.value[k] - 0.5) / 0.5, 1e-8,
                                 "%s: half of it grows", e->name);
        }
        staying_refuses(e, CRITICAL, "critical by themselves");
        staying_refuses(e, BENT, "not on a line");
        ask_conclude(&tally, e, "loads that stay");
    }
    return gsl_test_summary();
}
