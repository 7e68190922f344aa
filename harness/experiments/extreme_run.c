#include "harness/experiments/experiments_impl.h"

#include <fnmatch.h>
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static status extreme_expect_read(const char *path, extreme_sweep *out, fault *f);

enum {
    enough_elements = 16
}; /* with this number of elements or more, the neighbouring meshes are coarser; with fewer
      elements, they are finer */

static status refine(extreme_sweep *s, extreme_outcome *o, fault *f)
{
    const series *one = &s->first.series[o->series];
    const sweep_point *p = &s->first.point[o->point];
    if (o->neighbours >= 0)
        return STATUS_OK;
    const int n = one->mesh[0], coarser = n >= enough_elements;
    const int mesh[OUTCOME_NEIGHBOURS] = {coarser ? n / 4 : 2 * n, coarser ? n / 2 : 4 * n};
    s->neighbours.whole_only = 1;
    TRY(plan_add(&s->neighbours, p->type, p->parameter, &p->edit, mesh, OUTCOME_NEIGHBOURS, f));
    sweep_point *same = &s->neighbours.point[s->neighbours.points - 1];
    same->steps = p->steps;
    same->whole_steps = p->whole_steps;
    TRY(plan_extend(&s->neighbours, &one->formulation, 1, f));
    for (int i = 0; i < s->outcomes; i++)
        if (s->outcome[i].series == o->series)
            s->outcome[i].neighbours = s->neighbours.seriess - 1;
    return STATUS_OK;
}

static int is_open(const extreme_outcome *o)
{
    return o->kind == OUTCOME_WRONG && isfinite(o->error);
}

static status run_cells(const extreme_request *request, sweep *s, fault *f)
{
    const sweep_request run = {.jobs = request->jobs, .progress = request->progress};
    return run_sweep(&run, s, f);
}

static status look_closer(const extreme_request *request, extreme_sweep *s, const truths *t,
                          fault *f)
{
    for (int i = 0; i < s->outcomes; i++) {
        extreme_outcome *o = &s->outcome[i];
        if (!is_open(o))
            continue;
        TRY(refine(s, o, f));
        extreme_outcome *base = extreme_sweep_base(s, o);
        if (extremes[o->extreme].criterion == EXTREME_SAME && base != NULL)
            TRY(refine(s, base, f));
    }
    if (s->neighbours.seriess > 0)
        TRY(run_cells(request, &s->neighbours, f));
    for (int i = 0; i < s->outcomes; i++)
        if (is_open(&s->outcome[i]))
            extreme_evaluate_neighbours(s, t, &s->outcome[i]);
    return STATUS_OK;
}

static status read_all(const char *path, truths *t, extreme_sweep *out, fault *f)
{
    TRY(truths_read(path, t, f));
    TRY(truths_read_extremes(path, t, f));
    return extreme_expect_read(path, out, f);
}

static status plan(const void *requested, void *found, fault *f)
{
    const extreme_request *request = requested;
    extreme_sweep *s = found;
    TRY(read_all(request->truths, &s->truths, s, f));
    return extreme_plan(request, s, f);
}

static status run(const void *requested, void *found, fault *f)
{
    extreme_sweep *s = found;
    return s->outcomes > 0 ? run_cells(requested, &s->first, f) : STATUS_OK;
}

static status evaluate(const void *requested, void *found, fault *f)
{
    const extreme_request *request = requested;
    extreme_sweep *s = found;
    for (int i = 0; i < s->outcomes; i++)
        TRY(extreme_evaluate_first(s, &s->truths, &s->outcome[i], f));
    TRY(look_closer(request, s, &s->truths, f));
    extreme_expect(s, request->select == NULL && request->formulations == 0);
    return STATUS_OK;
}

const experiment_type experiment_stress = {.name = "stress",
                                           .plan = plan,
                                           .run = run,
                                           .evaluate = evaluate,
                                           .records = extreme_records,
                                           .about = &record_extremes_all,
                                           .rows = &record_outcome,
                                           .gather = extreme_gather,
                                           .print = extreme_table};

