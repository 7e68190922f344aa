#include <math.h>
#include <string.h>

#include "harness/catalogue/environment.h"
#include "harness/extremes/stress.h"
#include "harness/record/json.h"
#include "harness/record/json_path.h"

static json_t *extreme_of(const extreme *e)
{
    json_t *quantities = json_array(), *values = json_array();
    for (int i = 0; i < EXTREME_MAX_QUANTITIES && e->quantity[i].name != NULL; i++)
        json_array_append_new(quantities, json_string(e->quantity[i].name));
    for (int i = 0; i < e->values; i++)
        json_array_append_new(values, json_real(e->value[i]));
    return json_pack("{s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:f,s:o,s:o}", "name", e->name, "group", e->group, "summary", e->summary,
                     "case", e->base, "fixed", e->fixed, "x_name", e->x_name, "x_unit", e->x_unit, "judge",
                     e->judge == EXTREME_EXACT ? "exact" : "same", "tolerance", e->tolerance, "values", values, "quantities",
                     quantities);
}

static json_t *outcome_of(const stress *s, const stress_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    const cell_result *c = stress_cell(s, o);
    json_t *neighbours = json_array();
    for (int i = 0; i < STRESS_NEIGHBOURS && o->neighbours >= 0; i++)
        json_array_append_new(neighbours, json_number(o->neighbour_error[i]));
    json_t *out =
        json_pack("{s:s,s:f,s:s,s:s,s:s,s:i,s:s,s:b,s:I,s:s,s:s,s:o}", "extreme", e->name, "x", o->x, "parameters",
                  s->first.point[o->point].text, "formulation", s->formulation[o->formulation].key, "quantity",
                  e->quantity[o->quantity].name, "elements", s->first.series[o->series].mesh[0], "outcome", stress_name(o->kind),
                  "as_expected", o->as_expected, "iterations", (json_int_t)c->counters.iterations, "reason", o->reason, "proof",
                  o->finding != NULL ? o->finding->proof : "", "neighbour_errors", neighbours);
    json_object_set_new(out, "value", json_number(o->result));
    json_object_set_new(out, "reference", json_number(o->reference));
    json_object_set_new(out, "error", json_number(o->error));
    json_object_set_new(out, "condition", c->counters.condition > 0 ? json_number(c->counters.condition) : json_null());
    return out;
}

status stress_json(FILE *to, const stress *s, fault *f)
{
    const environment e = environment_now(1);
    json_t *table = json_array(), *counts = json_array(), *outcomes = json_array();
    for (int i = 0; extremes[i].name != NULL; i++)
        json_array_append_new(table, extreme_of(&extremes[i]));
    for (int i = 0; i < s->formulations; i++) {
        const stress_count *c = &s->count[i];
        json_array_append_new(counts, json_pack("{s:s,s:i,s:i,s:i,s:i,s:i,s:i}", "formulation", s->formulation[i].key, "tried",
                                                c->tried, "survived", c->survived, "coarse", c->coarse, "named_failures", c->named,
                                                "wrong", c->wrong, "faults", c->faults));
    }
    for (int i = 0; i < s->outcomes; i++)
        json_array_append_new(outcomes, outcome_of(s, &s->outcome[i]));
    json_t *root = json_pack("{s:i,s:s,s:s,s:s,s:i,s:i,s:o,s:o,s:o}", "schema", 1, "program_version", e.version, "commit", e.commit,
                             "clock", e.clock, "unexpected", s->unexpected, "unobserved_findings", s->unobserved, "extremes", table,
                             "formulations", counts, "outcomes", outcomes);
    return json_finish(root, to, f);
}
