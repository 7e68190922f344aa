#include "harness/run/store.h"

#include <hdf5.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/run/output.h"

/* Every call is checked; after the first failure nothing more is tried. */
typedef struct store {
    int bad;
} store;

static void check(store *s, int good)
{
    s->bad |= !good;
}

static hid_t text_type(size_t length)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length > 0 ? length : 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

static void put_text(store *s, hid_t at, const char *name, const char *text)
{
    const hid_t type = text_type(strlen(text)), space = H5Screate(H5S_SCALAR),
                a = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    char empty[1] = "";
    check(s, a >= 0 && H5Awrite(a, type, text[0] != '\0' ? text : empty) >= 0);
    H5Aclose(a);
    H5Sclose(space);
    H5Tclose(type);
}

static void put_number(store *s, hid_t at, const char *name, hid_t type, const void *value)
{
    const hid_t space = H5Screate(H5S_SCALAR), a = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    check(s, a >= 0 && H5Awrite(a, type, value) >= 0);
    H5Aclose(a);
    H5Sclose(space);
}

static void put_double(store *s, hid_t at, const char *name, double value)
{
    put_number(s, at, name, H5T_NATIVE_DOUBLE, &value);
}

static void put_long(store *s, hid_t at, const char *name, long value)
{
    put_number(s, at, name, H5T_NATIVE_LONG, &value);
}

/* New data set of rank 0, 1 or 2; the caller closes it. */
static hid_t put_doubles(store *s, hid_t at, const char *name, int rank, const hsize_t size[], const double value[])
{
    const hid_t space = rank > 0 ? H5Screate_simple(rank, size, NULL) : H5Screate(H5S_SCALAR);
    const hid_t set = H5Dcreate2(at, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const int empty = rank > 0 && size[0] == 0;
    check(s, set >= 0 && (empty || H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0));
    H5Sclose(space);
    return set;
}

static void put_texts(store *s, hid_t at, const char *name, int count, const char *const text[])
{
    size_t longest = 1;
    for (int i = 0; i < count; i++)
        longest = strlen(text[i]) > longest ? strlen(text[i]) : longest;
    char *all = calloc((size_t)count + 1, longest);
    const hsize_t size = (hsize_t)count;
    const hid_t type = text_type(longest), space = H5Screate_simple(1, &size, NULL);
    const hid_t set = H5Dcreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (int i = 0; i < count && all != NULL; i++)
        memcpy(all + (size_t)i * longest, text[i], strlen(text[i]));
    check(s, all != NULL && set >= 0 && (count == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0));
    free(all);
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
}

static hid_t group(store *s, hid_t at, const char *name)
{
    const hid_t g = H5Lexists(at, name, H5P_DEFAULT) > 0 ? H5Gopen2(at, name, H5P_DEFAULT)
                                                         : H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    check(s, g >= 0);
    return g;
}

static void put_environment(store *s, hid_t file, const environment *e)
{
    put_text(s, file, "schema", "beamwork-results");
    put_long(s, file, "schema_version", STORE_VERSION);
    put_text(s, file, "program_version", e->version);
    put_text(s, file, "commit", e->commit);
    put_text(s, file, "compiler", e->compiler);
    put_text(s, file, "flags", e->flags);
    put_text(s, file, "libraries", e->libraries);
    put_text(s, file, "processor", e->processor);
    put_text(s, file, "clock", e->clock);
    put_long(s, file, "threads", e->threads);
}

static void put_point(store *s, hid_t at, const point *p)
{
    put_text(s, at, "parameters", p->text);
    put_text(s, at, "summary", p->type->summary);
    put_text(s, at, "source", p->type->source);
    for (int i = 0; p->type->parameters[i].name != NULL; i++) {
        char name[80], text[64];
        snprintf(name, sizeof name, "parameter_%s", p->type->parameters[i].name);
        if (p->type->parameters[i].choices == NULL) {
            put_double(s, at, name, p->parameter[i]);
            continue;
        }
        parameters_value_text(&p->type->parameters[i], p->parameter[i], text, sizeof text);
        put_text(s, at, name, text);
    }
}

static void put_features(store *s, hid_t at, unsigned features)
{
    char text[256] = "";
    int used = 0;
    for (unsigned bit = 1; bit <= FEATURE_CURVATURE; bit <<= 1)
        if ((features & bit) && used < (int)sizeof text)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", used > 0 ? ", " : "", model_feature_name(bit));
    put_text(s, at, "features", text);
}

static void put_cost(store *s, hid_t at, const cell_result *c)
{
    const counters *n = &c->counters;
    put_long(s, at, "elements", c->size.elements);
    put_long(s, at, "free", c->size.free);
    put_long(s, at, "driven", c->size.driven);
    put_features(s, at, c->size.features);
    put_long(s, at, "strain_evaluations", n->strain_evaluations);
    put_long(s, at, "stress_evaluations", n->stress_evaluations);
    put_long(s, at, "inertia_evaluations", n->inertia_evaluations);
    put_long(s, at, "iterations", n->iterations);
    put_long(s, at, "load_steps", n->steps);
    put_long(s, at, "rejected_steps", n->rejected_steps);
    put_long(s, at, "factorisations", n->factorisations);
    put_long(s, at, "solutions", n->solutions);
    put_long(s, at, "factor_entries", n->factor_entries);
    put_double(s, at, "factor_flops", n->factor_flops);
    put_double(s, at, "seconds_setup", c->solve.seconds_setup);
    put_double(s, at, "seconds_solve", c->solve.seconds_solve);
}

static void put_left_out(store *s, hid_t at, const cell_result *c)
{
    char text[1024] = "";
    int used = 0;
    for (int i = 0; i < c->left_out_lines && used < (int)sizeof text; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", i > 0 ? "; " : "", c->left_out[i]);
    put_text(s, at, "left_out", text);
}

static void put_steps(store *s, hid_t at, const solve_result *r)
{
    enum { COLUMNS = 8 };
    const hsize_t size[2] = {(hsize_t)r->steps, COLUMNS};
    double *table = calloc((size_t)(r->steps + 1) * COLUMNS, sizeof *table);
    if (table == NULL) {
        s->bad = 1;
        return;
    }
    for (int i = 0; i < r->steps; i++) {
        const step_record *k = &r->step[i];
        const double row[COLUMNS] = {k->path,     k->increment,  k->iterations,     k->rejected, k->negative_pivots,
                                     k->residual, k->correction, k->incompatibility};
        memcpy(table + COLUMNS * (size_t)i, row, sizeof row);
    }
    const hid_t set = put_doubles(s, at, "steps", 2, size, table);
    put_text(s, set, "columns", "path increment iterations rejected negative_pivots residual correction incompatibility");
    H5Dclose(set);
    free(table);
}

/* One row of a mesh's quantities. */
typedef struct quantity_row {
    char name[SCENE_NAME], unit[16], status[16], reason[128];
    double value, error, x;
} quantity_row;

static hid_t row_type(void)
{
    static const struct {
        const char *name;
        size_t offset, length; /* length 0: a double */
    } field[] = {{"name", offsetof(quantity_row, name), SCENE_NAME},
                 {"unit", offsetof(quantity_row, unit), 16},
                 {"status", offsetof(quantity_row, status), 16},
                 {"reason", offsetof(quantity_row, reason), 128},
                 {"value", offsetof(quantity_row, value), 0},
                 {"error", offsetof(quantity_row, error), 0},
                 {"x", offsetof(quantity_row, x), 0}};
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(quantity_row));
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        const hid_t text = field[i].length > 0 ? text_type(field[i].length) : -1;
        H5Tinsert(type, field[i].name, field[i].offset, text >= 0 ? text : H5T_NATIVE_DOUBLE);
        if (text >= 0)
            H5Tclose(text);
    }
    return type;
}

