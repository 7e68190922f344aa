#include <stdlib.h>
#include <string.h>

#include "elements/shared/number.h"
#include "harness/experiments/pace_plan.h"
#include "harness/experiments/pace_verdict.h"
#include "harness/formulations/formulations.h"

static const char head[] =
    "judged,case,parameters,formulation,elements,integrator,steps,expected,why";
enum { JUDGED, CASE, PARAMETERS, FORMULATION, ELEMENTS, INTEGRATOR, STEPS, EXPECTED, WHY };

static const char *const judged_names[PACE_JUDGED] = {"order", "energy", "momentum", "tolerance",
                                                      "fate"};

/* Of a row, and what it plans. */
typedef struct planned {
    pace_plan_request request;
    double parameter[CASE_MAX_PARAMETERS];
    pace_method method;
} planned;

static status read_kind(const char *word, pace_verdict *v, fault *f)
{
    int i = 0;
    while (i < PACE_JUDGED && strcmp(judged_names[i], word) != 0)
        i++;
    if (i == PACE_JUDGED)
        return fault_set(f, STATUS_REFUSED,
                         "'%.40s' is judged by nothing; give order, energy, momentum, tolerance or "
                         "fate",
                         word);
    v->kind = (pace_judged)i;
    return STATUS_OK;
}

static status read_elements(const char *text, int *out, fault *f)
{
    const char *end;
    double value;
    if (!number_read(text, &end, &value) || *end != '\0' || value < 1 || value > 1e6 ||
        value != (int)value)
        return fault_set(f, STATUS_REFUSED, "elements '%.40s': give a whole number", text);
    *out = (int)value;
    return STATUS_OK;
}

static status read_row(const own_table_row *row, pace_verdict *v, planned *out, fault *f)
{
    memset(out, 0, sizeof *out);
    *v = (pace_verdict){.judged = row->field[JUDGED],
                        .case_name = row->field[CASE],
                        .parameters = row->field[PARAMETERS],
                        .formulation = row->field[FORMULATION],
                        .integrator = row->field[INTEGRATOR],
                        .steps = row->field[STEPS],
                        .expected = row->field[EXPECTED],
                        .why = row->field[WHY]};
    TRY(read_kind(v->judged, v, f));
    TRY(read_elements(row->field[ELEMENTS], &v->elements, f));
    pace_plan_request *q = &out->request;
    q->type = case_find(v->case_name, f);
    if (q->type == NULL)
        return STATUS_REFUSED;
    parameters_default(q->type, out->parameter);
    TRY(parameters_parse(q->type, v->parameters, out->parameter, NULL, f));
    TRY(formulation_parse(v->formulation, &q->formulation, f));
    TRY(pace_method_read(v->integrator, (int)strlen(v->integrator), &out->method, f));
    const int by_tolerance = v->kind == PACE_TOLERANCE;
    TRY(pace_list_read("step", v->steps, by_tolerance ? 100 : 2,
                       by_tolerance ? &q->tolerances : &q->steps, f));
    q->elements = v->elements;
    q->parameter = out->parameter;
    q->errors = v->kind == PACE_ORDER || by_tolerance;
    q->whole = v->kind == PACE_FATE;
    return STATUS_OK;
}

/* Rows of the same motions, but for the integrator, follow each other and share their reference. */
static int is_same(const pace_verdict *a, const pace_verdict *b)
{
    return (a->kind == PACE_FATE) == (b->kind == PACE_FATE) &&
           (a->kind == PACE_TOLERANCE) == (b->kind == PACE_TOLERANCE) &&
           strcmp(a->case_name, b->case_name) == 0 && strcmp(a->parameters, b->parameters) == 0 &&
           strcmp(a->formulation, b->formulation) == 0 && a->elements == b->elements &&
           strcmp(a->steps, b->steps) == 0;
}

static int known_method(const planned *p, const pace_method list[], int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(list[i].name, p->method.name) == 0)
            return i;
    return -1;
}

/* Rows [first, end) become one group. */
static status plan_block(pace *p, pace_verdicts *all, planned row[], int first, int end, fault *f)
{
    pace_method list[PACE_LIST_MOST];
    pace_plan_request q = row[first].request;
    q.parameter = row[first].parameter;
    q.method = list;
    for (int i = first; i < end; i++) {
        q.errors |= row[i].request.errors;
        if (known_method(&row[i], list, q.methods) < 0 && q.methods < PACE_LIST_MOST)
            list[q.methods++] = row[i].method;
    }
    TRY(pace_plan_add(p, &q, f));
    const pace_group *g = &p->group[p->groups - 1];
    for (int i = first; i < end; i++) {
        pace_verdict *v = &all->verdict[i];
        v->group = p->groups - 1;
        v->count = q.steps.count + q.tolerances.count;
        v->first = g->first + v->count * known_method(&row[i], list, q.methods);
    }
    return STATUS_OK;
}

/* Of a row that is wrong. */
static status refuse(const char *path, const own_table_row *row, status outcome, const fault *why,
                     fault *f)
{
    return fault_set(f, outcome, "%.80s:%d: %.200s", path, row->line, why->text);
}

static status plan_rows(const char *path, pace *p, pace_verdicts *all, planned row[], fault *f)
{
    const own_table_row *line = all->table.row;
    fault why = {""};
    for (int i = 0; i < all->count; i++) {
        const status outcome = read_row(&line[i], &all->verdict[i], &row[i], &why);
        if (outcome != STATUS_OK)
            return refuse(path, &line[i], outcome, &why, f);
    }
    for (int first = 0, end; first < all->count; first = end) {
        end = first + 1;
        while (end < all->count && is_same(&all->verdict[first], &all->verdict[end]))
            end++;
        const status outcome = plan_block(p, all, row, first, end, &why);
        if (outcome != STATUS_OK)
            return refuse(path, &line[first], outcome, &why, f);
    }
    return STATUS_OK;
}

status pace_verdict_plan(const char *path, pace *p, pace_verdicts *all, fault *f)
{
    mistakes m = {.file = path};
    memset(all, 0, sizeof *all);
    TRY(own_table_read(path, head, &all->table, &m, f));
    TRY(mistakes_status(&m, f));
    all->count = all->table.rows;
    all->verdict = calloc((size_t)all->count + 1, sizeof *all->verdict);
    planned *row = calloc((size_t)all->count + 1, sizeof *row);
    const status outcome = all->verdict != NULL && row != NULL
                               ? plan_rows(path, p, all, row, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for verdicts");
    free(row);
    return outcome;
}
