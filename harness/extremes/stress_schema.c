/* The record of an outcome, for JSON and CSV. */
#include <math.h>

#include "harness/extremes/stress.h"
#include "harness/schema/fields_keys.h"

static const char *const names[STRESS_KINDS] = {"value",   "coarse",   "wrong", "not converged", "singular",
                                                "refused", "no value", "fault", "skip"};

const char *stress_name(stress_kind kind)
{
    return kind >= 0 && kind < STRESS_KINDS ? names[kind] : "?";
}

static const stress_outcome *outcome_of(const subject *s)
{
    return s->record;
}

static void get_extreme(const subject *s, field_value *out)
{
    field_text(out, extremes[outcome_of(s)->extreme].name);
}

static void get_group(const subject *s, field_value *out)
{
    field_text(out, extremes[outcome_of(s)->extreme].group);
}

static void get_base(const subject *s, field_value *out)
{
    field_text(out, extremes[outcome_of(s)->extreme].base);
}

static void get_quantity(const subject *s, field_value *out)
{
    const stress_outcome *o = outcome_of(s);
    field_text(out, extremes[o->extreme].quantity[o->quantity].name);
}

static void get_condition(const subject *s, field_value *out)
{
    const double condition = subject_cell(s)->counters.condition;
    field_number(out, condition > 0 ? condition : NAN);
}

static void get_proof(const subject *s, field_value *out)
{
    field_text(out, outcome_of(s)->finding != NULL ? outcome_of(s)->finding->proof : "");
}

static const char *word_of_outcome(int kind)
{
    return stress_name((stress_kind)kind);
}

static const schema_field fields_of_place[] = {{"extreme", "", FIELD_TEXT, "name of the extreme", .get = get_extreme},
                                               {"group", "", FIELD_TEXT, "of extremes", .get = get_group},
                                               {"case", "", FIELD_TEXT, "that is driven there", .get = get_base},
                                               {"x", "1", FIELD_DOUBLE, "what it is driven to", AT(stress_outcome, x)},
                                               {0}};
static const schema_field fields_of_outcome[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", .get = get_quantity},
    {"outcome", "", FIELD_ENUM, "of the run", AT(stress_outcome, kind), .word = word_of_outcome, .words = STRESS_KINDS},
    {"as_expected", "", FIELD_FLAG, "a value, coarse, or what a finding says", AT(stress_outcome, as_expected)},
    {"value", "unit", FIELD_DOUBLE, "that came out", AT(stress_outcome, result)},
    {"reference", "unit", FIELD_DOUBLE, "exact value, or that without the extreme", AT(stress_outcome, reference)},
    {"error", "1", FIELD_DOUBLE, "relative", AT(stress_outcome, error)},
    {"neighbour_error_1", "1", FIELD_DOUBLE, "on another mesh, where it was needed", AT(stress_outcome, neighbour_error[0])},
    {"neighbour_error_2", "1", FIELD_DOUBLE, "on the one that has more elements", AT(stress_outcome, neighbour_error[1])},
    {"condition", "1", FIELD_DOUBLE, "estimate of the tangent's", .get = get_condition},
    {"iterations", "1", FIELD_LONG, "of Newton", OF(CELL, cell_result, counters.iterations)},
    {"reason", "", FIELD_TEXT, "why there is no value", TEXT_OF(RECORD, stress_outcome, reason)},
    {"proof", "", FIELD_TEXT, "of the finding that expects it", .get = get_proof},
    {0}};
const record_type record_extreme = {"extreme",
                                    "outcomes",
                                    "a formulation at a value of an extreme",
                                    {fields_of_place, keys_of_series, key_of_mesh, fields_of_outcome}};

subject stress_subject(const stress *s, const stress_outcome *o)
{
    return (subject){.sweep = &s->first, .point = &s->first.point[o->point], .series = &s->first.series[o->series], .record = o};
}