static status read_rows(table_columns *r, hid_t file, extreme_sweep *out)
{
    static const columns_field field[] = {
        {"extreme", COLUMN_TEXT, offsetof(extreme_deviation, extreme)},
        {"formulation", COLUMN_TEXT, offsetof(extreme_deviation, formulation)},
        {"quantity", COLUMN_TEXT, offsetof(extreme_deviation, quantity)},
        {"outcome", COLUMN_TEXT, offsetof(extreme_deviation, outcome)},
        {"proof", COLUMN_TEXT, offsetof(extreme_deviation, proof)},
        {"from", COLUMN_REAL, offsetof(extreme_deviation, from)},
        {"to", COLUMN_REAL, offsetof(extreme_deviation, to)}};
    TRY(columns_open(r, file));
    out->deviation = calloc((size_t)r->rows + 1, sizeof *out->deviation);
    if (out->deviation == NULL)
        return fault_memory(r->f, "known deviations");
    out->deviations = r->rows;
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++)
        TRY(columns_read(r, &field[i], out->deviation, sizeof *out->deviation));
    return STATUS_OK;
}

static status extreme_expect_read(const char *path, extreme_sweep *out, fault *f)
{
    table_columns r = {.path = path, .name = "extreme_findings", .f = f};
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    const status outcome = read_rows(&r, file, out);
    columns_close(&r);
    if (file >= 0)
        H5Fclose(file);
    return outcome;
}

static int applies_to(const extreme_deviation *row, const extreme_sweep *s,
                      const extreme_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    const double slack = 1e-9; /* covers the difference between 1e-4 in a table and pow(10, -4) */
    return o->x >= row->from * (1 - slack) && o->x <= row->to * (1 + slack) &&
           fnmatch(row->extreme, e->name, 0) == 0 &&
           fnmatch(row->formulation, s->formulation[o->formulation].key, 0) == 0 &&
           fnmatch(row->quantity, e->quantity[o->quantity].name, 0) == 0;
}

static int badness(outcome_kind kind)
{
    static const int rank[OUTCOME_KINDS] = {
        [OUTCOME_VALUE] = 1,         [OUTCOME_COARSE] = 2,   [OUTCOME_REFUSED] = 3,
        [OUTCOME_NOT_CONVERGED] = 3, [OUTCOME_SINGULAR] = 3, [OUTCOME_NO_VALUE] = 3,
        [OUTCOME_WRONG] = 4,         [OUTCOME_FAULT] = 5};
    return rank[kind];
}

static void count_cell(outcome_kind worst, extreme_count *c)
{
    c->tried += worst != OUTCOME_SKIP;
    c->survived += outcome_is_good(worst);
    c->coarse += worst == OUTCOME_COARSE;
    c->named += badness(worst) == 3;
    c->wrong += worst == OUTCOME_WRONG;
    c->faults += worst == OUTCOME_FAULT;
}

static void count_cells(extreme_sweep *s)
{
    outcome_kind worst = OUTCOME_SKIP;
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (i == 0 || o[-1].series != o->series || badness(o->kind) > badness(worst))
            worst = o->kind;
        if (i == s->outcomes - 1 || o[1].series != o->series)
            count_cell(worst, &s->count[o->formulation]);
    }
}

static void set_expected(extreme_sweep *s, extreme_outcome *o)
{
    o->deviation = NULL;
    o->as_expected = 1;
    if (o->kind == OUTCOME_SKIP)
        return;
    for (int k = 0; k < s->deviations; k++)
        if (applies_to(&s->deviation[k], s, o)) {
            o->deviation = &s->deviation[k];
            s->deviation[k].observed++;
            break;
        }
    o->as_expected = o->deviation != NULL
                         ? strcmp(o->deviation->outcome, outcome_name(o->kind)) == 0
                         : outcome_is_good(o->kind);
    const series one = {.formulation = s->formulation[o->formulation]};
    if (!o->as_expected && !sweep_gates(&s->first, &one)) {
        o->as_expected = 1;
        s->is_new++;
    }
}

void extreme_expect(extreme_sweep *s, int whole)
{
    for (int i = 0; i < s->outcomes; i++) {
        set_expected(s, &s->outcome[i]);
        s->unexpected += !s->outcome[i].as_expected;
    }
    if (whole)
        for (int k = 0; k < s->deviations; k++)
            s->unobserved += s->deviation[k].observed == 0;
    count_cells(s);
}

static const extreme_outcome *outcome_of(const subject *s)
{
    return s->record;
}

static void get_extreme(const subject *s, field_value *out)
{
    schema_set_text(out, extremes[outcome_of(s)->extreme].name);
}

static void get_group(const subject *s, field_value *out)
{
    schema_set_text(out, extremes[outcome_of(s)->extreme].group);
}

static void get_base(const subject *s, field_value *out)
{
    schema_set_text(out, extremes[outcome_of(s)->extreme].base);
}

