#include "harness/newton/context.h"

#include "harness/model/model.h"
#include "harness/newton/loads.h"
#include "harness/newton/rotating_frame.h"

int context_runs(const analysis_context *c, int analysis)
{
    return c->options->all_analyses || scene_reads(c->scene, analysis);
}

/* Path parameter of the state that a motion starts from; 1: it starts from none. */
static double held_path(const analysis_context *c, int analysis)
{
    const int origin = scene_origin_of(c->scene, analysis);
    if (origin == analysis || origin == SCENE_NONE || !outcome_has_path(&c->outcomes[origin]))
        return 1;
    const outcome_path *path = outcome_path_of(&c->outcomes[origin]);
    return path->reached > 0 ? kinematics_state_path(path->state[path->reached - 1]) : 1;
}

analysis_context context_of(const analysis_context *c, int analysis)
{
    analysis_context of = *c;
    of.eq = (equations){c->model, loading_of(c->model, analysis), c->run};
    of.eq.loading.held_path = held_path(c, analysis);
    return of;
}

analysis_context context_unloaded(const analysis_context *c)
{
    analysis_context none = *c;
    none.eq.loading.unloaded = 1;
    return none;
}

status context_factor(analysis_context *c, matrix_factor *fa, const sparse *K, fault *f)
{
    const status outcome = factor_numeric(fa, K, f);
    c->work->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_condensation(const analysis_context *c, int count, const int released[],
                            condensation **out, fault *f)
{
    const int from = c->options->condensed > 0 ? c->options->condensed : CONDENSATION_ELEMENTS;
    *out = NULL;
    return c->options->condition ? STATUS_OK
                                 : condensation_alloc(&c->eq, from, count, released, out, f);
}

status context_factor_condensed(analysis_context *c, condensation *s, fault *f)
{
    const status outcome = condensation_factor(s, f);
    c->work->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_symmetric(const matrix_factor *fa, const char *what, fault *f)
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

void context_leave_factor(analysis_context *c, matrix_factor *fa)
{
    int compliances = 0;
    for (int i = 0; i < c->scene->analyses; i++)
        compliances += c->scene->analysis[i].kind == SCENE_COMPLIANCE && context_runs(c, i);
    if (compliances == 0 || c->work->left != NULL)
        factor_free(fa);
    else
        c->work->left = fa;
}

matrix_factor *context_take_factor(analysis_context *c)
{
    matrix_factor *fa = c->work->left;
    c->work->left = NULL;
    return fa;
}

void context_count_condition(const analysis_context *c, matrix_factor *fa, const sparse *K)
{
    counters *n = &c->run->counters;
    if (c->options->condition) {
        const double estimate = factor_condition(fa, K);
        n->condition = !(estimate <= n->condition) ? estimate : n->condition;
    }
}

void context_count_solution(const analysis_context *c, const matrix_factor *fa, int fresh,
                            long *counted)
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