static void put_curve(store *s, hid_t curves, const scene_quantity *q, const curve *c)
{
    const hid_t one = group(s, curves, q->name);
    const hsize_t size = (hsize_t)c->points;
    const hid_t x = put_doubles(s, one, "x", 1, &size, c->x), y = put_doubles(s, one, "value", 1, &size, c->value);
    put_text(s, x, "name", q->x_name);
    put_text(s, x, "unit", q->x_unit);
    put_text(s, y, "unit", q->unit);
    H5Dclose(x);
    H5Dclose(y);
    H5Gclose(one);
}

static void put_quantities(store *s, hid_t at, const point *p, const solve_result *r, const truth *const truth_row[])
{
    const hid_t curves = group(s, at, "curves");
    quantity_row *row = calloc((size_t)r->quantities + 1, sizeof *row);
    for (int i = 0; i < r->quantities && row != NULL; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const quantity_result *v = &r->quantity[i];
        snprintf(row[i].name, sizeof row[i].name, "%s", q->name);
        snprintf(row[i].unit, sizeof row[i].unit, "%s", q->unit);
        snprintf(row[i].status, sizeof row[i].status, "%s", status_name(v->status));
        snprintf(row[i].reason, sizeof row[i].reason, "%.127s", v->reason);
        row[i].value = v->value;
        row[i].error = truth_row[i] != NULL ? relative_error(q, v->value, truth_row[i]->value) : NAN;
        row[i].x = v->x;
        if (v->curve.points > 0)
            put_curve(s, curves, q, &v->curve);
    }
    const hsize_t size = (hsize_t)r->quantities;
    const hid_t type = row_type(), space = H5Screate_simple(1, &size, NULL),
                set = H5Dcreate2(at, "quantities", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    check(s, row != NULL && set >= 0 && (size == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, row) >= 0));
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
    free(row);
    H5Gclose(curves);
}

