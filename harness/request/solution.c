#include "harness/request/solution.h"

#include <string.h>

#include "harness/judge/preference.h"
#include "harness/model/features.h"
#include "harness/study/narrow.h"
#include "harness/study/plan.h"

static cell_request cell_of(const solution_request *r, const scene *s)
{
    cell_request out = {
        .scene = s, .elements = r->elements, .keep_all = r->keep_all, .threads = r->threads};
    if (r->formulation.type != NULL)
        cell_formulation(&out, &r->formulation);
    out.solve.steps_between = r->steps;
    return out;
}

/* With a scene that solution_choose frees. */
static status choose(solution_request *r, const rule *rules, int count, int elements, scene *s,
                     solution_choice *why, fault *f)
{
    TRY(cell_scene(r->type, r->parameter, NULL, s, f));
    TRY(narrow_scene(s, r->type, r->parameter, &r->formulation, r->select, f));
    if (r->systems)
        scene_demand(s, FEATURE_MASS);
    const rule_subject where = {
        .type = r->type, .parameter = r->parameter, .features = features_needed(s)};
    const cell_request cell = cell_of(r, s);
    if (r->formulation.type == NULL && elements && r->elements == 0) {
        preference both;
        TRY(preference_both(&cell, &where, rules, count, &both, f));
        r->formulation = both.chosen;
        r->elements = both.elements;
        memcpy(why->formulation, both.why_formulation, sizeof why->formulation);
        memcpy(why->elements, both.why_elements, sizeof why->elements);
        return STATUS_OK;
    }
    if (r->formulation.type == NULL)
        return preference_formulation(s, &where, rules, count, &r->formulation, why->formulation,
                                      f);
    if (elements && r->elements == 0)
        r->elements = preference_elements(&cell, &r->formulation, why->elements);
    return STATUS_OK;
}

status solution_choose(solution_request *r, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f)
{
    scene s = {0};
    *why = (solution_choice){"", ""};
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

status solution_run(const solution_request *r, sweep *s, fault *f)
{
    cell_request request = cell_of(r, &s->point[0].scene);
    request.solve.shapes = r->shapes;
    request.solve.systems = r->systems;
    request.solve.keep_ends = r->keep_ends;
    /* what is drawn, written or gone on from is asked for */
    request.solve.all_analyses = r->shapes > 0 || r->systems || r->keep_ends;
    request.solve.looks = 1;
    request.solve.restarts = r->restarts;
    request.solve.restart = r->restart;
    return cell_run(&request, &s->series[0].cell[0], f);
}
