/* Which cells a verification consists of. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/features.h"
#include "harness/model/missing.h"
#include "harness/catalogue/registry.h"
#include "harness/study/sweep.h"

static status add_point(sweep *s, const case_type *type, const double value[], fault *f)
{
    point *more = realloc(s->point, (size_t)(s->points + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for parameter points");
    s->point = more;
    point *p = &s->point[s->points++];
    memset(p, 0, sizeof *p);
    p->type = type;
    memcpy(p->parameter, value, (size_t)parameters_count(type) * sizeof *value);
    parameters_text(type, value, p->text, sizeof p->text);
    if (p->text[0] == '\0')
        snprintf(p->name, sizeof p->name, "default");
    else
        snprintf(p->name, sizeof p->name, "%012llx", (unsigned long long)(parameters_hash(type, value, NULL) >> 16));
    scene_init(&p->scene, type->name);
    fault why = {""};
    p->status = type->build(value, &p->scene, &why);
    if (p->status == STATUS_OK)
        p->status = scene_validate(&p->scene, &why);
    snprintf(p->reason, sizeof p->reason, "%s", why.text);
    return STATUS_OK;
}

static int known_point(const sweep *s, const case_type *type, const double value[])
{
    for (int i = 0; i < s->points; i++)
        if (s->point[i].type == type && memcmp(s->point[i].parameter, value, (size_t)parameters_count(type) * sizeof *value) == 0)
            return 1;
    return 0;
}

static int is_complete(const truth *row)
{
    for (int i = 0; row->type->parameters[i].name != NULL; i++)
        if (row->any[i])
            return 0;
    return 1;
}

static status plan_points(const truths *t, sweep *s, fault *f)
{
    for (int c = 0; registry_cases[c] != NULL; c++) {
        double value[CASE_MAX_PARAMETERS] = {0};
        parameters_default(registry_cases[c], value);
        status outcome = add_point(s, registry_cases[c], value, f);
        for (int i = 0; i < t->rows && outcome == STATUS_OK; i++)
            if (t->row[i].type == registry_cases[c] && is_complete(&t->row[i]) &&
                !known_point(s, registry_cases[c], t->row[i].parameter))
                outcome = add_point(s, registry_cases[c], t->row[i].parameter, f);
        if (outcome != STATUS_OK)
            return outcome;
    }
    return STATUS_OK;
}

static void add_mesh(series *s, int n)
{
    int at = 0;
    while (at < s->meshes && s->mesh[at] < n)
        at++;
    if ((at < s->meshes && s->mesh[at] == n) || s->meshes == SERIES_MAX_MESHES)
        return;
    for (int i = s->meshes++; i > at; i--)
        s->mesh[i] = s->mesh[i - 1];
    s->mesh[at] = n;
}

static status add_series(sweep *s, int index, const formulation *chosen, const truths *t, fault *f)
{
    series *more = realloc(s->series, (size_t)(s->seriess + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for series");
    s->series = more;
    series *one = &s->series[s->seriess++];
    const point *p = &s->point[index];
    memset(one, 0, sizeof *one);
    one->point = index;
    one->formulation = *chosen;
    if (p->status == STATUS_OK)
        model_missing(&p->scene, chosen->type, one->missing, sizeof one->missing);
    for (int i = 0; i < p->scene.meshes; i++)
        add_mesh(one, p->scene.mesh[i]);
    for (int i = 0; t != NULL && i < t->rows; i++)
        if (t->row[i].elements > 0 && strcmp(t->row[i].formulation, chosen->key) == 0 &&
            truth_holds(&t->row[i], p->type, p->parameter))
            add_mesh(one, t->row[i].elements);
    return STATUS_OK;
}

/* Does the quantity depend on what the formulation's options change? */
static int option_matters(const point *p, const formulation *chosen, const char *quantity)
{
    const unsigned features = formulation_bears_on(chosen);
    for (int q = 0; q < p->scene.quantities && features != 0; q++)
        if (strcmp(p->scene.quantity[q].name, quantity) == 0)
            return (features & model_quantity_needs(&p->scene, q)) != 0;
    return 1;
}

int sweep_selects(const sweep *s, const point *p, const formulation *chosen, const char *quantity)
{
    if (!option_matters(p, chosen, quantity))
        return 0;
    char text[PARAMETERS_TEXT + FORMULATION_KEY + 2 * FAULT_TEXT];
    snprintf(text, sizeof text, "%s/%s/%s/%s", p->type->name, p->text[0] != '\0' ? p->text : "default", chosen->key, quantity);
    return s->select == NULL || select_matches(s->select, text) > 0;
}