static void get_quantity(const subject *s, field_value *out)
{
    const extreme_outcome *o = outcome_of(s);
    schema_set_text(out, extremes[o->extreme].quantity[o->quantity].name);
}

static void get_condition(const subject *s, field_value *out)
{
    const double condition = fields_keys_cell(s)->counters.condition;
    schema_set_number(out, condition > 0 ? condition : NAN);
}

static void get_owner(const subject *s, field_value *out)
{
    schema_set_text(out, ((const extreme *)s->owner)->name);
}

static void get_x(const subject *s, field_value *out)
{
    out->numbers = s->record;
}

static void get_proof(const subject *s, field_value *out)
{
    schema_set_text(out, outcome_of(s)->deviation != NULL ? outcome_of(s)->deviation->proof : "");
}

static const char *word_of_outcome(int kind)
{
    return outcome_name((outcome_kind)kind);
}

static const schema_field fields_of_place[] = {
    {"extreme", "", FIELD_TEXT, "name of the extreme", .get = get_extreme},
    {"group", "", FIELD_TEXT, "group of the extreme", .get = get_group},
    {"case", "", FIELD_TEXT, "case at the extreme", .get = get_base},
    {"x", "1", FIELD_DOUBLE, "extreme value", AT(extreme_outcome, x)},
    {0}};
static const schema_field fields_of_outcome[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", .get = get_quantity},
    {"outcome", "", FIELD_ENUM, "outcome of the run", AT(extreme_outcome, kind),
     .word = word_of_outcome, .words = OUTCOME_KINDS},
    {"as_expected", "", FIELD_FLAG,
     "true if the outcome is accurate, under-resolved or that of a known deviation",
     AT(extreme_outcome, as_expected)},
    {"value", "unit", FIELD_DOUBLE, "computed value", AT(extreme_outcome, result)},
    {"reference", "unit", FIELD_DOUBLE, "exact value, or the value without the extreme",
     AT(extreme_outcome, reference)},
    {"error", "1", FIELD_DOUBLE, "relative error", AT(extreme_outcome, error)},
    {"neighbour_error_1", "1", FIELD_DOUBLE,
     "error on the first other mesh; NaN if none was needed",
     AT(extreme_outcome, neighbour_error[0])},
    {"neighbour_error_2", "1", FIELD_DOUBLE,
     "error on the second other mesh, with more elements than the first; NaN if none was needed",
     AT(extreme_outcome, neighbour_error[1])},
    {"condition", "1", FIELD_DOUBLE, "estimated condition number of the tangent matrix",
     .get = get_condition},
    {"iterations", "1", FIELD_LONG, "Newton iterations",
     OF(CELL, cell_result, counters.iterations)},
    {"reason", "", FIELD_TEXT, "reason for a missing value",
     TEXT_OF(RECORD, extreme_outcome, reason)},
    {"proof", "", FIELD_TEXT, "proof of the known deviation that expects this outcome",
     .get = get_proof},
    {0}};
const record_type record_outcome = {
    "outcome",
    "outcomes",
    "results of a formulation at one value of an extreme",
    {fields_of_place, keys_of_series, key_of_mesh, fields_of_outcome}};

static const char *word_of_criterion(int criterion)
{
    return criterion == EXTREME_EXACT ? "exact" : "same";
}

static const schema_field fields_of_extreme[] = {
    {"name", "", FIELD_TEXT, "name of the extreme", TEXT_OF(RECORD, extreme, name)},
    {"group", "", FIELD_TEXT, "group: one kind of extreme on several cases",
     TEXT_OF(RECORD, extreme, group)},
    {"summary", "", FIELD_TEXT, "what is varied", TEXT_OF(RECORD, extreme, summary)},
    {"case", "", FIELD_TEXT, "case at the extreme", TEXT_OF(RECORD, extreme, base)},
    {"fixed", "", FIELD_TEXT, "parameters that differ from the defaults",
     TEXT_OF(RECORD, extreme, fixed)},
    {"x_name", "", FIELD_TEXT, "name of the varied value", TEXT_OF(RECORD, extreme, x_name)},
    {"x_unit", "", FIELD_TEXT, "unit of the varied value", TEXT_OF(RECORD, extreme, x_unit)},
    {"judge", "", FIELD_ENUM, "reference of the error: an exact value, or the value at another x",
     AT(extreme, criterion), .word = word_of_criterion, .words = EXTREME_SAME + 1},
    {"tolerance", "1", FIELD_DOUBLE, "relative tolerance of a value", AT(extreme, tolerance)},
    {0}};
