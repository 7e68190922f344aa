#include "harness/analysis/solve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/inputs.h"
#include "harness/analysis/buckling.h"
#include "harness/analysis/collect.h"
#include "harness/analysis/collect_systems.h"
#include "harness/analysis/compliance.h"
#include "harness/analysis/continuation.h"
#include "harness/analysis/extract.h"
#include "harness/analysis/linear.h"
#include "harness/analysis/loaded.h"
#include "harness/analysis/modal.h"
#include "harness/analysis/rotation.h"
#include "harness/analysis/static.h"
#include "harness/newton/newton.h"
#include "harness/numerics/numerics.h"
#include "harness/time/time.h"

typedef status analysis_function(analysis_context *, int analysis, analysis_outcome *, fault *);

static analysis_function *function_of(const scene *s, const scene_analysis *a)
{
    const int is_loaded = a->follows != SCENE_NONE && s->analysis[a->follows].kind == SCENE_STATIC;
    switch (a->kind) {
    case SCENE_LINEAR:
        return linear_analysis;
    case SCENE_BUCKLING:
        return is_loaded ? loaded_buckling : buckling_analysis;
    case SCENE_MODAL:
        return is_loaded ? loaded_modal : modal_analysis;
    case SCENE_STATIC:
        return static_analysis;
    case SCENE_COMPLIANCE:
        return compliance_analysis;
    case SCENE_CONTINUATION:
        return continuation_analysis;
    case SCENE_ROTATION:
        return rotation_analysis;
    case SCENE_MOTION:
        break;
    }
    return motion_analysis;
}

/* Did it fail before it left the undeformed state? In time a structure may be free to move. */
static int is_stuck(const analysis_outcome *o)
{
    const int failed = o->status == STATUS_SINGULAR || o->status == STATUS_NOT_CONVERGED;
    return failed && o->kind != SCENE_MOTION &&
           (!outcome_has_path(o) || outcome_path_of(o)->reached == 0);
}

/* Is there a step of the analysis whose tangent was indefinite? */
static int has_negative(const solve_result *r, int from)
{
    for (int i = from; i < r->steps; i++)
        if (r->step[i].negative_pivots > 0)
            return 1;
    return 0;
}

/* A path that begins at a stiffness that is indefinite by itself leads nowhere. Asked where the
 * path was unstable or failed, and not counted as work. */
static status judge_rest(analysis_context *c, const analysis_outcome *o, int first_step, fault *f)
{
    if (!outcome_has_path(o) || o->kind == SCENE_COMPLIANCE || o->kind == SCENE_MOTION ||
        (o->status == STATUS_OK && !has_negative(c->result, first_step)) ||
        newton_judge_rest(c->model, NULL) != STATUS_OK) /* which is said already */
        return o->status;
    fault why = {""};
    linear_system s = {0};
    const counters work = c->run->counters;
    const status at_rest = linear_system_alloc(c, &s, &why);
    linear_system_free(&s);
    c->run->counters = work;
    return at_rest == STATUS_NOT_CONVERGED ? fault_set(f, at_rest, "%s", why.text) : o->status;
}

/* The first failure names the whole. */
static void run_analyses(analysis_context *c)
{
    for (int i = 0; i < c->scene->analyses; i++) {
        analysis_outcome *o = &c->outcomes[i];
        fault f = {""};
        const scene_analysis *a = &c->scene->analysis[i];
        analysis_function *run = function_of(c->scene, a);
        o->kind = a->kind;
        if (!context_runs(c, i) || (c->options->sample > 0 && a->kind != SCENE_STATIC))
            continue;
        analysis_context own = context_of(c, i);
        c->work->singular = 0;
        const int first_step = c->result->steps;
        o->status = scene_inputs_check(c->scene, i, &f);
        if (o->status == STATUS_OK)
            o->status = newton_judge_rest(c->model, &f);
        if (o->status == STATUS_OK)
            o->status = run(&own, i, o, &f);
        history_judge_steps(c->result, c->scene, i, first_step);
        if (a->kind == SCENE_ROTATION)
            rotation_judge_stations(&own, i, o);
        if (o->status == STATUS_SINGULAR && c->work->singular)
            singular_explain(&own, &f);
        else if (is_stuck(o))
            o->status = singular_mechanism(&own, o->status, &f);
        o->status = judge_rest(&own, o, first_step, &f);
        snprintf(o->reason, sizeof o->reason, "%s", f.text);
        if (o->status != STATUS_OK && c->result->status == STATUS_OK) {
            c->result->status = o->status;
            snprintf(c->result->reason, sizeof c->result->reason, "%s", f.text);
        }
    }
}

