#include <string.h>

#include "harness/experiments/ranges_file_impl.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

enum { TEXT = 64, LONG_TEXT = 128 };

/* A table of texts and numbers. */
typedef struct axis_row {
    char name[TEXT], unit[16], kind[8], scale[8];
    int count;
} axis_row;
typedef struct worst_row {
    long point;
    char formulation[FORMULATION_KEY];
    int mesh;
    char quantity[SCENE_NAME];
    double error;
    char status[16], scene[LONG_TEXT];
} worst_row;

static void insert_text(hid_t table, const char *name, size_t offset, size_t length)
{
    const hid_t type = record_text_type(length);
    H5Tinsert(table, name, offset, type);
    H5Tclose(type);
}

static void put_axes(record_file *r, hid_t at, const parameter_ranges *of)
{
    axis_row row[CASE_MAX_PARAMETERS];
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->design.axes; i++) {
        const sweep_axis *a = &of->axis[i];
        const int range = a->value == NULL, scattered = of->design.kind != DESIGN_GRID;
        snprintf(row[i].name, sizeof row[i].name, "%s", a->of->name);
        snprintf(row[i].unit, sizeof row[i].unit, "%s", a->of->unit);
        snprintf(row[i].kind, sizeof row[i].kind, "%s",
                 range && scattered ? design_name(of->design.kind) : axis_kind_name(a->kind));
        snprintf(row[i].scale, sizeof row[i].scale, "%s", range ? axis_kind_name(a->kind) : "");
        row[i].count = range && scattered ? (int)of->design.points : a->count;
    }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    insert_text(type, "name", offsetof(axis_row, name), sizeof row[0].name);
    insert_text(type, "unit", offsetof(axis_row, unit), sizeof row[0].unit);
    insert_text(type, "kind", offsetof(axis_row, kind), sizeof row[0].kind);
    insert_text(type, "scale", offsetof(axis_row, scale), sizeof row[0].scale);
    H5Tinsert(type, "count", offsetof(axis_row, count), H5T_NATIVE_INT);
    H5Dclose(record_table(r, at, "axes", type, of->design.axes, row));
    H5Tclose(type);
}

static void put_quantities(record_file *r, hid_t at, const parameter_ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->quantity[0]);
    insert_text(type, "name", offsetof(ranges_quantity, name), sizeof of->quantity[0].name);
    insert_text(type, "unit", offsetof(ranges_quantity, unit), sizeof of->quantity[0].unit);
    H5Dclose(record_table(r, at, "quantities", type, of->quantities, of->quantity));
    H5Tclose(type);
}

static void put_formulations(record_file *r, hid_t at, const parameter_ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->formulation[0]);
    insert_text(type, "key", offsetof(formulation, key), sizeof of->formulation[0].key);
    const hid_t stored = H5Tcopy(type);
    H5Tpack(stored);
    const hsize_t size = (hsize_t)of->formulations;
    const hid_t space = H5Screate_simple(1, &size, NULL),
                set = H5Dcreate2(at, "formulations", stored, space, H5P_DEFAULT, H5P_DEFAULT,
                                 H5P_DEFAULT);
    r->bad |= set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, of->formulation) < 0;
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(stored);
    H5Tclose(type);
}

void ranges_file_request(record_file *r, hid_t at, const parameter_ranges *of, const char *plan)
{
    const environment e = environment_now(1);
    const ranges_request *q = &of->request;
    char fixed[PARAMETERS_TEXT], noise[TEXT];
    const hsize_t meshes = (hsize_t)of->meshes;
    parameters_text(q->type, of->base, fixed, sizeof fixed);
    store_environment(r, at, &e);
    record_count(r, at, KEPT_SWEEP_MARK, RANGES_FILE_VERSION);
    record_text(r, at, q->file != NULL ? "scene" : "case",
                q->file != NULL ? scene_file_path(q->type) : q->type->name);
    record_text(r, at, "plan", plan);
    record_text(r, at, "parameters", fixed);
    record_text(r, at, "design", design_name(of->design.kind));
    if (of->design.kind == DESIGN_RANDOM)
        record_count(r, at, "seed", (long)of->design.seed);
    if (q->select != NULL)
        record_text(r, at, "selection", q->select);
    snprintf(noise, sizeof noise, "%.15g", price_noise);
    record_text(r, at, "cost_noise", noise); /* ratios of costs below it tie */
    record_count(r, at, "axes", of->design.axes);
    record_number(r, at, "tolerance", q->tolerance);
    H5Dclose(record_array(r, at, "meshes", H5T_NATIVE_INT, 1, &meshes, of->mesh));
    put_axes(r, at, of);
    put_quantities(r, at, of);
    put_formulations(r, at, of);
}

void ranges_file_worst(record_file *r, hid_t at, const parameter_ranges *of, const tally *t)
{
    worst_row row[RANGES_FORMULATIONS * TALLY_WORST];
    int count = 0;
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++) {
            const tally_worst *w = &t->worst[i][k];
            worst_row *out = &row[count++];
            out->point = w->point;
            out->mesh = of->mesh[of->meshes - 1];
            out->error = w->error;
            snprintf(out->formulation, sizeof out->formulation, "%s", of->formulation[i].key);
            snprintf(out->quantity, sizeof out->quantity, "%s",
                     w->quantity >= 0 ? of->quantity[w->quantity].name : "");
            snprintf(out->status, sizeof out->status, "%s", rows_status_name(w->status));
            snprintf(out->scene, sizeof out->scene, "%s", w->scene);
        }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    H5Tinsert(type, "point", offsetof(worst_row, point), H5T_NATIVE_LONG);
    insert_text(type, "formulation", offsetof(worst_row, formulation), sizeof row[0].formulation);
    H5Tinsert(type, "mesh", offsetof(worst_row, mesh), H5T_NATIVE_INT);
    insert_text(type, "quantity", offsetof(worst_row, quantity), sizeof row[0].quantity);
    H5Tinsert(type, "error", offsetof(worst_row, error), H5T_NATIVE_DOUBLE);
    insert_text(type, "status", offsetof(worst_row, status), sizeof row[0].status);
    insert_text(type, "scene", offsetof(worst_row, scene), sizeof row[0].scene);
    H5Dclose(record_table(r, at, "worst", type, count, row));
    H5Tclose(type);
}
