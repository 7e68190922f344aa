/* One cell in the result file: quantities, curves, steps, work. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/store.h"
#include "harness/record/store_path.h"

static void put_features(record *r, hid_t at, unsigned features)
{
    char text[256] = "";
    int used = 0;
    for (unsigned bit = 1; bit <= FEATURE_CURVATURE; bit <<= 1)
        if ((features & bit) && used < (int)sizeof text)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", used > 0 ? ", " : "", model_feature_name(bit));
    record_text(r, at, "features", text);
}

static void put_cost(record *r, hid_t at, const cell_result *c)
{
    const counters *n = &c->counters;
    record_count(r, at, "elements", c->size.elements);
    record_count(r, at, "free", c->size.free);
    record_count(r, at, "driven", c->size.driven);
    put_features(r, at, c->size.features);
    record_count(r, at, "strain_evaluations", n->strain_evaluations);
    record_count(r, at, "stress_evaluations", n->stress_evaluations);
    record_count(r, at, "inertia_evaluations", n->inertia_evaluations);
    record_count(r, at, "iterations", n->iterations);
    record_count(r, at, "load_steps", n->steps);
    record_count(r, at, "rejected_steps", n->rejected_steps);
    record_count(r, at, "factorisations", n->factorisations);
    record_count(r, at, "solutions", n->solutions);
    record_count(r, at, "factor_entries", n->factor_entries);
    record_number(r, at, "factor_flops", n->factor_flops);
    record_count(r, at, "negative_pivots", n->negative_pivots);
    record_number(r, at, "seconds_setup", c->solve.seconds_setup);
    record_number(r, at, "seconds_solve", c->solve.seconds_solve);
}

static void put_left_out(record *r, hid_t at, const cell_result *c)
{
    size_t size = 1;
    for (int i = 0; i < c->left_out_lines; i++)
        size += strlen(c->left_out[i]) + 2;
    char *text = calloc(size, 1), *end = text;
    r->bad |= text == NULL;
    for (int i = 0; i < c->left_out_lines && text != NULL; i++)
        end += sprintf(end, "%s%s", i > 0 ? "; " : "", c->left_out[i]);
    record_text(r, at, "left_out", text != NULL ? text : "");
    free(text);
}

static void put_curve(record *r, hid_t curves, const scene_quantity *q, const curve *c)
{
    const hid_t one = record_group(r, curves, q->name);
    const hsize_t size = (hsize_t)c->points;
    const hid_t x = record_values(r, one, "x", 1, &size, c->x, q->x_unit),
                y = record_values(r, one, "value", 1, &size, c->value, q->unit);
    record_text(r, x, "name", q->x_name);
    H5Dclose(x);
    H5Dclose(y);
    H5Gclose(one);
}

hid_t store_row_type(void)
{
    static const struct {
        const char *name;
        size_t offset, length; /* length 0: a double */
    } field[] = {{"name", offsetof(store_row, name), SCENE_NAME},
                 {"unit", offsetof(store_row, unit), 16},
                 {"moments", offsetof(store_row, moments), 16},
                 {"status", offsetof(store_row, status), 16},
                 {"reason", offsetof(store_row, reason), 128},
                 {"value", offsetof(store_row, value), 0},
                 {"error", offsetof(store_row, error), 0},
                 {"model_error", offsetof(store_row, model_error), 0},
                 {"x", offsetof(store_row, x), 0},
                 {"near_zero", offsetof(store_row, near_zero), 0},
                 {"prediction", offsetof(store_row, prediction), 0}};
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(store_row));
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        const hid_t text = field[i].length > 0 ? record_text_type(field[i].length) : -1;
        H5Tinsert(type, field[i].name, field[i].offset, text >= 0 ? text : H5T_NATIVE_DOUBLE);
        if (text >= 0)
            H5Tclose(text);
    }
    return type;
}

/* of[]: the verdict on each quantity, NULL where there is none. */
static void put_quantities(record *r, hid_t at, const point *p, const solve_result *result, const verdict *const of[])
{
    const hid_t curves = record_group(r, at, "curves"), type = store_row_type();
    store_row *row = calloc((size_t)result->quantities + 1, sizeof *row);
    r->bad |= row == NULL;
    for (int i = 0; i < result->quantities && row != NULL; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const quantity_result *v = &result->quantity[i];
        snprintf(row[i].name, sizeof row[i].name, "%s", q->name);
        snprintf(row[i].unit, sizeof row[i].unit, "%s", q->unit);
        const char *convention = scene_convention(&p->scene, q);
        snprintf(row[i].moments, sizeof row[i].moments, "%s", convention != NULL ? convention : "");
        snprintf(row[i].status, sizeof row[i].status, "%s", status_name(v->status));
        snprintf(row[i].reason, sizeof row[i].reason, "%.127s", v->reason);
        row[i].value = v->value;
        row[i].error = of[i] != NULL && of[i]->truth != NULL ? relative_error(q, v->value, of[i]->truth->value) : NAN;
        row[i].model_error =
            of[i] != NULL && of[i]->model_truth != NULL ? relative_error(q, v->value, of[i]->model_truth->value) : NAN;
        row[i].x = v->x;
        row[i].near_zero = q->near_zero;
        row[i].prediction = q->predicted_by != NULL ? q->prediction : NAN;
        if (v->curve.points > 0)
            put_curve(r, curves, q, &v->curve);
    }
    record_table(r, at, "quantities", type, result->quantities, row);
    free(row);
    H5Tclose(type);
    H5Gclose(curves);
}

void store_cell(record *r, hid_t at, const point *p, int elements, const cell_result *cell, const verdict *const of[])
{
    char name[32];
    snprintf(name, sizeof name, "n%d", elements);
    const hid_t mesh = record_group(r, at, name);
    record_text(r, mesh, "status", status_name(cell->solve.status));
    record_text(r, mesh, "reason", cell->solve.reason);
    record_count(r, mesh, "elements_per_member", elements);
    put_cost(r, mesh, cell);
    put_left_out(r, mesh, cell);
    store_steps(r, mesh, &cell->solve);
    store_matrices(r, mesh, &cell->solve);
    store_events(r, mesh, &cell->solve);
    put_quantities(r, mesh, p, &cell->solve, of);
    H5Gclose(mesh);
}
