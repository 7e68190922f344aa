#include "harness/experiments/extreme_record.h"

#include <math.h>

#include "harness/records/records.h"

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
    schema_set_text(out, outcome_of(s)->finding != NULL ? outcome_of(s)->finding->proof : "");
}

static const char *word_of_outcome(int kind)
{
    return outcome_name((outcome_kind)kind);
}

static const schema_field fields_of_place[] = {
    {"extreme", "", FIELD_TEXT, "name of the extreme", .get = get_extreme},
    {"group", "", FIELD_TEXT, "of extremes", .get = get_group},
    {"case", "", FIELD_TEXT, "that is driven there", .get = get_base},
    {"x", "1", FIELD_DOUBLE, "what it is driven to", AT(extreme_outcome, x)},
    {0}};
static const schema_field fields_of_outcome[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", .get = get_quantity},
    {"outcome", "", FIELD_ENUM, "of the run", AT(extreme_outcome, kind), .word = word_of_outcome,
     .words = OUTCOME_KINDS},
    {"as_expected", "", FIELD_FLAG, "a value, coarse, or what a finding says",
     AT(extreme_outcome, as_expected)},
    {"value", "unit", FIELD_DOUBLE, "that came out", AT(extreme_outcome, result)},
    {"reference", "unit", FIELD_DOUBLE, "exact value, or that without the extreme",
     AT(extreme_outcome, reference)},
    {"error", "1", FIELD_DOUBLE, "relative", AT(extreme_outcome, error)},
    {"neighbour_error_1", "1", FIELD_DOUBLE, "on another mesh, where it was needed",
     AT(extreme_outcome, neighbour_error[0])},
    {"neighbour_error_2", "1", FIELD_DOUBLE, "on the one that has more elements",
     AT(extreme_outcome, neighbour_error[1])},
    {"condition", "1", FIELD_DOUBLE, "estimate of the tangent's", .get = get_condition},
    {"iterations", "1", FIELD_LONG, "of Newton", OF(CELL, cell_result, counters.iterations)},
    {"reason", "", FIELD_TEXT, "why there is no value", TEXT_OF(RECORD, extreme_outcome, reason)},
    {"proof", "", FIELD_TEXT, "of the finding that expects it", .get = get_proof},
    {0}};
const record_type record_outcome = {
    "outcome",
    "outcomes",
    "a formulation at a value of an extreme",
    {fields_of_place, keys_of_series, key_of_mesh, fields_of_outcome}};

static const char *word_of_judge(int judge)
{
    return judge == EXTREME_EXACT ? "exact" : "same";
}

static const schema_field fields_of_extreme[] = {
    {"name", "", FIELD_TEXT, "of the extreme", TEXT_OF(RECORD, extreme, name)},
    {"group", "", FIELD_TEXT, "the same kind of it on several cases",
     TEXT_OF(RECORD, extreme, group)},
    {"summary", "", FIELD_TEXT, "what is varied", TEXT_OF(RECORD, extreme, summary)},
    {"case", "", FIELD_TEXT, "that is driven there", TEXT_OF(RECORD, extreme, base)},
    {"fixed", "", FIELD_TEXT, "parameters beside the defaults", TEXT_OF(RECORD, extreme, fixed)},
    {"x_name", "", FIELD_TEXT, "what it is driven to", TEXT_OF(RECORD, extreme, x_name)},
    {"x_unit", "", FIELD_TEXT, "its unit", TEXT_OF(RECORD, extreme, x_unit)},
    {"judge", "", FIELD_ENUM, "an exact value, or the value at another x", AT(extreme, judge),
     .word = word_of_judge, .words = EXTREME_SAME + 1},
    {"tolerance", "1", FIELD_DOUBLE, "relative, of a value", AT(extreme, tolerance)},
    {0}};
const record_type record_extreme = {
    "extreme", "extremes", "what cases are driven to", {fields_of_extreme}};

static const schema_field fields_of_count[] = {
    {"tried", "1", FIELD_INT, "cells: an extreme at one x, as bad as its worst quantity",
     AT(extreme_count, tried)},
    {"survived", "1", FIELD_INT, "of them, with values or coarse", AT(extreme_count, survived)},
    {"coarse", "1", FIELD_INT, "of these, coarse", AT(extreme_count, coarse)},
    {"named_failures", "1", FIELD_INT, "not converged, singular, refused, no value",
     AT(extreme_count, named)},
    {"wrong", "1", FIELD_INT, "numbers that are neither", AT(extreme_count, wrong)},
    {"faults", "1", FIELD_INT, "crashed, or out of memory", AT(extreme_count, faults)},
    {0}};
static const schema_field key_of_count[] = {
    {"formulation", "", FIELD_TEXT, "name, options that differ from their defaults",
     TEXT_OF(RECORD, extreme_count, formulation), .key = KEY},
    {0}};
const record_type record_extreme_count = {
    "count", "formulations", "what became of a formulation", {key_of_count, fields_of_count}};

/* x, or the name of a quantity, of an extreme. */
static const schema_field key_of_extreme[] = {
    {"extreme", "", FIELD_TEXT, "name of the extreme", .get = get_owner, .key = KEY}, {0}};
static const schema_field field_of_x[] = {
    {"x", "1", FIELD_DOUBLE, "what it is driven to", .get = get_x}, {0}};
static const record_type record_extreme_x = {
    "x", "extreme_values", "to what an extreme drives", {key_of_extreme, field_of_x}};
static const schema_field field_of_quantity[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", TEXT_OF(RECORD, extreme_quantity, name)},
    {0}};
static const record_type record_extreme_quantity = {"extreme_quantity",
                                                    "extreme_quantities",
                                                    "what is looked at",
                                                    {key_of_extreme, field_of_quantity}};

static const schema_field fields_of_all[] = {
    {"unexpected", "1", FIELD_INT, "outcomes that no finding expects",
     AT(extreme_sweep, unexpected)},
    {"unobserved_findings", "1", FIELD_INT, "findings of which nothing is seen",
     AT(extreme_sweep, unobserved)},
    {0}};
const record_type record_extremes_all = {"extremes", "", "of the run", {fields_of_all}};

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