/* Formulations of one point: all, and the options that a discrete truth speaks of. */
static status plan_series(const sweep_request *request, const truths *t, sweep *s, int index, fault *f)
{
    const point *p = &s->point[index];
    formulation list[64];
    int count = 0;
    for (int i = 0; i < request->formulations && count < 64; i++)
        list[count++] = request->formulation[i];
    for (int i = 0; request->formulations == 0 && registry_formulations[i] != NULL && count < 64; i++)
        formulation_default(registry_formulations[i], &list[count++]);
    for (int i = 0; registry_formulations[i] != NULL && request->formulations == 0 && p->text[0] == '\0'; i++)
        for (int k = 0; registry_formulations[i]->options != NULL && registry_formulations[i]->options[k].name != NULL; k++)
            for (int choice = 0;
                 registry_formulations[i]->options[k].judged != 0 && choice <= registry_formulations[i]->options[k].max; choice++)
                count += count < 64 && formulation_choice(registry_formulations[i], k, choice, &list[count]);
    for (int i = 0; i < t->rows && request->formulations == 0; i++) {
        int known = t->row[i].formulation[0] == '\0' || !truth_holds(&t->row[i], p->type, p->parameter);
        for (int k = 0; k < count && !known; k++)
            known = strcmp(list[k].key, t->row[i].formulation) == 0;
        if (!known && count < 64 && formulation_parse(t->row[i].formulation, &list[count], NULL) == STATUS_OK)
            count++;
    }
    for (int i = 0; i < count; i++) {
        int selected = p->scene.quantities == 0 && sweep_selects(s, p, &list[i], "");
        for (int q = 0; q < p->scene.quantities && !selected; q++)
            selected = sweep_selects(s, p, &list[i], p->scene.quantity[q].name);
        const status outcome = selected ? add_series(s, index, &list[i], t, f) : STATUS_OK;
        if (outcome != STATUS_OK)
            return outcome;
    }
    return STATUS_OK;
}

static status alloc_cells(sweep *s, fault *f)
{
    for (int i = 0; i < s->seriess; i++) {
        if (s->series[i].cell != NULL)
            continue;
        s->series[i].cell = calloc((size_t)s->series[i].meshes + 1, sizeof *s->series[i].cell);
        if (s->series[i].cell == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for results");
    }
    return STATUS_OK;
}

status sweep_plan(const sweep_request *request, const truths *t, sweep *out, fault *f)
{
    memset(out, 0, sizeof *out);
    if (request->select != NULL && select_matches(request->select, "") < 0)
        return fault_set(f, STATUS_REFUSED, "selection '%.100s' is malformed; write words joined by and, or, not", request->select);
    out->select = request->select;
    status outcome = plan_points(t, out, f);
    for (int i = 0; i < out->points && outcome == STATUS_OK; i++)
        outcome = plan_series(request, t, out, i, f);
    if (outcome == STATUS_OK)
        outcome = alloc_cells(out, f);
    if (outcome != STATUS_OK)
        sweep_free(out);
    return outcome;
}

status sweep_add(sweep *s, const case_type *type, const double value[], const int mesh[], int meshes, fault *f)
{
    const status outcome = add_point(s, type, value, f);
    if (outcome == STATUS_OK && meshes > 0)
        scene_meshes(&s->point[s->points - 1].scene, meshes, mesh);
    return outcome;
}

status sweep_extend(sweep *s, const formulation chosen[], int count, fault *f)
{
    status outcome = STATUS_OK;
    for (int i = 0; i < count && outcome == STATUS_OK; i++)
        outcome = add_series(s, s->points - 1, &chosen[i], NULL, f);
    return outcome == STATUS_OK ? alloc_cells(s, f) : outcome;
}

status sweep_plan_one(const case_type *type, const double value[], const formulation chosen[], int count, const int mesh[],
                      int meshes, sweep *out, fault *f)
{
    memset(out, 0, sizeof *out);
    status outcome = sweep_add(out, type, value, mesh, meshes, f);
    if (outcome == STATUS_OK && out->point[0].status != STATUS_OK)
        outcome = fault_set(f, out->point[0].status, "%s", out->point[0].reason);
    if (outcome == STATUS_OK)
        outcome = sweep_extend(out, chosen, count, f);
    if (outcome != STATUS_OK)
        sweep_free(out);
    return outcome;
}

int sweep_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].missing[0] == '\0' && s->point[s->series[i].point].status == STATUS_OK ? s->series[i].meshes : 0;
    return cells;
}

void series_free(series *one)
{
    for (int k = 0; k < one->meshes && one->cell != NULL; k++)
        cell_result_free(&one->cell[k]);
    free(one->cell);
    free(one->noise);
    free(one->timing);
}

void sweep_free(sweep *s)
{
    for (int i = 0; i < s->seriess; i++)
        series_free(&s->series[i]);
    for (int i = 0; i < s->points; i++)
        scene_free(&s->point[i].scene);
    free(s->point);
    free(s->series);
    memset(s, 0, sizeof *s);
}

cell_request sweep_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const point *p = &s->point[one->point];
    cell_request out = {.type = p->type, .formulation = one->formulation.type, .elements = one->mesh[mesh]};
    memcpy(out.parameter, p->parameter, sizeof out.parameter);
    memcpy(out.option, one->formulation.option, sizeof out.option);
    out.solve.newton = one->formulation.newton;
    out.solve.steps_between = p->steps;
    out.solve.condition = p->condition;
    out.edit = p->edit;
    out.threads = s->threads;
    if (p->text[0] == '\0' && mesh == one->meshes - 1)
        out.solve.shapes = s->shapes;
    return out;
}
