#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/model/model.h"

enum { LOOKED_AT = 9 };

typedef struct survey_selected {
    const char *select;
    select_words words;
    /* [formulations] 1: at least one quantity of the formulation is selected */
    char formulation[RANGES_FORMULATIONS];
    char runs[RANGES_FORMULATIONS];
    /* reason at the first point where the formulation does not run */
    const char *missing[RANGES_FORMULATIONS];
} survey_selected;

static status add_point(const parameter_ranges *r, long index, sweep *s, fault *f)
{
    double at[CASE_MAX_PARAMETERS], value[CASE_MAX_PARAMETERS];
    TRY(design_points(&r->design, index, 1, at, f));
    ranges_points_values(r, at, value);
    TRY(plan_add(s, r->request.type, value, NULL, r->request.mesh, r->request.meshes, f));
    return plan_extend(s, r->formulation, r->formulations, f);
}

/* Adds a quantity to the list, unless the list contains it. REFUSED: the list is full. */
static status add_quantity(parameter_ranges *r, const scene_quantity *q, fault *f)
{
    for (int i = 0; i < r->quantities; i++)
        if (strcmp(r->quantity[i].name, q->name) == 0)
            return STATUS_OK;
    if (r->quantities == RANGES_QUANTITIES)
        return fault_set(
            f, STATUS_REFUSED,
            "there are more than %d quantities; select some of them with -k, such as -k NAME",
            RANGES_QUANTITIES);
    ranges_quantity *out = &r->quantity[r->quantities++];
    snprintf(out->name, sizeof out->name, "%s", q->name);
    snprintf(out->unit, sizeof out->unit, "%s", q->unit);
    return STATUS_OK;
}

static status look_at(parameter_ranges *r, const sweep *s, int index, survey_selected *w, fault *f)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const int which = index % r->formulations;
    w->runs[which] |= one->missing[0] == '\0';
    if (one->missing[0] != '\0' && w->missing[which] == NULL)
        w->missing[which] = one->missing;
    for (int q = 0; q < p->scene.quantities; q++) {
        const scene_quantity *scene_value = &p->scene.quantity[q];
        char text[SWEEP_TEXT];
        if (scene_value->reduction == SCENE_CURVE)
            continue;
        sweep_text(p, &one->formulation, scene_value->name, text);
        select_meet(w->select, text, &w->words);
        if (w->select != NULL && select_matches(w->select, text) <= 0)
            continue;
        w->formulation[which] = 1;
        TRY(add_quantity(r, scene_value, f));
    }
    return STATUS_OK;
}

static status keep_running(parameter_ranges *r, const survey_selected *w, fault *f)
{
    int kept = 0, used = 0;
    for (int i = 0; i < r->formulations; i++) {
        const char *why = w->missing[i] != NULL ? w->missing[i] : "";
        if (w->runs[i] && w->formulation[i]) {
            r->formulation[kept++] = r->formulation[i];
            continue;
        }
        if (w->runs[i])
            continue;
        if (r->request.formulations > 0)
            return sweep_unsupported(r->formulation[i].key, why, r->request.type->name, f);
        if (used < (int)sizeof r->left_out)
            used += snprintf(r->left_out + used, sizeof r->left_out - (size_t)used, "%s%s (%s)",
                             used > 0 ? ", " : "", r->formulation[i].key, why);
    }
    r->formulations = kept;
    if (kept > 0 && r->quantities > 0)
        return STATUS_OK;
    return w->select != NULL
               ? narrow_to_nothing(w->select, r->request.type, f)
               : fault_set(f, STATUS_REFUSED,
                           "%.60s has no quantity with a single value that a formulation can "
                           "compute; choose another case, such as elastica",
                           r->request.type->name);
}

static void take_meshes(parameter_ranges *r, const sweep *s)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->point[s->series[i].point].status == STATUS_OK) {
            r->meshes = s->series[i].meshes;
            memcpy(r->mesh, s->series[i].mesh, sizeof r->mesh);
            return;
        }
}

static status evaluate(parameter_ranges *r, const sweep *s, fault *f)
{
    survey_selected w = {.select = r->request.select};
    int known = -1;
    TRY(select_begin(w.select, &w.words, f));
    for (int i = 0; i < s->seriess; i++)
        if (s->point[s->series[i].point].status == STATUS_OK) {
            known = s->series[i].point;
            TRY(look_at(r, s, i, &w, f));
        }
    if (known < 0)
        return fault_set(f, STATUS_REFUSED,
                         "no scene can be built at the points that were tried (%.200s); change the "
                         "ranges of --vary",
                         s->point[0].reason);
    TRY(narrow_check_words(&s->point[known], w.select, &w.words, f));
    scene_omission_words(features_omitted(&s->point[known].scene), r->omitted);
    assumptions_words(&s->point[known], sizeof r->assumed, r->assumed);
    take_meshes(r, s);
    return keep_running(r, &w, f);
}

static void take_formulations(parameter_ranges *r)
{
    const ranges_request *q = &r->request;
    r->formulations = q->formulations;
    for (int i = 0; i < q->formulations; i++)
        r->formulation[i] = q->formulation[i];
    for (int i = 0; q->formulations == 0 && formulations_at(i) != NULL; i++)
        if (r->formulations < RANGES_FORMULATIONS)
            formulation_default(formulations_at(i), &r->formulation[r->formulations++]);
}

/* estimated times [s] of a point, in addition to the cells: building the scene; computing a
 * reference value for a case; computing a reference value for a scene */
static const double scene_cost = 5e-5, derive_cost = 0.5, derive_scene_cost = 4;

static double cost_of(const sweep *s)
{
    double all = scene_cost * s->points;
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0' && s->point[s->series[i].point].status == STATUS_OK)
            for (int k = 0; k < s->series[i].meshes; k++)
                all += run_cost_of_cell(s, i, k);
    return all;
}

static status survey_points(parameter_ranges *r, sweep *s, fault *f)
{
    const long last = r->design.points - 1;
    const int points = last + 1 < LOOKED_AT ? (int)last + 1 : LOOKED_AT;
    take_formulations(r);
    for (int i = 0; i < points; i++)
        TRY(add_point(r, points > 1 ? last * i / (points - 1) : 0, s, f));
    TRY(evaluate(r, s, f));
    r->point_cost = cost_of(s) / points;
    if (r->request.derive != NULL)
        r->point_cost += r->request.file != NULL ? derive_scene_cost : derive_cost;
    return STATUS_OK;
}

status survey(parameter_ranges *r, fault *f)
{
    sweep s = {0};
    const status outcome = survey_points(r, &s, f);
    sweep_free(&s);
    return outcome;
}

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

/* Returns 1 if the selection includes the formulation. In both cases, records the words of the
 * selection that match. */
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
        return fault_memory(f, "a list of formulations");
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

static status add_outcomes(extreme_sweep *out, int extreme_index, int value, int formulation_index,
                           fault *f)
{
    const extreme *e = &extremes[extreme_index];
    const int last = out->first.points - 1;
    extreme_outcome *more =
        realloc(out->outcome, (size_t)(out->outcomes + EXTREME_MAX_QUANTITIES) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "outcomes");
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
