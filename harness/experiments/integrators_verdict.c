#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

/* Largest allowed difference of log10(error/tolerance); it corresponds to a factor of two. */
static const double same_decade = 0.3;

static void set_found(integrators_verdict *v, const char *word)
{
    const size_t at = strlen(v->found);
    snprintf(v->found + at, sizeof v->found - at, "%s%s", at > 0 ? " " : "", word);
}

static double drift_of(const integrators_verdict *v, const integrators_run *r)
{
    return v->kind == INTEGRATORS_ENERGY_CONSERVED ? r->energy : r->momentum;
}

/* Returns the order of the energy-balance or momentum error from the last two pairs of steps; 0:
 * there are fewer than three steps, or the two pairs do not give the same whole number. */
static int drift_order(const integrators_verdict *v, const integrators_run r[])
{
    double order[2];
    if (v->count < 3)
        return 0;
    for (int i = 0; i < 2; i++) {
        const integrators_run *fine = &r[v->count - 1 - i];
        order[i] = log(drift_of(v, fine - 1) / drift_of(v, fine)) / log(fine[-1].step / fine->step);
    }
    const double whole = round(order[0]);
    return fabs(order[0] - whole) <= integrators_order_slack &&
                   fabs(order[1] - whole) <= integrators_order_slack
               ? (int)whole
               : 0;
}

static void reach_drift(integrators_verdict *v, const integrators_run r[])
{
    const double most =
        v->kind == INTEGRATORS_ENERGY_CONSERVED ? integrators_energy : integrators_momentum;
    int kept = 1;
    for (int i = 0; i < v->count; i++)
        kept = kept && drift_of(v, &r[i]) <= most;
    const int order = drift_order(v, r);
    if (kept)
        set_found(v, "conserved");
    else if (order > 0)
        snprintf(v->found, sizeof v->found, "order %d", order);
    else
        set_found(v, "drifts");
}

static void reach_tolerance(integrators_verdict *v, const integrators_run r[])
{
    for (int i = 0; i < v->count; i++) {
        char text[16];
        snprintf(text, sizeof text, "%.1f", log10(r[i].error / r[i].tolerance));
        set_found(v, text);
    }
}

static void reach_one(const integrators *p, integrators_verdict *v)
{
    const integrators_run *r = &p->run[v->first];
    v->found[0] = '\0';
    if (v->kind == INTEGRATORS_ORDER)
        set_found(v, integrators_order_name(integrators_order_of(p, v->first).kind));
    else if (v->kind == INTEGRATORS_TOLERANCE)
        reach_tolerance(v, r);
    else if (v->kind != INTEGRATORS_CLASS)
        reach_drift(v, r);
    else
        for (int i = 0; i < v->count; i++)
            set_found(v, r[i].motion_class != INTEGRATORS_UNCLASSIFIED
                             ? integrators_class_name(r[i].motion_class)
                             : "unjudged");
}

/* Returns 1 if two lists have the same length, and their numbers differ by at most same_decade. */
static int is_near(const char *a, const char *b)
{
    while (*a != '\0' && *b != '\0') {
        double x, y;
        if (!number_read(a, &a, &x) || !number_read(b, &b, &y) || !(fabs(x - y) <= same_decade))
            return 0;
    }
    return *a == *b;
}

static int integrators_verdict_is_expected(const integrators_verdict *v)
{
    return v->kind == INTEGRATORS_TOLERANCE ? v->found[0] != '\0' && is_near(v->found, v->expected)
                                            : strcmp(v->found, v->expected) == 0;
}

void integrators_verdict_reach(const integrators *p, integrators_verdicts *all)
{
    all->unexpected = 0;
    for (int i = 0; i < all->count; i++) {
        integrators_verdict *v = &all->verdict[i];
        reach_one(p, v);
        v->as_expected = integrators_verdict_is_expected(v);
        all->unexpected += !v->as_expected;
    }
}

void integrators_verdict_free(integrators_verdicts *all)
{
    user_table_free(&all->table);
    free(all->verdict);
    memset(all, 0, sizeof *all);
}

static const char head[] =
    "judged,case,parameters,formulation,elements,integrator,steps,expected,why";
enum { CRITERION, CASE, PARAMETERS, FORMULATION, ELEMENTS, INTEGRATOR, STEPS, EXPECTED, WHY };

static const char *const criterion_names[INTEGRATORS_CRITERIA] = {"order", "energy", "momentum",
                                                                  "tolerance", "fate"};

typedef struct planned {
    integrators_plan_request request;
    double parameter[CASE_MAX_PARAMETERS];
    integrators_method method;
} planned;

