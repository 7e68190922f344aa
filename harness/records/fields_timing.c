/* Records of benchmarks. */
#include <math.h>

#include "harness/records/fields_keys.h"
#include "harness/study/study.h"

static const cell_timing *timing_of(const subject *s)
{
    return s->record;
}

static const rounds_reading *reading_of(const field_value *out, const cell_timing *t)
{
    return out->of->offset < offsetof(cell_timing, keep_all) ? &t->as_is : &t->keep_all;
}

/* NAN where nothing was measured: a number at the offset, a round of it. */
static void get_measured(const subject *s, field_value *out)
{
    const cell_timing *t = timing_of(s);
    const double stored = *(const double *)((const char *)t + out->of->offset);
    schema_set_number(out, reading_of(out, t)->rounds > 0 ? stored : NAN);
}

static void get_round(const subject *s, field_value *out)
{
    get_measured(s, out);
    if (out->number == 0)
        out->number = NAN; /* there were fewer rounds */
}

static void get_least(const subject *s, field_value *out)
{
    const rounds_reading *c = &timing_of(s)->as_is;
    schema_set_number(out, c->rounds > 0 ? rounds_least(c) : NAN);
}

static void get_most(const subject *s, field_value *out)
{
    const rounds_reading *c = &timing_of(s)->as_is;
    schema_set_number(out, c->rounds > 0 ? rounds_most(c) : NAN);
}

static void get_dense_iteration(const subject *s, field_value *out)
{
    const dense_reference *dense = &timing_of(s)->dense;
    schema_set_number(out, dense->unknowns > 0 ? dense->iteration : NAN);
}

static void get_dense_seconds(const subject *s, field_value *out)
{
    const dense_reference *dense = &timing_of(s)->dense;
    schema_set_number(out,
                      dense->unknowns > 0
                          ? dense_reference_seconds(dense, fields_keys_cell(s)->counters.iterations)
                          : NAN);
}

static void get_dense_whole(const subject *s, field_value *out)
{
    out->whole = timing_of(s)->dense.whole.rounds > 0;
}

#define TIMES(member) AT(cell_timing, member)
static const schema_field fields_of_readings[] = {
    {"repeats", "1", FIELD_INT, "runs; 0: not measured", TIMES(as_is.repeats)},
    {"seconds_setup", "s", FIELD_DOUBLE, "of the fastest: set-up", TIMES(as_is.setup),
     .get = get_measured},
    {"seconds_solve", "s", FIELD_DOUBLE, "of the fastest: the rest", TIMES(as_is.solve),
     .get = get_measured},
    {"seconds_least", "s", FIELD_DOUBLE, "both together in the fastest round", .get = get_least},
    {"seconds_most", "s", FIELD_DOUBLE, "both together in the slowest round", .get = get_most},
    {"round_1", "s", FIELD_DOUBLE, "both together in a round", TIMES(as_is.round[0]),
     .get = get_round},
    {"round_2", "s", FIELD_DOUBLE, "both together in a round", TIMES(as_is.round[1]),
     .get = get_round},
    {"round_3", "s", FIELD_DOUBLE, "both together in a round", TIMES(as_is.round[2]),
     .get = get_round},
    {"round_4", "s", FIELD_DOUBLE, "both together in a round", TIMES(as_is.round[3]),
     .get = get_round},
    {"round_5", "s", FIELD_DOUBLE, "both together in a round", TIMES(as_is.round[4]),
     .get = get_round},
    {"keep_all_repeats", "1", FIELD_INT, "the same with all degrees of freedom",
     TIMES(keep_all.repeats)},
    {"keep_all_setup", "s", FIELD_DOUBLE, "set-up", TIMES(keep_all.setup), .get = get_measured},
    {"keep_all_solve", "s", FIELD_DOUBLE, "the rest", TIMES(keep_all.solve), .get = get_measured},
    {"keep_all_round_1", "s", FIELD_DOUBLE, "both together in a round", TIMES(keep_all.round[0]),
     .get = get_round},
    {"keep_all_round_2", "s", FIELD_DOUBLE, "both together in a round", TIMES(keep_all.round[1]),
     .get = get_round},
    {"keep_all_round_3", "s", FIELD_DOUBLE, "both together in a round", TIMES(keep_all.round[2]),
     .get = get_round},
    {"keep_all_round_4", "s", FIELD_DOUBLE, "both together in a round", TIMES(keep_all.round[3]),
     .get = get_round},
    {"keep_all_round_5", "s", FIELD_DOUBLE, "both together in a round", TIMES(keep_all.round[4]),
     .get = get_round},
    {"keep_all_free", "1", FIELD_INT, "unknowns with all degrees of freedom", TIMES(free_keep_all)},
    {0}};
static const schema_field fields_of_parts[] = {
    {"seconds_elements", "s", FIELD_DOUBLE, "of Newton's iterations: elements",
     TIMES(phase[PHASE_ELEMENTS])},
    {"seconds_assembly", "s", FIELD_DOUBLE, "assembly", TIMES(phase[PHASE_ASSEMBLY])},
    {"seconds_factorisation", "s", FIELD_DOUBLE, "factorisation",
     TIMES(phase[PHASE_FACTORISATION])},
    {"seconds_solution", "s", FIELD_DOUBLE, "solution", TIMES(phase[PHASE_SOLUTION])},
    {"seconds_rest", "s", FIELD_DOUBLE, "outside of the iterations: loads, compliance, modes",
     TIMES(phase[PHASE_REST])},
    {"dense_unknowns", "1", FIELD_INT, "of the published algorithm; 0: not measured",
     TIMES(dense.unknowns)},
    {"dense_iteration", "s", FIELD_DOUBLE, "its fastest iteration", .get = get_dense_iteration},
    {"dense_seconds", "s", FIELD_DOUBLE, "all of its iterations", .get = get_dense_seconds},
    {"dense_whole", "", FIELD_FLAG, "whole runs were timed, not one iteration times their number",
     .get = get_dense_whole},
    {0}};
const record_type record_timing = {
    "timing",
    "timings",
    "repeated runs of a cell",
    {keys_of_point, keys_of_series, key_of_mesh, fields_of_readings, fields_of_parts}};
