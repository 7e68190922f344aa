#include "harness/experiments/extreme_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Decimal fractions as a table of truths has them. */
static double to_15_digits(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    return strtod(text, NULL);
}

static status set_parameters(const extreme *e, const case_type *type, double x, double value[],
                             fault *f)
{
    fault why = {""};
    parameters_default(type, value);
    if (parameters_parse(type, e->fixed, value, NULL, &why) != STATUS_OK)
        return fault_set(f, STATUS_FAULT, "extreme %s: %.200s", e->name, why.text);
    for (int i = 0; i < EXTREME_MAX_SETTINGS && e->setting[i].parameter != NULL; i++) {
        const extreme_setting *s = &e->setting[i];
        char assignment[96];
        snprintf(assignment, sizeof assignment, "%s=%.17g", s->parameter,
                 to_15_digits(s->offset + s->factor * pow(x, s->power)));
        if (parameters_set(type, assignment, value, &why) != STATUS_OK)
            return fault_set(f, STATUS_FAULT, "extreme %s: %.200s", e->name, why.text);
    }
    return STATUS_OK;
}

static scene_edit edit_of(const extreme *e, double x)
{
    if (e->knob == EXTREME_SPLIT)
        return (scene_edit){SCENE_EDIT_SPLIT, x};
    if (e->knob == EXTREME_REVERSE && x > 0)
        return (scene_edit){SCENE_EDIT_REVERSE, 0};
    return (scene_edit){SCENE_EDIT_NONE, 0};
}

/* Words of the selection are met whether it holds or not. */
static int is_selected(const extreme_request *request, const extreme *e, const formulation *chosen,
                       select_words *words)
{
    char text[3 * SCENE_NAME + FORMULATION_KEY];
    snprintf(text, sizeof text, "%s/%s/%s/%s", e->name, e->group, e->base, chosen->key);
    select_meet(request->select, text, words);
    return request->select == NULL || select_matches(request->select, text) > 0;
}

static status list_formulations(const extreme_request *request, extreme_sweep *out, fault *f)
{
    int all = 0;
    while (formulations_at(all) != NULL)
        all++;
    out->formulations = request->formulations > 0 ? request->formulations : all;
    out->formulation = calloc((size_t)out->formulations + 1, sizeof *out->formulation);
    out->count = calloc((size_t)out->formulations + 1, sizeof *out->count);
    if (out->formulation == NULL || out->count == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a list of formulations");
    for (int i = 0; i < out->formulations; i++) {
        if (request->formulations > 0)
            out->formulation[i] = request->formulation[i];
        else
            formulation_default(formulations_at(i), &out->formulation[i]);
        out->count[i].formulation = out->formulation[i].key;
    }
    return STATUS_OK;
}

static int quantity_index(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return i;
    return -1;
}

/* One outcome for every quantity of the series just planned. */
static status add_outcomes(extreme_sweep *out, int extreme_index, int value, int formulation_index,
                           fault *f)
{
    const extreme *e = &extremes[extreme_index];
    const int last = out->first.points - 1;
    extreme_outcome *more =
        realloc(out->outcome, (size_t)(out->outcomes + EXTREME_MAX_QUANTITIES) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for outcomes");
    out->outcome = more;
    for (int q = 0; q < EXTREME_MAX_QUANTITIES && e->quantity[q].name != NULL; q++) {
        if (quantity_index(&out->first.point[last].scene, e->quantity[q].name) < 0)
            return fault_set(f, STATUS_FAULT, "extreme %s: case %s has no quantity %s", e->name,
                             e->base, e->quantity[q].name);
        out->outcome[out->outcomes++] = (extreme_outcome){.extreme = extreme_index,
                                                          .value = value,
                                                          .formulation = formulation_index,
                                                          .quantity = q,
                                                          .point = last,
                                                          .series = out->first.seriess - 1,
                                                          .neighbours = -1,
                                                          .x = e->value[value],
                                                          .reason = ""};
    }
    return STATUS_OK;
}

static status plan_value(const extreme_request *request, extreme_sweep *out, int extreme_index,
                         int value, select_words *words, fault *f)
{
    const extreme *e = &extremes[extreme_index];
    const double x = e->value[value];
    const case_type *type = case_find(e->base, f);
    double parameter[CASE_MAX_PARAMETERS] = {0};
    const scene_edit edit = edit_of(e, x);
    const int mesh = e->knob == EXTREME_ELEMENTS ? (int)x : e->elements;
    if (type == NULL)
        return STATUS_FAULT;
    TRY(set_parameters(e, type, x, parameter, f));
    out->first.whole_only = 1;
    out->first.named = request->named;
    TRY(plan_add(&out->first, type, parameter, &edit, &mesh, 1, f));
    sweep_point *p = &out->first.point[out->first.points - 1];
    p->condition = 1;
    p->steps = e->knob == EXTREME_STEPS ? (int)x : 0;
    p->whole_steps = e->knob == EXTREME_WHOLE;
    for (int i = 0; i < out->formulations; i++) {
        if (!is_selected(request, e, &out->formulation[i], words))
            continue;
        TRY(plan_extend(&out->first, &out->formulation[i], 1, f));
        TRY(add_outcomes(out, extreme_index, value, i, f));
    }
    return STATUS_OK;
}

status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f)
{
    select_words words;
    TRY(select_begin(request->select, &words, f));
    TRY(list_formulations(request, out, f));
    for (int i = 0; extremes[i].name != NULL; i++)
        for (int k = 0; k < extremes[i].values; k++)
            TRY(plan_value(request, out, i, k, &words, f));
    return select_all_met(request->select, &words, f);
}