static status read_kind(const char *word, integrators_verdict *v, fault *f)
{
    int i = 0;
    while (i < INTEGRATORS_CRITERIA && strcmp(criterion_names[i], word) != 0)
        i++;
    if (i == INTEGRATORS_CRITERIA)
        return fault_set(
            f, STATUS_REFUSED,
            "property '%.40s' has no verdict; give order, energy, momentum, tolerance or fate",
            word);
    v->kind = (integrators_criterion)i;
    return STATUS_OK;
}

static status read_elements(const char *text, int *out, fault *f)
{
    const char *end;
    double value;
    if (!number_read(text, &end, &value) || *end != '\0' || value < 1 || value > 1e6 ||
        value != (int)value)
        return fault_set(f, STATUS_REFUSED,
                         "elements '%.40s' is not valid; give a whole number from 1 to 1000000",
                         text);
    *out = (int)value;
    return STATUS_OK;
}

static status read_row(const user_table_row *row, integrators_verdict *v, planned *out, fault *f)
{
    memset(out, 0, sizeof *out);
    *v = (integrators_verdict){.criterion = row->field[CRITERION],
                               .case_name = row->field[CASE],
                               .parameters = row->field[PARAMETERS],
                               .formulation = row->field[FORMULATION],
                               .integrator = row->field[INTEGRATOR],
                               .steps = row->field[STEPS],
                               .expected = row->field[EXPECTED],
                               .why = row->field[WHY]};
    TRY(read_kind(v->criterion, v, f));
    TRY(read_elements(row->field[ELEMENTS], &v->elements, f));
    integrators_plan_request *q = &out->request;
    q->type = case_find(v->case_name, f);
    if (q->type == NULL)
        return STATUS_REFUSED;
    parameters_default(q->type, out->parameter);
    TRY(parameters_parse(q->type, v->parameters, out->parameter, NULL, f));
    TRY(formulation_parse(v->formulation, &q->formulation, f));
    TRY(integrators_method_read(v->integrator, (int)strlen(v->integrator), &out->method, f));
    const int by_tolerance = v->kind == INTEGRATORS_TOLERANCE;
    TRY(integrators_list_read("step", v->steps, by_tolerance ? 100 : 2,
                              by_tolerance ? &q->tolerances : &q->steps, f));
    q->elements = v->elements;
    q->parameter = out->parameter;
    q->errors = v->kind == INTEGRATORS_ORDER || by_tolerance;
    q->whole = v->kind == INTEGRATORS_CLASS;
    return STATUS_OK;
}

/* Returns 1 if two rows can share their runs and their reference because they have the same
 * structure, mesh, and steps or tolerances. */
static int is_same(const integrators_verdict *a, const integrators_verdict *b)
{
    return (a->kind == INTEGRATORS_CLASS) == (b->kind == INTEGRATORS_CLASS) &&
           (a->kind == INTEGRATORS_TOLERANCE) == (b->kind == INTEGRATORS_TOLERANCE) &&
           strcmp(a->case_name, b->case_name) == 0 && strcmp(a->parameters, b->parameters) == 0 &&
           strcmp(a->formulation, b->formulation) == 0 && a->elements == b->elements &&
           strcmp(a->steps, b->steps) == 0;
}

static int known_method(const planned *p, const integrators_method list[], int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(list[i].name, p->method.name) == 0)
            return i;
    return -1;
}

static status plan_block(integrators *p, integrators_verdicts *all, planned row[], int first,
                         int end, fault *f)
{
    integrators_method list[INTEGRATORS_LIST_MOST];
    integrators_plan_request q = row[first].request;
    q.parameter = row[first].parameter;
    q.method = list;
    for (int i = first; i < end; i++) {
        q.errors |= row[i].request.errors;
        if (known_method(&row[i], list, q.methods) < 0 && q.methods < INTEGRATORS_LIST_MOST)
            list[q.methods++] = row[i].method;
    }
    TRY(integrators_plan_add(p, &q, f));
    const integrators_group *g = &p->group[p->groups - 1];
    for (int i = first; i < end; i++) {
        integrators_verdict *v = &all->verdict[i];
        v->group = p->groups - 1;
        v->count = q.steps.count + q.tolerances.count;
        v->first = g->first + v->count * known_method(&row[i], list, q.methods);
    }
    return STATUS_OK;
}

static status refuse(const char *path, const user_table_row *row, status outcome, const fault *why,
                     fault *f)
{
    return fault_set(f, outcome, "%.80s:%d: %.200s", path, row->line, why->text);
}

