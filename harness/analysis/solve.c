#include "harness/analysis/solve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/clock.h"
#include "harness/analysis/analysis.h"
#include "harness/analysis/singular.h"

static void free_states(int count, model_state **state)
{
    if (state != NULL)
        for (int i = 0; i < count; i++)
            model_state_free(state[i]);
    free(state);
}

void outcome_free(analysis_outcome *o)
{
    free_states(o->reached, o->state);
    free_states(o->points, o->point_state);
    free(o->path);
    free(o->x);
    free(o->factor);
    free(o->control);
    outcome_side *const sides[] = {&o->positive, &o->negative};
    for (int i = 0; i < 2; i++) {
        free(sides[i]->value);
        free(sides[i]->mode);
        free(sides[i]->error);
    }
    rotation_modes_free(o->modes, o->stations);
}

void outcome_take(eigen_side *from, outcome_side *to)
{
    to->count = from->count;
    to->value = from->mu;
    to->mode = from->mode;
    to->error = from->error;
    to->status = from->status;
    snprintf(to->reason, sizeof to->reason, "%s", from->reason);
    if (from->rounding > 0 && from->status == STATUS_OK)
        snprintf(to->reason, sizeof to->reason, "geometric stiffness is round-off");
    from->mu = from->mode = from->error = NULL;
}

static analysis_function *function_of(scene_analysis_kind kind)
{
    switch (kind) {
    case SCENE_LINEAR:
        return analysis_linear;
    case SCENE_BUCKLING:
        return analysis_buckling;
    case SCENE_MODAL:
        return analysis_modal;
    case SCENE_STATIC:
        return analysis_static;
    case SCENE_COMPLIANCE:
        return analysis_compliance;
    case SCENE_CONTINUATION:
        return analysis_continuation;
    case SCENE_ROTATION:
        return analysis_rotation;
    }
    return NULL;
}

/* The first failure names the whole. */
static void run_analyses(analysis_context *c)
{
    for (int i = 0; i < c->scene->analyses; i++) {
        analysis_outcome *o = &c->outcomes[i];
        fault f = {""};
        const scene_analysis *a = &c->scene->analysis[i];
        analysis_function *run = function_of(a->kind);
        model_set_spin(c->model, a->omega, a->omega_centre, a->kind == SCENE_ROTATION);
        if (c->options->sample > 0 && a->kind != SCENE_STATIC)
            continue;
        c->singular = 0;
        o->status = run != NULL ? run(c, i, o, &f)
                                : fault_set(&f, STATUS_REFUSED, "analysis %d: not available", i);
        if (o->status == STATUS_SINGULAR && c->singular)
            singular_explain(c, &f);
        snprintf(o->reason, sizeof o->reason, "%s", f.text);
        if (o->status != STATUS_OK && c->result->status == STATUS_OK) {
            c->result->status = o->status;
            snprintf(c->result->reason, sizeof c->result->reason, "%s", f.text);
        }
    }
}

status solve_scene(const scene *s, model *m, const solve_options *options, solve_result *result,
                   fault *f)
{
    static const solve_options defaults = {0};
    analysis_context c = {
        .scene = s, .model = m, .options = options != NULL ? options : &defaults, .result = result};
    const double start = clock_processor_seconds();
    memset(result, 0, sizeof *result);
    result->quantity = calloc((size_t)s->quantities + 1, sizeof *result->quantity);
    c.outcomes = calloc((size_t)s->analyses + 1, sizeof *c.outcomes);
    if (result->quantity == NULL || c.outcomes == NULL) {
        free(c.outcomes);
        return fault_set(f, STATUS_FAULT, "out of memory for a solution");
    }
    result->quantities = s->quantities;
    model_phases(m)->wanted = c.options->phases;
    run_analyses(&c);
    memcpy(result->phase, model_phases(m)->seconds, sizeof result->phase);
    result->seconds_setup = c.setup;
    result->seconds_solve = clock_processor_seconds() - start - c.setup;
    for (int i = 0; i < s->quantities; i++) {
        quantity_result *q = &result->quantity[i];
        extract_quantity(&c, &s->quantity[i], q);
        if (q->status == STATUS_FAULT && result->status == STATUS_OK) {
            result->status = STATUS_FAULT;
            snprintf(result->reason, sizeof result->reason, "%s", q->reason);
        }
    }
    const counters work =
        *model_counters(m); /* shapes are drawn, not solved for: they do not count */
    if (c.options->shapes > 0 &&
        shapes_collect(&c, c.options->shapes, &result->shapes, f) != STATUS_OK)
        result->status = STATUS_FAULT;
    *model_counters(m) = work;
    for (int i = 0; i < s->analyses; i++)
        outcome_free(&c.outcomes[i]);
    free(c.outcomes);
    if (result->status != STATUS_OK && f != NULL)
        snprintf(f->text, sizeof f->text, "%s", result->reason);
    return result->status;
}

void solve_result_free(solve_result *r)
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
    free(r->matrices);
    free(r->quantity);
    free(r->step);
    shapes_free(&r->shapes);
    free(r->iteration);
    free(r->event);
    memset(r, 0, sizeof *r);
}
