/* Result files of schema version 1, a group for each cell: read for `compare` only. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/comparison/results.h"
#include "harness/comparison/results_version1.h"
#include "harness/comparison/table_reader.h"

enum { NAME = 200, PARAMETERS = 600, MOST_VALUES = 100000 };

/* One row of a mesh's quantities. */
typedef struct old_row {
    char name[SCENE_NAME];
    double value, error, near_zero;
} old_row;

typedef struct reader {
    const char *path;
    results *out;
    fault *f;
} reader;

static status damaged(const reader *r, const char *where)
{
    return fault_set(r->f, STATUS_FAULT,
                     "%.120s: %.120s is missing or damaged; run 'beamwork verify -o' again",
                     r->path, where);
}

static hid_t row_type(void)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(old_row)), text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, SCENE_NAME);
    H5Tset_cset(text, H5T_CSET_UTF8);
    H5Tinsert(type, "name", offsetof(old_row, name), text);
    H5Tinsert(type, "value", offsetof(old_row, value), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "error", offsetof(old_row, error), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "near_zero", offsetof(old_row, near_zero), H5T_NATIVE_DOUBLE);
    H5Tclose(text);
    return type;
}

static int read_values(hid_t at, result_cell *cell)
{
    hsize_t count = 0;
    const hid_t set =
        H5Lexists(at, "quantities", H5P_DEFAULT) > 0 ? H5Dopen2(at, "quantities", H5P_DEFAULT) : -1;
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1, type = row_type();
    int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 &&
               H5Sget_simple_extent_dims(space, &count, NULL) == 1 && count <= MOST_VALUES;
    old_row *row = good ? calloc((size_t)count + 1, sizeof *row) : NULL;
    cell->value = good ? calloc((size_t)count + 1, sizeof *cell->value) : NULL;
    good = row != NULL && cell->value != NULL &&
           (count == 0 || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, row) >= 0);
    for (int i = 0; good && i < (int)count; i++) {
        result_value *v = &cell->value[cell->values++];
        memcpy(v->quantity, row[i].name, sizeof v->quantity - 1);
        v->value = row[i].value;
        v->error = row[i].error;
        v->near_zero = row[i].near_zero;
        v->limit = NAN;
    }
    free(row);
    H5Tclose(type);
    if (space >= 0)
        H5Sclose(space);
    if (set >= 0)
        H5Dclose(set);
    return good;
}

static int read_work(hid_t at, long work[RESULTS_WORKS])
{
    static const char *const part[] = {"strain_evaluations", "stress_evaluations",
                                       "inertia_evaluations"};
    long one;
    work[WORK_EVALUATIONS] = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        if (!attribute_count(at, part[i], &one))
            return 0;
        work[WORK_EVALUATIONS] += one;
    }
    return attribute_count(at, "iterations", &work[WORK_ITERATIONS]) &&
           attribute_count(at, "factorisations", &work[WORK_FACTORISATIONS]);
}

/* name: case/parameters/formulation. */
static status read_cell(const reader *r, hid_t at, const char *name)
{
    long elements = 0;
    result_cell *cell = results_add(r->out);
    if (cell == NULL || (cell->name = strdup(name)) == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for results");
    if (!attribute_count(at, "elements_per_member", &elements) || elements < 1 ||
        elements > RESULTS_MOST_ELEMENTS ||
        !attribute_text(at, "status", cell->status, sizeof cell->status) ||
        !read_work(at, cell->work) || !read_values(at, cell))
        return damaged(r, name);
    cell->elements = (int)elements;
    return STATUS_OK;
}

typedef status visitor(const reader *r, hid_t group, const char *name, const char *prefix);

/* Every subgroup of a group: `prefix` is handed on. */
static status visit(const reader *r, hid_t at, const char *prefix, visitor *each)
{
    char name[NAME];
    status outcome = STATUS_OK;
    H5G_info_t info = {0};
    if (H5Gget_info(at, &info) < 0)
        return damaged(r, prefix);
    for (hsize_t i = 0; i < info.nlinks && outcome == STATUS_OK; i++) {
        if (H5Lget_name_by_idx(at, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) <= 0)
            return damaged(r, prefix);
        const hid_t here = H5Oopen(at, name, H5P_DEFAULT);
        if (here < 0)
            return damaged(r, name);
        if (H5Iget_type(here) == H5I_GROUP) /* the others: tables of verdicts and times */
            outcome = each(r, here, name, prefix);
        H5Oclose(here);
    }
    return outcome;
}

static status visit_mesh(const reader *r, hid_t group, const char *name, const char *prefix)
{
    return name[0] == 'n' ? read_cell(r, group, prefix) : STATUS_OK;
}

static status visit_formulation(const reader *r, hid_t group, const char *name, const char *prefix)
{
    char full[2 * NAME + PARAMETERS];
    snprintf(full, sizeof full, "%s/%s", prefix, name);
    return visit(r, group, full, visit_mesh);
}

static status visit_point(const reader *r, hid_t group, const char *name, const char *prefix)
{
    char text[PARAMETERS], full[NAME + PARAMETERS];
    if (!attribute_text(group, "parameters", text, sizeof text))
        return damaged(r, name);
    snprintf(full, sizeof full, "%s/%s", prefix, text[0] != '\0' ? text : "default");
    return visit(r, group, full, visit_formulation);
}

static status visit_case(const reader *r, hid_t group, const char *name, const char *prefix)
{
    (void)prefix;
    return visit(r, group, name, visit_point);
}

status results_read_version1(const char *path, hid_t file, results *out, fault *f)
{
    const reader r = {path, out, f};
    const hid_t cases = H5Gopen2(file, "cases", H5P_DEFAULT);
    const status outcome = cases < 0 ? damaged(&r, "cases") : visit(&r, cases, "", visit_case);
    out->whole = 1;
    if (cases >= 0)
        H5Gclose(cases);
    return outcome;
}
