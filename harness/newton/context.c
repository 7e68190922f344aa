#include "harness/newton/context.h"

#include "harness/model/kinematics.h"
#include "harness/newton/loads.h"
#include "harness/newton/rotating_frame.h"

int context_runs(const analysis_context *c, int analysis)
{
    return c->options->all_analyses || scene_reads(c->scene, analysis);
}

/* In a motion loads without a function of time stay as in the state that it starts from. */
static void hold_loads(const analysis_context *c, int analysis)
{
    const int origin = scene_origin_of(c->scene, analysis);
    if (origin == analysis || origin == SCENE_NONE || !outcome_has_path(&c->outcomes[origin]))
        return;
    const outcome_path *path = outcome_path_of(&c->outcomes[origin]);
    if (path->reached > 0)
        loads_hold(c->run, kinematics_state_path(path->state[path->reached - 1]));
}

void context_set_frame(const analysis_context *c, int analysis)
{
    static const scene_rotating_frame rest = {{0}, {0}};
    const scene_analysis *own = &c->scene->analysis[analysis],
                         *a = own->follows == SCENE_NONE || own->kind == SCENE_MOTION
                                  ? own
                                  : &c->scene->analysis[own->follows];
    const scene_rotating_frame *frame =
        scene_rotating_frame_of(a) != NULL ? scene_rotating_frame_of(a) : &rest;
    rotating_frame_set(c->run, frame->omega, frame->centre, a->kind == SCENE_ROTATION);
    loads_of(c->run, analysis);
    hold_loads(c, analysis);
}

status context_factor(analysis_context *c, factor *fa, const sparse *K, fault *f)
{
    const status outcome = factor_numeric(fa, K, f);
    c->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_condensation(const analysis_context *c, int count, const int released[],
                            condensation **out, fault *f)
{
    const int from = c->options->condensed > 0 ? c->options->condensed : CONDENSATION_ELEMENTS;
    *out = NULL;
    return c->options->condition ? STATUS_OK
                                 : condensation_alloc(c->run, from, count, released, out, f);
}

status context_factor_condensed(analysis_context *c, condensation *s, fault *f)
{
    const status outcome = condensation_factor(s, f);
    c->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_symmetric(const factor *fa, const char *what, fault *f)
{
    const factor_counts counts = factor_count(fa);
    return counts.negative_pivots >= 0
               ? STATUS_OK
               : fault_set(
                     f, STATUS_REFUSED,
                     "%s need a symmetric tangent: this one and its transpose differ by %.1e "
                     "of their diagonal (symmetric: %.0e); moments dead about fixed axes, and "
                     "loads that follow, have no potential here",
                     what, counts.asymmetry, FACTOR_SYMMETRIC_WITHIN);
}

void context_leave_factor(analysis_context *c, factor *fa)
{
    int compliances = 0;
    for (int i = 0; i < c->scene->analyses; i++)
        compliances += c->scene->analysis[i].kind == SCENE_COMPLIANCE && context_runs(c, i);
    if (compliances == 0 || c->left != NULL)
        factor_free(fa);
    else
        c->left = fa;
}

factor *context_take_factor(analysis_context *c)
{
    factor *fa = c->left;
    c->left = NULL;
    return fa;
}

void context_count_condition(const analysis_context *c, factor *fa, const sparse *K)
{
    counters *n = &c->run->counters;
    if (c->options->condition) {
        const double estimate = factor_condition(fa, K);
        n->condition = !(estimate <= n->condition) ? estimate : n->condition;
    }
}

void context_count_solution(const analysis_context *c, const factor *fa, int fresh, long *counted)
{
    counters *n = &c->run->counters;
    const factor_counts counts = factor_count(fa);
    n->factorisations += counts.factorisations - *counted;
    *counted = counts.factorisations;
    n->solutions++;
    n->factor_entries = counts.entries;
    n->factor_flops += fresh ? counts.flops : 0;
}

void context_count_eigen(const analysis_context *c, const eigen_result *e)
{
    counters *n = &c->run->counters;
    n->solutions += e->solutions;
    n->factorisations += e->factorisations;
    n->dense_operations += e->dense_operations;
}
