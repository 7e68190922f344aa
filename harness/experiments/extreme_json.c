#include "harness/experiments/extreme_json.h"

#include "harness/experiments/extreme_record.h"
#include "harness/formulations/environment.h"
#include "harness/records/json.h"
#include "harness/records/json_record.h"

/* Beside its fields: the values of x, and the quantities that are looked at. */
static json_t *extreme_of(const extreme *e)
{
    const subject one = {.record = e};
    json_t *out = json_record(&record_extreme, &one, KEY_AROUND), *quantities = json_array();
    for (int i = 0; i < EXTREME_MAX_QUANTITIES && e->quantity[i].name != NULL; i++)
        json_array_append_new(quantities, json_string(e->quantity[i].name));
    json_object_set_new(out, "values", json_record_numbers(e->values, e->value));
    json_object_set_new(out, "quantities", quantities);
    return out;
}

status extreme_json(FILE *to, const extreme_sweep *s, fault *f)
{
    const environment e = environment_now(1);
    json_t *table = json_array(), *counts = json_array(), *outcomes = json_array();
    for (int i = 0; extremes[i].name != NULL; i++)
        json_array_append_new(table, extreme_of(&extremes[i]));
    for (int i = 0; i < s->formulations; i++) {
        const subject one = {.record = &s->count[i]};
        json_record_add(counts, &record_extreme_count, &one, KEY_AROUND);
    }
    for (int i = 0; i < s->outcomes; i++) {
        const subject one = extreme_record_subject(s, &s->outcome[i]);
        json_record_add(outcomes, &record_outcome, &one, KEY_AROUND);
    }
    json_t *root =
        json_pack("{s:i,s:s,s:s,s:s,s:i,s:i,s:o,s:o,s:o}", "schema_version", SCHEMA_VERSION,
                  "program_version", e.version, "commit", e.commit, "clock", e.clock, "unexpected",
                  s->unexpected, "unobserved_findings", s->unobserved, record_extreme.table, table,
                  record_extreme_count.table, counts, record_outcome.table, outcomes);
    return json_finish(root, to, f);
}