/* What follows from the solution and cannot be had spoils it, unless it is spoilt already. */
static void spoil(solve_result *r, status outcome, const fault *f)
{
    if (outcome == STATUS_OK || r->status != STATUS_OK)
        return;
    r->status = outcome;
    snprintf(r->reason, sizeof r->reason, "%s", f->text);
}

/* Shapes and the matrices of all states, where they are wanted. */
static void keep_states(analysis_context *c)
{
    fault f = {""};
    solve_result *r = c->result;
    if (c->options->shapes > 0)
        spoil(r, collect_shapes(c, c->options->shapes, &r->shapes, &f), &f);
    if (c->options->systems)
        spoil(r, collect_systems(c, &r->systems, &f), &f);
}

/* A curve over another quantity: its values where both have a point. */
static void put_over(const scene *s, solve_result *r, int quantity)
{
    const int over = scene_abscissa_of(s, &s->quantity[quantity]);
    const curve *of = over != SCENE_NONE ? &r->quantity[over].curve : NULL;
    curve *c = &r->quantity[quantity].curve;
    for (int i = 0; of != NULL && i < c->points; i++)
        c->x[i] = i < of->points ? of->value[i] : NAN;
}

status solve_scene(const scene *s, const model *m, const solve_options *options,
                   solve_result *result, fault *f)
{
    static const solve_options defaults = {0};
    run_state run;
    context_work work = {0};
    analysis_context c = {.scene = s,
                          .model = m,
                          .run = &run,
                          .options = options != NULL ? options : &defaults,
                          .result = result,
                          .work = &work};
    memset(result, 0, sizeof *result);
    TRY(run_state_begin(&run, m, c.options->threads, f));
    phases_want(&run.phases, c.options->phases);
    const double start = clock_processor_seconds();
    result->quantity = calloc((size_t)s->quantities + 1, sizeof *result->quantity);
    c.outcomes = calloc((size_t)s->analyses + 1, sizeof *c.outcomes);
    if (result->quantity == NULL || c.outcomes == NULL) {
        free(c.outcomes);
        run_state_end(&run);
        return fault_set(f, STATUS_FAULT, "out of memory for a solution");
    }
    result->quantities = s->quantities;
    run_analyses(&c);
    result->seconds_setup = work.setup;
    result->seconds_solve = clock_processor_seconds() - start - work.setup;
    if (c.options->phases)
        phases_of_whole(&run.phases, result->seconds_solve, result->phase);
    for (int i = 0; i < s->quantities; i++) {
        quantity_result *q = &result->quantity[i];
        const analysis_context own = context_of(&c, s->quantity[i].analysis);
        extract_quantity(&own, &s->quantity[i], q);
        q->change = NAN;
        if (q->status == STATUS_FAULT && result->status == STATUS_OK) {
            result->status = STATUS_FAULT;
            snprintf(result->reason, sizeof result->reason, "%s", q->reason);
        }
    }
    for (int i = 0; i < s->quantities; i++)
        put_over(s, result, i);
    result->counters = run.counters; /* shapes are drawn, not solved for: they do not count */
    keep_states(&c);
    for (int i = 0; i < s->analyses; i++)
        outcome_free(&c.outcomes[i]);
    free(c.outcomes);
    factor_free(work.left);
    run_state_end(&run);
    if (result->status != STATUS_OK && f != NULL)
        snprintf(f->text, sizeof f->text, "%s", result->reason);
    return result->status;
}
