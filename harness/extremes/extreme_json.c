#include "harness/extremes/extreme_json.h"

#include "harness/catalogue/environment.h"
#include "harness/extremes/extreme_record.h"
#include "harness/record/json.h"
#include "harness/record/json_record.h"

static json_t *extreme_of(const extreme *e)
{
    json_t *quantities = json_array(), *values = json_array();
    for (int i = 0; i < EXTREME_MAX_QUANTITIES && e->quantity[i].name != NULL; i++)
        json_array_append_new(quantities, json_string(e->quantity[i].name));
    for (int i = 0; i < e->values; i++)
        json_array_append_new(values, json_real(e->value[i]));
    return json_pack("{s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:f,s:o,s:o}", "name", e->name, "group",
                     e->group, "summary", e->summary, "case", e->base, "fixed", e->fixed, "x_name",
                     e->x_name, "x_unit", e->x_unit, "judge",
                     e->judge == EXTREME_EXACT ? "exact" : "same", "tolerance", e->tolerance,
                     "values", values, "quantities", quantities);
}

status extreme_json(FILE *to, const extreme_sweep *s, fault *f)
{
    const environment e = environment_now(1);
    json_t *table = json_array(), *counts = json_array(), *outcomes = json_array();
    for (int i = 0; extremes[i].name != NULL; i++)
        json_array_append_new(table, extreme_of(&extremes[i]));
    for (int i = 0; i < s->formulations; i++) {
        const extreme_count *c = &s->count[i];
        json_array_append_new(
            counts, json_pack("{s:s,s:i,s:i,s:i,s:i,s:i,s:i}", "formulation", s->formulation[i].key,
                              "tried", c->tried, "survived", c->survived, "coarse", c->coarse,
                              "named_failures", c->named, "wrong", c->wrong, "faults", c->faults));
    }
    for (int i = 0; i < s->outcomes; i++) {
        const subject one = extreme_record_subject(s, &s->outcome[i]);
        json_add_record(outcomes, &record_extreme, &one, KEY_AROUND);
    }
    json_t *root =
        json_pack("{s:i,s:s,s:s,s:s,s:i,s:i,s:o,s:o,s:o}", "schema_version", SCHEMA_VERSION,
                  "program_version", e.version, "commit", e.commit, "clock", e.clock, "unexpected",
                  s->unexpected, "unobserved_findings", s->unobserved, "extremes", table,
                  "formulations", counts, record_extreme.table, outcomes);
    return json_finish(root, to, f);
}
