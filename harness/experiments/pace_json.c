#include "harness/experiments/pace_json.h"

#include <math.h>
#include <string.h>

#include "harness/experiments/pace_reach.h"
#include "harness/experiments/pace_record.h"
#include "harness/formulations/environment.h"
#include "harness/records/json.h"
#include "harness/records/json_record.h"

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/* Does any group of the same case differ from this one in this parameter? */
static int varies(const pace *p, const pace_group *g, int parameter)
{
    for (int i = 0; i < p->groups; i++)
        if (p->group[i].type == g->type &&
            p->group[i].parameter[parameter] != g->parameter[parameter])
            return 1;
    return 0;
}

/* Which point a row is of: the differences from the defaults, and what varies by its name. */
static void add_point(json_t *row, const pace *p, const pace_group *g)
{
    char text[PARAMETERS_TEXT];
    const int count = parameters_count(g->type);
    parameters_text(g->type, g->parameter, text, sizeof text);
    json_object_set_new(row, "parameters", json_string(text));
    for (int i = 0; i < count; i++) {
        const parameter_type *one = parameter_at(g->type->parameters, i);
        if (!varies(p, g, i) || json_object_get(row, one->name) != NULL)
            continue;
        assignment_value_text(one, g->parameter[i], text, sizeof text);
        json_object_set_new(row, one->name,
                            one->choices != NULL ? json_string(text) : json_real(g->parameter[i]));
    }
}

static void add_row(json_t *list, json_t *row, const pace *p, const pace_group *g)
{
    add_point(row, p, g);
    json_array_append_new(list, row);
}

static void add_reference(json_t *list, const pace *p, const pace_group *g)
{
    const cell_result *cell = pace_cell_of(p, g->reference);
    add_row(list,
            json_pack("{s:s,s:f,s:i,s:s,s:s,s:o,s:o,s:f,s:o}", "integrator", "radau", "tolerance",
                      pace_reference[0], "steps", cell->solve.steps, "status",
                      status_name(cell->solve.status), "reason", g->reason, "uncertainty",
                      number(g->uncertainty), "order", number(g->order), "end", g->end,
                      "alone_from", number(g->from)),
            p, g);
}

/* Errors of each quantity by name. */
static json_t *values_of(const pace *p, const pace_run *r)
{
    const scene *s = &pace_point_of(p, r)->scene;
    json_t *out = json_object();
    for (int i = 0; r->values != NULL && i < s->quantities; i++)
        json_object_set_new(out, s->quantity[i].name, number(r->values[i]));
    return out;
}

static void add_runs(json_t *list, const pace *p, const pace_group *g)
{
    for (int i = g->first; i < g->first + g->runs; i++) {
        const subject one = pace_record_subject(p, &p->run[i]);
        json_t *run = json_record(&record_pace_run, &one, KEY_AROUND);
        if (g->reference >= 0)
            json_object_set_new(run, "errors", values_of(p, &p->run[i]));
        add_row(list, run, p, g);
    }
}

/* Names of quantities whose errors do not fall with the step. */
static json_t *standing_of(const pace *p, const pace_ladder *l)
{
    const scene *s = &pace_point_of(p, &p->run[l->first])->scene;
    json_t *out = json_array();
    for (int q = 0; q < s->quantities; q++)
        if (pace_order_stands(p, l, q))
            json_array_append_new(out, json_string(s->quantity[q].name));
    return out;
}

static void add_orders(json_t *list, const pace *p, const pace_group *g)
{
    for (int i = g->first; i < g->first + g->runs;) {
        const pace_ladder ladder = pace_order_of(p, i);
        const subject one = {.record = &ladder};
        if (ladder.count > 1) {
            json_t *row = json_record(&record_pace_ladder, &one, KEY_AROUND);
            json_object_set_new(row, "not_converging", standing_of(p, &ladder));
            add_row(list, row, p, g);
        }
        i += ladder.count;
    }
}

/* Who reaches which error at what cost, by level and integrator. */
static void add_reached(json_t *list, const pace *p, int group)
{
    const char *name[PACE_METHODS_MOST];
    const int count = pace_reach_methods(p, name);
    for (int l = 0; l < PACE_LEVELS; l++)
        for (int i = 0; i < count; i++) {
            const pace_reach one = pace_reach_of(p, group, name[i], pace_levels[l]);
            if (one.run != NULL)
                add_row(list,
                        json_pack("{s:f,s:s,s:f,s:f,s:f}", "error", pace_levels[l], "integrator",
                                  name[i], "cost", one.cost, "step", one.run->step, "tolerance",
                                  one.run->tolerance),
                        p, &p->group[group]);
        }
}

static int is_same(const pace_group *a, const pace_group *b)
{
    return a->type == b->type && strcmp(a->formulation.key, b->formulation.key) == 0 &&
           a->elements == b->elements;
}

static int is_first(const pace *p, int group)
{
    for (int i = 0; i < group; i++)
        if (is_same(&p->group[i], &p->group[group]))
            return 0;
    return 1;
}

/* All groups of one case, formulation and mesh. */
static json_t *case_of(const pace *p, const pace_group *g)
{
    json_t *references = json_array(), *runs = json_array(), *orders = json_array(),
           *reached = json_array(), *stability = json_array();
    for (int i = 0; i < p->groups; i++) {
        const pace_group *one = &p->group[i];
        if (!is_same(one, g))
            continue;
        add_runs(one->reference >= 0 ? runs : stability, p, one);
        if (one->reference < 0)
            continue;
        add_reference(references, p, one);
        add_orders(orders, p, one);
        add_reached(reached, p, i);
    }
    return json_pack("{s:s,s:s,s:i,s:o,s:o,s:o,s:o,s:o}", "case", g->type->name, "formulation",
                     g->formulation.key, "elements", g->elements, "references", references, "runs",
                     runs, "orders", orders, "reached", reached, "stability", stability);
}

static json_t *verdicts_of(const pace_verdicts *v)
{
    json_t *list = json_array();
    for (int i = 0; i < v->count; i++) {
        const pace_verdict *one = &v->verdict[i];
        json_array_append_new(
            list, json_pack("{s:s,s:s,s:s,s:s,s:i,s:s,s:s,s:s,s:s,s:b,s:s}", "judged", one->judged,
                            "case", one->case_name, "parameters", one->parameters, "formulation",
                            one->formulation, "elements", one->elements, "integrator",
                            one->integrator, "steps", one->steps, "verdict", one->found, "expected",
                            one->expected, "as_expected", one->as_expected, "why", one->why));
    }
    return list;
}

status pace_json(FILE *to, const pace *p, const pace_verdicts *v, fault *f)
{
    const environment e = environment_now(1);
    json_t *cases = json_array();
    for (int i = 0; i < p->groups; i++)
        if (is_first(p, i))
            json_array_append_new(cases, case_of(p, &p->group[i]));
    return json_finish(json_pack("{s:i,s:s,s:s,s:s,s:f,s:f,s:f,s:i,s:o,s:o}", "schema_version",
                                 SCHEMA_VERSION, "program_version", e.version, "commit", e.commit,
                                 "clock", e.clock, "growth", pace_growth, "exact_energy",
                                 pace_energy, "exact_momentum", pace_momentum, "unexpected",
                                 v->unexpected, "cases", cases, "verdicts", verdicts_of(v)),
                       to, f);
}