const record_type record_extreme = {
    "extreme", "extremes", "extremes of cases", {fields_of_extreme}};

static const schema_field fields_of_count[] = {
    {"tried", "1", FIELD_INT,
     "number of runs; a run solves one value x of an extreme, and its worst quantity determines "
     "its outcome",
     AT(extreme_count, tried)},
    {"survived", "1", FIELD_INT, "number of accurate or under-resolved runs",
     AT(extreme_count, survived)},
    {"coarse", "1", FIELD_INT, "under-resolved runs", AT(extreme_count, coarse)},
    {"named_failures", "1", FIELD_INT,
     "number of runs with a reported failure: not converged, singular, rejected, no value",
     AT(extreme_count, named)},
    {"wrong", "1", FIELD_INT, "number of runs with wrong values", AT(extreme_count, wrong)},
    {"faults", "1", FIELD_INT, "number of runs that crashed or ran out of memory",
     AT(extreme_count, faults)},
    {0}};
static const schema_field key_of_count[] = {
    {"formulation", "", FIELD_TEXT,
     "name of the formulation, with options that differ from their defaults",
     TEXT_OF(RECORD, extreme_count, formulation), .key = KEY},
    {0}};
const record_type record_extreme_count = {
    "count", "formulations", "results of a formulation", {key_of_count, fields_of_count}};

static const schema_field key_of_extreme[] = {
    {"extreme", "", FIELD_TEXT, "name of the extreme", .get = get_owner, .key = KEY}, {0}};
static const schema_field field_of_x[] = {{"x", "1", FIELD_DOUBLE, "extreme value", .get = get_x},
                                          {0}};
static const record_type record_extreme_x = {
    "x", "extreme_values", "values of an extreme", {key_of_extreme, field_of_x}};
static const schema_field field_of_quantity[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", TEXT_OF(RECORD, extreme_quantity, name)},
    {0}};
static const record_type record_extreme_quantity = {"extreme_quantity",
                                                    "extreme_quantities",
                                                    "quantities of an extreme",
                                                    {key_of_extreme, field_of_quantity}};

static const schema_field fields_of_all[] = {
    {"unexpected", "1", FIELD_INT, "outcomes that no known deviation expects",
     AT(extreme_sweep, unexpected)},
    {"unobserved_findings", "1", FIELD_INT, "known deviations that were not observed",
     AT(extreme_sweep, unobserved)},
    {0}};
const record_type record_extremes_all = {"extremes", "", "outcome of the run", {fields_of_all}};

static subject subject_of_outcome(const extreme_sweep *s, const extreme_outcome *o)
{
    return (subject){.sweep = &s->first,
                     .point = &s->first.point[o->point],
                     .series = &s->first.series[o->series],
                     .record = o};
}

static void gather_outcomes(const extreme_sweep *s, subjects *out)
{
    for (int i = 0; i < s->outcomes; i++) {
        const subject one = subject_of_outcome(s, &s->outcome[i]);
        gather_add(out, &one);
    }
}

static void gather_record(subjects *out, const void *owner, const void *record)
{
    gather_add(out, &(subject){.owner = owner, .record = record});
}

static void gather_extreme(const extreme *e, const record_type *type, subjects *out)
{
    if (type == &record_extreme)
        gather_record(out, NULL, e);
    for (int i = 0; type == &record_extreme_x && i < e->values; i++)
        gather_record(out, e, &e->value[i]);
    for (int i = 0; type == &record_extreme_quantity && i < EXTREME_MAX_QUANTITIES &&
                    e->quantity[i].name != NULL;
         i++)
        gather_record(out, e, &e->quantity[i]);
}

void extreme_gather(const void *found, const record_type *type, subjects *out)
{
    const extreme_sweep *s = found;
    if (type == &record_extremes_all)
        gather_record(out, NULL, s);
    else if (type == &record_outcome)
        gather_outcomes(s, out);
    for (int i = 0; type == &record_extreme_count && i < s->formulations; i++)
        gather_record(out, NULL, &s->count[i]);
    for (int i = 0; extremes[i].name != NULL; i++)
        gather_extreme(&extremes[i], type, out);
}

const record_type *const extreme_records[] = {&record_extreme,          &record_extreme_x,
                                              &record_extreme_quantity, &record_extreme_count,
                                              &record_outcome,          NULL};
