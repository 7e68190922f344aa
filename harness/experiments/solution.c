#include "harness/experiments/solution.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/study/study.h"

static cell_request cell_of(const solution_request *r, const scene *s)
{
    cell_request out = {
        .scene = s, .elements = r->elements, .keep_all = r->keep_all, .threads = r->threads};
    if (r->formulation.type != NULL)
        cell_formulation(&out, &r->formulation);
    out.solve.steps_between = r->steps;
    return out;
}

void solution_choice_free(solution_choice *why)
{
    free(why->change);
    why->change = NULL;
}

/* What was preferred becomes what is asked for. */
static void take(solution_request *r, preference *p, solution_choice *why)
{
    r->formulation = p->chosen;
    r->elements = p->elements;
    memcpy(why->formulation, p->why_formulation, sizeof why->formulation);
    memcpy(why->elements, p->why_elements, sizeof why->elements);
    why->short_of = p->short_of;
    why->change = p->change;
    p->change = NULL;
}

/* With a scene that solution_choose frees. */
static status choose(solution_request *r, const rule *rules, int count, int elements, scene *s,
                     solution_choice *why, fault *f)
{
    const double asked = r->error > 0 ? r->error : PREFERENCE_ERROR;
    TRY(cell_scene(r->type, r->parameter, NULL, s, f));
    TRY(narrow_scene(s, r->type, r->parameter, &r->formulation, r->select, f));
    if (r->systems)
        scene_demand(s, FEATURE_MASS);
    const rule_subject where = {
        .type = r->type, .parameter = r->parameter, .features = features_needed(s)};
    const cell_request cell = cell_of(r, s);
    preference found;
    if (r->formulation.type == NULL && !(elements && r->elements == 0))
        return preference_formulation(s, &where, rules, count, &r->formulation, why->formulation,
                                      f);
    if (r->formulation.type == NULL)
        TRY(preference_both(&cell, &where, rules, count, asked, &found, f));
    else
        TRY(preference_elements(&cell, &r->formulation, asked, &found, f));
    take(r, &found, why);
    return STATUS_OK;
}

status solution_choose(solution_request *r, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f)
{
    scene s = {0};
    *why = (solution_choice){.formulation = ""};
    if (r->formulation.type != NULL && (!elements || r->elements > 0))
        return STATUS_OK;
    const status outcome = choose(r, rules, count, elements, &s, why, f);
    scene_free(&s);
    return outcome;
}

status solution_plan(const solution_request *r, sweep *s, fault *f)
{
    TRY(plan_one(r->type, r->parameter, &r->formulation, 1, &r->elements, 1, s, f));
    TRY(narrow_to(s, r->select, f));
    if (r->systems)
        scene_demand(&s->point[0].scene, FEATURE_MASS);
    return STATUS_OK;
}

/* What the choice of the mesh knows of the values. */
static status tell_change(const solution_request *r, const solution_choice *why, solve_result *out,
                          fault *f)
{
    const double asked = r->error > 0 ? r->error : PREFERENCE_ERROR;
    for (int i = 0; i < out->quantities && why->change != NULL; i++)
        out->quantity[i].change = why->change[i];
    if (!why->short_of || out->status != STATUS_OK)
        return out->status;
    out->status = STATUS_NOT_CONVERGED;
    snprintf(
        out->reason, sizeof out->reason,
        "with the mesh: %.200s, and %.3g %% was requested; -n %d computes it, or raise --error",
        why->elements, 100 * asked, 2 * r->elements);
    return fault_set(f, STATUS_NOT_CONVERGED, "%s", out->reason);
}

status solution_run(const solution_request *r, const solution_choice *why, sweep *s, fault *f)
{
    cell_request request = cell_of(r, &s->point[0].scene);
    cell_result *out = &s->series[0].cell[0];
    request.solve.shapes = r->shapes;
    request.solve.systems = r->systems;
    request.solve.keep_ends = r->keep_ends;
    /* what is drawn, written or gone on from is asked for */
    request.solve.all_analyses = r->shapes > 0 || r->systems || r->keep_ends;
    request.solve.looks = 1;
    request.solve.restarts = r->restarts;
    request.solve.restart = r->restart;
    TRY(cell_run(&request, out, f));
    return tell_change(r, why, &out->solve, f);
}
