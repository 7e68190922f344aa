#include "harness/records/json_convergence.h"

#include <math.h>
#include <stdlib.h>

#include "harness/records/gather.h"
#include "harness/records/json.h"
#include "harness/records/json_record.h"
#include "harness/records/reach_line.h"
#include "harness/study/study.h"

/* Of one quantity on every mesh: what was found, and the cell it was found by. */
static json_t *meshes_of(const gathering *g, int series_index, int quantity)
{
    json_t *all = json_array();
    for (int k = 0; k < g->sweep->series[series_index].meshes; k++) {
        subjects list = {0};
        const subject cell = gather_cell(g, series_index, k);
        json_t *one = json_record(&record_cell, &cell, KEY);
        gather_mesh(g, &record_quantity, series_index, k, &list);
        for (int i = 0; i < list.count; i++) {
            json_t *found = list.row[i].index == quantity
                                ? json_record(&record_quantity, &list.row[i], 0)
                                : NULL;
            json_object_update(one, found);
            json_decref(found);
        }
        json_array_append_new(all, one);
        gather_free(&list);
    }
    return all;
}

static json_t *quantity_of(const gathering *g, int series_index, int quantity)
{
    verdict v = {.series = series_index, .quantity = quantity};
    verdict_reach(g->sweep, g->truths, &v);
    v.matches = v.kind == v.expected;
    const subject s = gather_verdict(g, &v);
    json_t *out = json_record(&record_verdict, &s, 0);
    json_object_set_new(out, "meshes", meshes_of(g, series_index, quantity));
    return out;
}

static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

/* A curve: how far each mesh is from the finest one, and that from another formulation. */
static json_t *curve_of(const sweep *s, const series *one, int quantity, const series *other)
{
    const scene *what = &s->point[one->point].scene;
    const scene_quantity *q = &what->quantity[quantity];
    const int finest = curve_error_finest(one, quantity),
              best = curve_error_finest(other, quantity);
    json_t *meshes = json_array();
    for (int k = 0; k < one->meshes; k++) {
        const double error = finest < 0 ? NAN
                                        : curve_error_between(what, quantity, &one->cell[k].solve,
                                                              &one->cell[finest].solve, NULL);
        json_array_append_new(
            meshes, json_pack("{s:i,s:o}", "elements", one->mesh[k], "error", number(error)));
    }
    const double apart = finest < 0 || best < 0
                             ? NAN
                             : curve_error_between(what, quantity, &one->cell[finest].solve,
                                                   &other->cell[best].solve, NULL);
    return json_pack("{s:s,s:s,s:s,s:s,s:o,s:s,s:o}", "quantity", q->name, "unit", q->unit,
                     "x_name", q->x.name, "x_unit", q->x.unit, "meshes", meshes, "reference",
                     other->formulation.key, "reference_error", number(apart));
}

static json_t *curves_of(const sweep *s, const series *one)
{
    json_t *all = json_array();
    const scene *what = &s->point[one->point].scene;
    for (int q = 0; q < what->quantities && one->missing[0] == '\0'; q++) {
        const int reference =
            what->quantity[q].reduction == SCENE_CURVE ? curve_error_reference(s, q) : -1;
        if (reference >= 0)
            json_array_append_new(all, curve_of(s, one, q, &s->series[reference]));
    }
    return all;
}

/* The last line of the text. */
static json_t *sentence_of(const sweep *s, const truths *t, double level)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    reach_line_write(to, s, t, level);
    json_t *out = fclose(to) == 0 && size > 0 ? json_stringn(text, size - 1) : NULL;
    free(text);
    return out;
}

/* Formulations within the level, in the order of the line; rank 0: its verdict is not a pass, or
 * its cost ranks nothing. */
static json_t *answers_of(const sweep *s, const truths *t, double level)
{
    json_t *out = json_array();
    reach_question q = {.s = s, .point = 0, .quantity = REACH_EVERY, .level = level};
    verdict *all = reach_verdicts(s, t, &q.verdicts);
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    q.verdict = all;
    const int count = all != NULL && list != NULL ? reach_ranking(&q, list) : 0;
    const int ties = list != NULL ? reach_ties(list, count) : 0;
    for (int i = 0; i < count; i++) {
        const series *one = &s->series[list[i].series];
        const verdict *bad = list[i].defect;
        json_array_append_new(
            out,
            json_pack("{s:s,s:i,s:o,s:i,s:b,s:s}", "formulation", one->formulation.key, "elements",
                      one->mesh[list[i].mesh], "cost",
                      isfinite(list[i].cost) ? json_real(list[i].cost) : json_null(), "rank",
                      bad == NULL && isfinite(list[i].cost) ? i + 1 : 0, "tie",
                      ties > 1 && i < ties, "defect", bad == NULL ? "" : verdict_name(bad->kind)));
    }
    free(all);
    free(list);
    return out;
}

status json_convergence_write(FILE *to, const sweep *s, const truths *t, double level, fault *f)
{
    const gathering g = {s, NULL, t};
    json_t *all = json_array();
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const sweep_point *p = &s->point[one->point];
        json_t *quantities = json_array();
        if (one->missing[0] == '\0')
            for (int q = 0; q < p->scene.quantities; q++)
                if (p->scene.quantity[q].reduction != SCENE_CURVE)
                    json_array_append_new(quantities, quantity_of(&g, i, q));
        const subject here = {.sweep = s, .point = p, .series = one, .record = one};
        json_t *out = json_record(&record_series, &here, KEY_AROUND);
        json_object_set_new(out, record_quantity.table, quantities);
        json_object_set_new(out, record_curve.table, curves_of(s, one));
        json_array_append_new(all, out);
    }
    json_t *root = json_pack("{s:i,s:o,s:f,s:o,s:o}", "schema_version", SCHEMA_VERSION,
                             record_series.table, all, "level", level, "answers",
                             answers_of(s, t, level), "sentence", sentence_of(s, t, level));
    if (root != NULL)
        json_add_physics(root, &s->point[0]);
    return json_finish(root, to, f);
}
