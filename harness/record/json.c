#include "harness/record/json.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

#include "harness/record/json_path.h"

static json_t *features_of(unsigned features)
{
    json_t *list = json_array();
    for (unsigned bit = 1; bit <= FEATURE_CURVATURE; bit <<= 1)
        if (features & bit)
            json_array_append_new(list, json_string(model_feature_name(bit)));
    return list;
}

static json_t *parameters_of(const point *p)
{
    json_t *all = json_object();
    for (int i = 0; p->type->parameters[i].name != NULL; i++) {
        char text[64];
        if (p->type->parameters[i].choices != NULL) {
            parameters_value_text(&p->type->parameters[i], p->parameter[i], text, sizeof text);
            json_object_set_new(all, p->type->parameters[i].name, json_string(text));
        } else {
            json_object_set_new(all, p->type->parameters[i].name, json_real(p->parameter[i]));
        }
    }
    return all;
}

static json_t *options_of(const formulation *fm)
{
    json_t *all = json_object();
    const element_option *o = fm->type->options;
    for (int i = 0; o != NULL && o[i].name != NULL; i++) {
        char text[32];
        if (o[i].choices != NULL) {
            choice_name(o[i].choices, (int)fm->option[i], text, sizeof text);
            json_object_set_new(all, o[i].name, json_string(text));
        } else {
            json_object_set_new(all, o[i].name, json_real(fm->option[i]));
        }
    }
    char newton[32];
    choice_name(formulation_newtons, (int)fm->newton, newton, sizeof newton);
    json_object_set_new(all, "newton", json_string(newton));
    return all;
}

static json_t *counters_of(const cell_result *c)
{
    const counters *n = &c->counters;
    return json_pack("{s:i,s:i,s:i,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:f,s:I}", "elements", c->size.elements, "free",
                     c->size.free, "driven", c->size.driven, "strain_evaluations", (json_int_t)n->strain_evaluations,
                     "stress_evaluations", (json_int_t)n->stress_evaluations, "inertia_evaluations",
                     (json_int_t)n->inertia_evaluations, "iterations", (json_int_t)n->iterations, "steps", (json_int_t)n->steps,
                     "rejected_steps", (json_int_t)n->rejected_steps, "factorisations", (json_int_t)n->factorisations, "solutions",
                     (json_int_t)n->solutions, "factor_entries", (json_int_t)n->factor_entries, "factor_flops", n->factor_flops,
                     "negative_pivots", (json_int_t)n->negative_pivots);
}

/* All truths of the continuum that hold here, with the error against each. */
static json_t *truths_of(const point *p, const scene_quantity *q, double value, const truths *t)
{
    json_t *list = json_array();
    for (int i = 0; t != NULL && i < t->rows; i++) {
        const truth *row = &t->row[i];
        if (row->formulation[0] != '\0' || row->on_curve || strcmp(row->quantity, q->name) != 0 ||
            !truth_holds(row, p->type, p->parameter))
            continue;
        json_t *one = json_pack("{s:s,s:s,s:s}", "kind", row->kind, "model", row->model, "source", row->source);
        json_object_set_new(one, "value", json_number(row->value));
        json_object_set_new(one, "uncertainty", json_number(row->uncertainty));
        json_object_set_new(one, "error", json_number(relative_error(q, value, row->value)));
        json_array_append_new(list, one);
    }
    return list;
}

static void add_quantities(json_t *root, const point *p, const solve_result *r, const truths *t)
{
    json_t *values = json_array(), *curves = json_array();
    for (int i = 0; i < r->quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const quantity_result *v = &r->quantity[i];
        if (q->reduction == SCENE_CURVE) {
            json_t *one =
                json_pack("{s:s,s:s,s:s,s:s}", "name", q->name, "unit", q->unit, "x_name", q->x_name, "x_unit", q->x_unit);
            json_object_set_new(one, "x", json_numbers(v->curve.points, v->curve.x));
            json_object_set_new(one, "values", json_numbers(v->curve.points, v->curve.value));
            json_array_append_new(curves, one);
            continue;
        }
        json_t *one = json_pack("{s:s,s:s}", "name", q->name, "unit", q->unit);
        if (scene_convention(&p->scene, q) != NULL)
            json_object_set_new(one, "moments", json_string(scene_convention(&p->scene, q)));
        json_object_set_new(one, "value", json_number(v->value));
        if (!isfinite(v->value))
            json_object_set_new(one, "reason", json_string(v->reason[0] != '\0' ? v->reason : r->reason));
        json_object_set_new(one, "truths", truths_of(p, q, v->value, t));
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        json_object_set_new(one, "prediction",
                            json_prediction(q, row != NULL ? relative_error(q, q->prediction, row->value) : NAN));
        json_array_append_new(values, one);
    }
    json_object_set_new(root, "quantities", values);
    json_object_set_new(root, "curves", curves);
}

