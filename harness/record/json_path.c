#include "harness/record/json_path.h"

#include <math.h>

json_t *json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *json_numbers(int count, const double value[])
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_number(value[i]));
    return list;
}

json_t *json_prediction(const scene_quantity *q, double error)
{
    if (q->predicted_by == NULL)
        return json_null();
    json_t *out = json_pack("{s:s}", "source", q->predicted_by);
    json_object_set_new(out, "value", json_number(q->prediction));
    json_object_set_new(out, "error", json_number(error));
    return out;
}

json_t *json_steps(const solve_result *r)
{
    json_t *list = json_array();
    for (int i = 0; i < r->steps; i++) {
        const step_record *k = &r->step[i];
        json_t *corrections = json_array(), *residuals = json_array();
        for (int j = 0; j < k->iterations; j++) {
            json_array_append_new(corrections, json_number(r->iteration[k->first + j].correction));
            json_array_append_new(residuals, json_number(r->iteration[k->first + j].residual));
        }
        json_t *one = json_pack("{s:f,s:f,s:i,s:i,s:i}", "path", k->path, "increment", k->increment, "iterations", k->iterations,
                                "rejected", k->rejected, "negative_pivots", k->negative_pivots);
        json_object_set_new(one, "incompatibility", json_number(k->incompatibility));
        json_object_set_new(one, "corrections", corrections);
        json_object_set_new(one, "residuals", residuals);
        json_array_append_new(list, one);
    }
    return list;
}

static json_t *matrix(const double value[36])
{
    json_t *rows = json_array();
    for (int i = 0; i < 6; i++)
        json_array_append_new(rows, json_numbers(6, value + 6 * i));
    return rows;
}

json_t *json_matrices(const solve_result *r)
{
    json_t *list = json_array();
    for (int i = 0; i < r->matrix_sets; i++) {
        const nodal_matrices *m = &r->matrices[i];
        for (int k = 0; k < m->stations; k++) {
            json_t *one =
                json_pack("{s:i,s:s,s:f}", "node", m->node, "moments", scene_moments_name(m->moments), "path", m->path[k]);
            json_object_set_new(one, "compliance", matrix(m->compliance + 36 * (size_t)k));
            json_object_set_new(one, "stiffness", matrix(m->stiffness + 36 * (size_t)k));
            json_array_append_new(list, one);
        }
    }
    return list;
}

json_t *json_events(const solve_result *r)
{
    json_t *list = json_array();
    for (int i = 0; i < r->events; i++) {
        const path_event *e = &r->event[i];
        json_t *one = json_pack("{s:s,s:i,s:i,s:i}", "kind", event_name(e->kind), "analysis", e->analysis, "negative_before",
                                e->negative_before, "negative_after", e->negative_after);
        json_object_set_new(one, "factor", json_number(e->factor));
        json_object_set_new(one, "control", json_number(e->control));
        json_object_set_new(one, "other_factor", json_number(e->other_factor));
        json_object_set_new(one, e->kind == EVENT_BRANCH_JUMP ? "distance" : "load_work", json_number(e->measure));
        json_array_append_new(list, one);
    }
    return list;
}
