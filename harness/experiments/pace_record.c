#include "harness/experiments/pace_record.h"

#include "harness/records/fields_keys.h"

static const char *word_of_fate(int fate)
{
    return pace_fate_name((pace_fate)fate);
}

static const char *word_of_order(int kind)
{
    return pace_order_name((pace_order_kind)kind);
}

static const schema_field fields_of_run[] = {
    {"integrator", "", FIELD_TEXT, "with its parameter, where it has one",
     AT(pace_run, method.name), .key = KEY},
    {"step", "s", FIELD_DOUBLE, "of the integration; with a tolerance the first one",
     AT(pace_run, step), .key = KEY},
    {"tolerance", "1", FIELD_DOUBLE, "of the error of a step; 0: all steps are alike",
     AT(pace_run, tolerance), .key = KEY},
    {"status", "", FIELD_ENUM, "of the motion", AT(pace_run, status),
     .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "why it ended too early", TEXT_OF(RECORD, pace_run, reason)},
    {"stopped", "s", FIELD_DOUBLE, "last instant of a motion that ended too early",
     AT(pace_run, stopped)},
    {"error", "1", FIELD_DOUBLE,
     "of time: largest over stations, of places in parts of the size and of turns [rad]",
     AT(pace_run, error)},
    {"order", "1", FIELD_DOUBLE, "of the error, against the run before, of a longer step",
     AT(pace_run, order)},
    {"cost", "s", FIELD_DOUBLE, "counted work at the prices of the project", AT(pace_run, cost)},
    {"seconds", "s", FIELD_DOUBLE, "that the processor took", AT(pace_run, seconds)},
    {"steps", "1", FIELD_LONG, "that were kept", AT(pace_run, steps)},
    {"rejected", "1", FIELD_LONG, "steps that were tried in vain", AT(pace_run, rejected)},
    {"iterations_per_step", "1", FIELD_DOUBLE, "of Newton, of a step", AT(pace_run, iterations)},
    {"energy_drift", "1", FIELD_DOUBLE,
     "largest change of the energy since nothing acts, relative; of what is held or driven: of the "
     "energy less the work",
     AT(pace_run, energy)},
    {"momentum_drift", "1", FIELD_DOUBLE,
     "largest change of momentum and angular momentum since nothing acts, relative",
     AT(pace_run, momentum)},
    {"largest_energy", "1", FIELD_DOUBLE, "in parts of that when nothing acts any more",
     AT(pace_run, largest)},
    {"last_energy", "1", FIELD_DOUBLE, "in parts of that when nothing acts any more",
     AT(pace_run, last)},
    {"outcome", "", FIELD_ENUM, "grows, stops, bounded or exact; empty: something acts on it",
     AT(pace_run, fate), .word = word_of_fate, .words = PACE_FATES},
    {0}};
const record_type record_pace_run = {
    "run", "runs", "a motion by one integrator with one step or tolerance", {fields_of_run}};

static void get_integrator(const subject *s, field_value *out)
{
    schema_set_text(out, ((const pace_ladder *)s->record)->method->name);
}

static void get_nominal(const subject *s, field_value *out)
{
    schema_set_number(out, ((const pace_ladder *)s->record)->method->order);
}

static const schema_field fields_of_ladder[] = {
    {"integrator", "", FIELD_TEXT, "with its parameter, where it has one", .get = get_integrator,
     .key = KEY},
    {"nominal", "1", FIELD_DOUBLE, "order that it has where all is resolved", .get = get_nominal},
    {"order", "1", FIELD_DOUBLE, "of the last two errors above the floor", AT(pace_ladder, order)},
    {"order_before", "1", FIELD_DOUBLE, "of the two before", AT(pace_ladder, before)},
    {"floor", "1", FIELD_DOUBLE, "below which an error is the reference's or of rounding",
     AT(pace_ladder, floor)},
    {"verdict", "", FIELD_ENUM, "on the order", AT(pace_ladder, kind), .word = word_of_order,
     .words = PACE_ORDER_KINDS},
    {0}};
const record_type record_pace_ladder = {
    "order", "orders", "an integrator with steps that are halved", {fields_of_ladder}};

subject pace_record_subject(const pace *p, const pace_run *r)
{
    return (subject){.sweep = &p->sweep,
                     .point = pace_point_of(p, r),
                     .series = &p->sweep.series[r->series],
                     .record = r};
}