static status plan_rows(const char *path, integrators *p, integrators_verdicts *all, planned row[],
                        fault *f)
{
    const user_table_row *line = all->table.row;
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

status integrators_verdict_plan(const char *path, integrators *p, integrators_verdicts *all,
                                fault *f)
{
    mistakes m = {.file = path};
    memset(all, 0, sizeof *all);
    TRY(user_table_read(path, head, &all->table, &m, f));
    TRY(mistakes_status(&m, f));
    all->count = all->table.rows;
    all->verdict = calloc((size_t)all->count + 1, sizeof *all->verdict);
    planned *row = calloc((size_t)all->count + 1, sizeof *row);
    const status outcome = all->verdict != NULL && row != NULL ? plan_rows(path, p, all, row, f)
                                                               : fault_memory(f, "verdicts");
    free(row);
    return outcome;
}

static double distance_of_check(const integrators *p, const integrators_group *g, int check)
{
    return integrators_distance(integrators_cell_of(p, g->reference + check),
                                integrators_cell_of(p, g->reference), g->analysis);
}

/* Returns the order of the error of the reference in the number of steps, from the checks of the
 * reference. near, far: distances of the two checks from the reference. */
static double order_of_reference(const integrators *p, const integrators_group *g, double near,
                                 double far)
{
    const double steps = (double)integrators_cell_of(p, g->reference + 1)->solve.steps /
                         (double)integrators_cell_of(p, g->reference + 2)->solve.steps;
    return steps > 1 && near > 0 ? log(far / near) / log(steps) : NAN;
}

/* Sets the uncertainty and the order of the reference. near, far: distances of the two checks from
 * the reference. The error of the reference is assumed to be near/far times `near`, with a safety
 * factor of three, and at most `near`. */
static void evaluate_reference(const integrators *p, integrators_group *g)
{
    static const double safety = 3;
    if (g->reference < 0) {
        snprintf(g->reason, sizeof g->reason, "none was requested");
        return;
    }
    const cell_result *reference = integrators_cell_of(p, g->reference);
    const double near = distance_of_check(p, g, 1), far = distance_of_check(p, g, 2);
    g->uncertainty = near * fmin(1, safety * near / far);
    g->order = order_of_reference(p, g, near, far);
    if (reference->solve.status != STATUS_OK)
        snprintf(g->reason, sizeof g->reason, "%s", reference->solve.reason);
    else if (isnan(g->uncertainty))
        snprintf(g->reason, sizeof g->reason, "its check: %.200s",
                 integrators_cell_of(p, g->reference + 1 + isfinite(near))->solve.reason);
}

static status errors_of(const integrators *p, const integrators_group *g, integrators_run *r,
                        fault *f)
{
    const scene *s = &integrators_point_of(p, r)->scene;
    const cell_result *cell = integrators_cell_of(p, r->series),
                      *reference = integrators_cell_of(p, g->reference);
    const int own = s->quantities,
              known = cell->solve.quantities == own && reference->solve.quantities >= own;
    r->values = malloc((size_t)(own + 1) * sizeof *r->values);
    if (r->values == NULL)
        return fault_memory(f, "errors");
    for (int i = 0; i < own; i++)
        r->values[i] = known ? integrators_distance_of(&s->quantity[i], &cell->solve.quantity[i],
                                                       &reference->solve.quantity[i])
                             : NAN;
    r->error = integrators_distance(cell, reference, g->analysis);
    return STATUS_OK;
}

static double last_station(const solve_result *r)
{
    return r->steps > 0 ? r->step[r->steps - 1].path : 0;
}

static status evaluate_run(const integrators *p, integrators_run *r, fault *f)
{
    const series *s = &p->sweep.series[r->series];
    const integrators_group *g = &p->group[r->group];
    const cell_result *cell = &s->cell[0];
    r->status = s->missing[0] == '\0' ? cell->solve.status : STATUS_REFUSED;
    r->reason = s->missing[0] == '\0' ? cell->solve.reason : s->missing;
    r->cost = counted_cost(&s->formulation, cell);
    r->seconds = cell->solve.seconds_solve;
    r->steps = cell->solve.steps;
    r->rejected = cell->counters.rejected_steps;
    r->iterations = r->steps > 0 ? (double)cell->solve.iterations / (double)r->steps : NAN;
    r->stopped = r->status != STATUS_OK ? last_station(&cell->solve) : NAN;
    r->error = NAN;
    integrators_drift(p, r);
    return g->reference >= 0 ? errors_of(p, g, r, f) : STATUS_OK;
}

status integrators_evaluate(integrators *p, const sweep_request *request, fault *f)
{
    TRY(run_sweep(request, &p->sweep, f));
    for (int i = 0; i < p->groups; i++)
        evaluate_reference(p, &p->group[i]);
    for (int i = 0; i < p->runs; i++)
        TRY(evaluate_run(p, &p->run[i], f));
    integrators_order_fill(p);
    return STATUS_OK;
}