status json_finish(json_t *root, FILE *to, fault *f)
{
    const int bad = root == NULL || json_dumpf(root, to, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0 || fputc('\n', to) == EOF;
    json_decref(root);
    return bad ? fault_set(f, STATUS_FAULT, "the JSON could not be written (full disk or out of memory)") : STATUS_OK;
}

status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    json_t *left_out = json_array();
    for (int i = 0; i < c->left_out_lines; i++)
        json_array_append_new(left_out, json_string(c->left_out[i]));
    json_t *root =
        json_pack("{s:i,s:s,s:s,s:i,s:s,s:s}", "schema", 1, "case", p->type->name, "formulation", one->formulation.type->name,
                  "elements", one->mesh[0], "status", status_name(c->solve.status), "reason", c->solve.reason);
    json_object_set_new(root, "options", options_of(&one->formulation));
    json_object_set_new(root, "parameters", parameters_of(p));
    json_object_set_new(root, "features", features_of(c->size.features));
    json_object_set_new(root, "left_out", left_out);
    json_object_set_new(root, "counters", counters_of(c));
    json_object_set_new(root, "seconds", json_pack("{s:f,s:f}", "setup", c->solve.seconds_setup, "solve", c->solve.seconds_solve));
    if (c->solve.events > 0)
        json_object_set_new(root, "events", json_events(&c->solve));
    add_quantities(root, p, &c->solve, t);
    json_object_set_new(root, "steps", json_steps(&c->solve));
    json_object_set_new(root, "matrices", json_matrices(&c->solve));
    return json_finish(root, to, f);
}

static json_t *verdict_of(const sweep *s, const verdict *v)
{
    const series *one = &s->series[v->series];
    const point *p = &s->point[one->point];
    json_t *out = json_pack("{s:s,s:s,s:s,s:s,s:s,s:s,s:b}", "case", p->type->name, "parameters", p->text, "formulation",
                            one->formulation.key, "quantity", p->scene.quantity[v->quantity].name, "verdict", verdict_name(v->kind),
                            "expected", v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "?", "as_expected", v->matches);
    char sentence[2 * FAULT_TEXT];
    verdict_sentence(v, p->scene.quantity[v->quantity].least_order, sentence, sizeof sentence);
    json_object_set_new(out, "message", json_string(sentence));
    json_object_set_new(out, "reason", json_string(v->reason));
    json_object_set_new(out, "value", json_number(v->finest));
    json_object_set_new(out, "limit", json_number(v->fit.limit));
    json_object_set_new(out, "limit_uncertainty", json_number(v->fit.limit_uncertainty));
    json_object_set_new(out, "order", json_number(v->fit.order));
    json_object_set_new(out, "order_uncertainty", json_number(v->fit.order_uncertainty));
    json_object_set_new(out, "truth", v->truth != NULL ? json_number(v->truth->value) : json_null());
    json_object_set_new(out, "truth_uncertainty", v->truth != NULL ? json_number(v->truth->uncertainty) : json_null());
    json_object_set_new(out, "truth_kind", v->truth != NULL ? json_string(v->truth->kind) : json_null());
    json_object_set_new(out, "error", json_number(v->error));
    json_object_set_new(out, "model_truth", v->model_truth != NULL ? json_number(v->model_truth->value) : json_null());
    json_object_set_new(out, "model_truth_kind", v->model_truth != NULL ? json_string(v->model_truth->kind) : json_null());
    json_object_set_new(out, "model_error", json_number(v->model_error));
    json_object_set_new(out, "asymptotic_from", v->fit.from > 0 ? json_integer(v->fit.from) : json_null());
    json_object_set_new(out, "tolerance", json_number(v->tolerance));
    return out;
}

status json_write_verdicts(FILE *to, const sweep *s, const judgement *j, const environment *e, fault *f)
{
    json_t *list = json_array(), *discrete = json_array(), *counts = json_object();
    for (int i = 0; i < j->verdicts; i++)
        json_array_append_new(list, verdict_of(s, &j->verdict[i]));
    for (int i = 0; i < j->agreements; i++) {
        const agreement *a = &j->agreement[i];
        const series *one = &s->series[a->series];
        const point *p = &s->point[one->point];
        json_t *row = json_pack("{s:s,s:s,s:s,s:i,s:s,s:b,s:s}", "case", p->type->name, "parameters", p->text, "formulation",
                                one->formulation.key, "elements", one->mesh[a->mesh], "quantity",
                                p->scene.quantity[a->quantity].name, "agrees", a->good, "source", a->truth->source);
        json_object_set_new(row, "value", json_number(a->value));
        json_object_set_new(row, "stored", json_number(a->truth->value));
        json_array_append_new(discrete, row);
    }
    for (int k = 0; k < VERDICT_KINDS; k++)
        json_object_set_new(counts, verdict_name((verdict_kind)k), json_integer(j->by_kind[k]));
    json_t *root =
        json_pack("{s:i,s:s,s:s,s:s,s:s,s:i,s:i,s:i,s:i,s:i,s:i}", "schema", 1, "program_version", e->version, "commit", e->commit,
                  "compiler", e->compiler, "clock", e->clock, "cells", sweep_cells(s), "judged", j->judged, "unexpected",
                  j->unexpected, "disagreements", j->disagreements, "unobserved_findings", j->unobserved, "unmet_truths", j->unmet);
    json_object_set_new(root, "unfinished_cells", json_integer(s->unfinished));
    json_object_set_new(root, "counts", counts);
    json_object_set_new(root, "verdicts", list);
    json_object_set_new(root, "discrete", discrete);
    return json_finish(root, to, f);
}
