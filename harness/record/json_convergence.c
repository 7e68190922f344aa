#include <math.h>

#include "harness/record/json.h"
#include "harness/record/json_path.h"

static json_t *meshes_of(const point *p, const series *one, int q, const truth *row)
{
    json_t *list = json_array();
    for (int k = 0; k < one->meshes; k++) {
        const solve_result *r = &one->cell[k].solve;
        const double value = q < r->quantities ? r->quantity[q].value : NAN;
        json_t *mesh = json_pack("{s:i,s:i}", "elements", one->mesh[k], "free", one->cell[k].size.free);
        json_object_set_new(mesh, "value", json_number(value));
        json_object_set_new(mesh, "error",
                            json_number(row != NULL ? relative_error(&p->scene.quantity[q], value, row->value) : NAN));
        json_object_set_new(mesh, "seconds", json_number(r->seconds_setup + r->seconds_solve));
        if (!isfinite(value))
            json_object_set_new(mesh, "reason", json_string(q < r->quantities ? r->quantity[q].reason : r->reason));
        json_array_append_new(list, mesh);
    }
    return list;
}

static json_t *quantity_of(const sweep *s, const truths *t, int index, int q)
{
    const series *one = &s->series[index];
    const point *p = &s->point[one->point];
    verdict v = {.series = index, .quantity = q};
    verdict_reach(s, t, &v);
    json_t *out = json_pack("{s:s,s:s,s:s}", "name", p->scene.quantity[q].name, "unit", p->scene.quantity[q].unit, "verdict",
                            verdict_name(v.kind));
    char sentence[2 * FAULT_TEXT];
    verdict_sentence(&v, p->scene.quantity[q].least_order, sentence, sizeof sentence);
    json_object_set_new(out, "message", json_string(sentence));
    json_object_set_new(out, "asymptotic_from", v.fit.from > 0 ? json_integer(v.fit.from) : json_null());
    json_object_set_new(out, "limit", json_number(v.fit.limit));
    json_object_set_new(out, "limit_uncertainty", json_number(v.fit.limit_uncertainty));
    json_object_set_new(out, "order", json_number(v.fit.order));
    json_object_set_new(out, "order_uncertainty", json_number(v.fit.order_uncertainty));
    json_object_set_new(out, "truth", json_number(v.truth != NULL ? v.truth->value : NAN));
    json_object_set_new(out, "error", json_number(v.error));
    json_object_set_new(out, "model_error", json_number(v.model_error));
    const scene_quantity *asked = &p->scene.quantity[q];
    json_object_set_new(out, "prediction",
                        json_prediction(asked, v.truth != NULL ? relative_error(asked, asked->prediction, v.truth->value) : NAN));
    json_object_set_new(out, "meshes", meshes_of(p, one, q, v.truth));
    return out;
}

status json_write_convergence(FILE *to, const sweep *s, const truths *t, fault *f)
{
    json_t *all = json_array();
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const point *p = &s->point[one->point];
        json_t *quantities = json_array();
        for (int q = 0; q < p->scene.quantities && one->missing[0] == '\0'; q++)
            if (p->scene.quantity[q].reduction != SCENE_CURVE)
                json_array_append_new(quantities, quantity_of(s, t, i, q));
        json_array_append_new(all, json_pack("{s:s,s:s,s:s,s:s,s:o}", "case", p->type->name, "parameters", p->text, "formulation",
                                             one->formulation.key, "not_offered", one->missing, "quantities", quantities));
    }
    return json_finish(json_pack("{s:i,s:o}", "schema", 1, "series", all), to, f);
}
