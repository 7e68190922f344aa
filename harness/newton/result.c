#include "harness/newton/result.h"

#include <stdlib.h>
#include <string.h>

const char *result_event_name(event_kind kind)
{
    static const char *const name[EVENT_KINDS] = {"limit point", "bifurcation", "branch jump"};
    return name[kind];
}

int result_event_multiplicity(const path_event *e)
{
    const int changed = abs(e->negative_after - e->negative_before);
    return e->kind == EVENT_BIFURCATION && changed > 1 ? changed : 1;
}

const char *result_stability_name(step_stability which)
{
    static const char *const name[STEP_STABILITIES] = {"undecided",       "no divergence",
                                                       "stable",          "unstable",
                                                       "unstable: grows", "stable without damping"};
    return name[which];
}

int result_is_unstable(step_stability which)
{
    return which == STEP_UNSTABLE || which == STEP_GROWS;
}

void result_free(solve_result *r)
{
    if (r->quantity != NULL)
        for (int i = 0; i < r->quantities; i++) {
            free(r->quantity[i].curve.x);
            free(r->quantity[i].curve.value);
        }
    for (int i = 0; i < r->matrix_sets; i++) {
        free(r->matrices[i].path);
        free(r->matrices[i].compliance);
        free(r->matrices[i].stiffness);
    }
    for (int i = 0; i < r->ends; i++)
        outcome_end_free(&r->end[i]);
    free(r->end);
    free(r->matrices);
    free(r->quantity);
    free(r->step);
    shapes_free(&r->shapes);
    system_matrices_free(&r->systems);
    free(r->iteration);
    free(r->event);
    free(r->motion);
    memset(r, 0, sizeof *r);
}