/* The verdicts of one series: parallel columns. */
static void put_verdicts(store *s, hid_t at, const sweep *all, const judgement *j, int index)
{
    enum { MOST = 256, NUMBERS = 10 };
    static const char *const number_name[NUMBERS] = {"truth", "truth_uncertainty", "limit",       "limit_uncertainty", "order",
                                                     "error", "model_truth",       "model_error", "tolerance",         "finest"};
    const char *text[7][MOST];
    double number[NUMBERS][MOST];
    int count = 0;
    const point *p = &all->point[all->series[index].point];
    for (int i = 0; i < j->verdicts && count < MOST; i++) {
        const verdict *v = &j->verdict[i];
        if (v->series != index)
            continue;
        const char *const words[7] = {p->scene.quantity[v->quantity].name,
                                      verdict_name(v->kind),
                                      v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "?",
                                      v->truth != NULL ? v->truth->kind : "",
                                      v->reason,
                                      v->finding != NULL ? v->finding->proof : "",
                                      v->truth != NULL ? v->truth->source : ""};
        const double values[NUMBERS] = {v->truth != NULL ? v->truth->value : NAN,
                                        v->truth != NULL ? v->truth->uncertainty : NAN,
                                        v->fit.limit,
                                        v->fit.limit_uncertainty,
                                        v->fit.order,
                                        v->error,
                                        v->model_truth != NULL ? v->model_truth->value : NAN,
                                        v->model_error,
                                        v->tolerance,
                                        v->finest};
        for (int k = 0; k < 7; k++)
            text[k][count] = words[k];
        for (int k = 0; k < NUMBERS; k++)
            number[k][count] = values[k];
        count++;
    }
    static const char *const text_name[7] = {"quantity", "verdict", "expected", "kind", "reason", "proof", "source"};
    const hid_t g = group(s, at, "verdicts");
    const hsize_t size = (hsize_t)count;
    for (int k = 0; k < 7; k++)
        put_texts(s, g, text_name[k], count, text[k]);
    for (int k = 0; k < NUMBERS; k++)
        H5Dclose(put_doubles(s, g, number_name[k], 1, &size, number[k]));
    H5Gclose(g);
}

static void put_series(store *s, hid_t cases, const sweep *all, const judgement *j, int index)
{
    const series *one = &all->series[index];
    const point *p = &all->point[one->point];
    const truth *truth_row[256] = {NULL};
    for (int i = 0; i < j->verdicts; i++)
        if (j->verdict[i].series == index && j->verdict[i].quantity < 256)
            truth_row[j->verdict[i].quantity] = j->verdict[i].truth;
    const hid_t of_case = group(s, cases, p->type->name);
    const int new_point = H5Lexists(of_case, p->name, H5P_DEFAULT) <= 0;
    const hid_t at_point = group(s, of_case, p->name);
    if (new_point)
        put_point(s, at_point, p);
    const hid_t of_formulation = group(s, at_point, one->formulation.key);
    put_text(s, of_formulation, "formulation", one->formulation.type->name);
    put_text(s, of_formulation, "summary", one->formulation.type->summary);
    put_text(s, of_formulation, "source", one->formulation.type->source);
    put_text(s, of_formulation, "missing", one->missing);
    put_verdicts(s, of_formulation, all, j, index);
    for (int i = 0; i < one->meshes && one->missing[0] == '\0'; i++) {
        char name[32];
        snprintf(name, sizeof name, "n%d", one->mesh[i]);
        const hid_t mesh = group(s, of_formulation, name);
        put_text(s, mesh, "status", status_name(one->cell[i].solve.status));
        put_text(s, mesh, "reason", one->cell[i].solve.reason);
        put_long(s, mesh, "elements_per_member", one->mesh[i]);
        put_cost(s, mesh, &one->cell[i]);
        put_left_out(s, mesh, &one->cell[i]);
        put_steps(s, mesh, &one->cell[i].solve);
        put_quantities(s, mesh, p, &one->cell[i].solve, truth_row);
        H5Gclose(mesh);
    }
    H5Gclose(of_formulation);
    H5Gclose(at_point);
    H5Gclose(of_case);
}

status store_write(const char *path, const sweep *all, const judgement *j, const environment *e, fault *f)
{
    char temporary[512];
    store s = {0};
    status outcome = output_temporary(path, temporary, sizeof temporary, f);
    if (outcome != STATUS_OK)
        return outcome;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fcreate(temporary, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be written; choose another place", path);
    put_environment(&s, file, e);
    const hid_t cases = group(&s, file, "cases");
    for (int i = 0; i < all->seriess && !s.bad; i++)
        put_series(&s, cases, all, j, i);
    H5Gclose(cases);
    check(&s, H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
    check(&s, H5Fclose(file) >= 0);
    if (s.bad || rename(temporary, path) != 0) {
        unlink(temporary);
        return fault_set(f, STATUS_FAULT, "%.200s: writing failed (full disk?); nothing was left", path);
    }
    return STATUS_OK;
}
