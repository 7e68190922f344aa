/* Reading results.h5 back. Nothing is believed: a file may be foreign, cut short or damaged. */
#include "harness/comparison/results_version1.h"

#include <stdlib.h>
#include <string.h>

#include "harness/comparison/table_reader.h"
#include "harness/truth/checksum.h"

enum { NAME = 200, MOST_ELEMENTS = 10000000 };

typedef struct point_row {
    char point[16], parameters[PARAMETERS_TEXT];
} point_row;

typedef struct cell_row {
    char point[16], formulation[FORMULATION_KEY], status[16];
    int elements;
    long strain, stress, inertia, iterations, factorisations;
} cell_row;

typedef struct value_row {
    char point[16], formulation[FORMULATION_KEY], quantity[SCENE_NAME];
    int elements;
    double value, error, near_zero;
} value_row;

/* A text whose column has the member's name. */
#define TEXT(row, member) #member, FIELD_TEXT, offsetof(row, member), sizeof((row *)0)->member
static const table_column point_columns[] = {{TEXT(point_row, point)}, {TEXT(point_row, parameters)}};
static const table_column cell_columns[] = {{TEXT(cell_row, point)},
                                            {TEXT(cell_row, formulation)},
                                            {TEXT(cell_row, status)},
                                            {"elements", FIELD_INT, offsetof(cell_row, elements), 0},
                                            {"strain_evaluations", FIELD_LONG, offsetof(cell_row, strain), 0},
                                            {"stress_evaluations", FIELD_LONG, offsetof(cell_row, stress), 0},
                                            {"inertia_evaluations", FIELD_LONG, offsetof(cell_row, inertia), 0},
                                            {"iterations", FIELD_LONG, offsetof(cell_row, iterations), 0},
                                            {"factorisations", FIELD_LONG, offsetof(cell_row, factorisations), 0}};
static const table_column value_columns[] = {{TEXT(value_row, point)},
                                             {TEXT(value_row, formulation)},
                                             {TEXT(value_row, quantity)},
                                             {"elements", FIELD_INT, offsetof(value_row, elements), 0},
                                             {"value", FIELD_DOUBLE, offsetof(value_row, value), 0},
                                             {"error", FIELD_DOUBLE, offsetof(value_row, error), 0},
                                             {"near_zero", FIELD_DOUBLE, offsetof(value_row, near_zero), 0}};

/* The tables of one case. */
typedef struct tables {
    int points, cells, values;
    point_row *point;
    cell_row *cell;
    value_row *value;
} tables;

static status damaged(const char *path, const char *where, const char *what, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.120s: %s%.120s is missing or damaged; run 'beamwork verify -o' again", path, where, what);
}

static void free_tables(tables *t)
{
    free(t->point);
    free(t->cell);
    free(t->value);
}

/* NULL, or the name of the table that is damaged. */
static const char *read_tables(hid_t at, tables *t)
{
    void *rows;
    memset(t, 0, sizeof *t);
    t->points = table_read(at, "points", sizeof point_columns / sizeof *point_columns, point_columns, sizeof *t->point, &rows);
    t->point = rows;
    if (t->points < 0)
        return "points";
    t->cells = table_read(at, "cells", sizeof cell_columns / sizeof *cell_columns, cell_columns, sizeof *t->cell, &rows);
    t->cell = rows;
    if (t->cells < 0)
        return "cells";
    t->values = table_read(at, "quantities", sizeof value_columns / sizeof *value_columns, value_columns, sizeof *t->value, &rows);
    t->value = rows;
    return t->values < 0 ? "quantities" : NULL;
}

/* The parameters of a point in words, or NULL: there is no such point. */
static const char *parameters_of(const tables *t, const char *name)
{
    for (int i = 0; i < t->points; i++)
        if (strcmp(t->point[i].point, name) == 0)
            return t->point[i].parameters[0] != '\0' ? t->point[i].parameters : "default";
    return NULL;
}

static int is_of(const cell_row *cell, const value_row *value)
{
    return cell->elements == value->elements && strcmp(cell->formulation, value->formulation) == 0 &&
           strcmp(cell->point, value->point) == 0;
}

/* Values stand in the order of their cells: those of this one, from *next on. 0: out of memory. */
static int take_values(const tables *t, const cell_row *row, int *next, result_cell *cell)
{
    int count = 0;
    while (*next + count < t->values && is_of(row, &t->value[*next + count]))
        count++;
    cell->value = calloc((size_t)count + 1, sizeof *cell->value);
    for (int i = 0; i < count && cell->value != NULL; i++) {
        const value_row *from = &t->value[*next + i];
        result_value *v = &cell->value[cell->values++];
        memcpy(v->quantity, from->quantity, sizeof v->quantity);
        v->value = from->value;
        v->error = from->error;
        v->near_zero = from->near_zero;
    }
    *next += count;
    return cell->value != NULL;
}

static status take_cell(const char *path, const char *of, const tables *t, const cell_row *row, int *next, results *out, fault *f)
{
    char name[NAME + PARAMETERS_TEXT + FORMULATION_KEY];
    const char *parameters = parameters_of(t, row->point);
    if (parameters == NULL)
        return damaged(path, of, ": the point of a cell", f);
    snprintf(name, sizeof name, "%s/%s/%s", of, parameters, row->formulation);
    if (row->elements < 1 || row->elements > MOST_ELEMENTS)
        return damaged(path, name, "", f);
    result_cell *cell = results_add(out);
    if (cell == NULL || (cell->name = strdup(name)) == NULL || !take_values(t, row, next, cell))
        return fault_set(f, STATUS_FAULT, "out of memory for results");
    cell->elements = row->elements;
    memcpy(cell->status, row->status, sizeof cell->status);
    cell->work[WORK_ITERATIONS] = row->iterations;
    cell->work[WORK_EVALUATIONS] = row->strain + row->stress + row->inertia;
    cell->work[WORK_FACTORISATIONS] = row->factorisations;
    results_summarise(cell);
    return STATUS_OK;
}

static status read_case(const char *path, hid_t at, const char *name, results *out, fault *f)
{
    tables t;
    int next = 0;
    char where[NAME + 8];
    snprintf(where, sizeof where, "%s/", name);
    const char *bad = read_tables(at, &t);
    status outcome = bad == NULL ? STATUS_OK : damaged(path, where, bad, f);
    for (int i = 0; i < t.cells && outcome == STATUS_OK; i++)
        outcome = take_cell(path, name, &t, &t.cell[i], &next, out, f);
    if (outcome == STATUS_OK && next < t.values)
        outcome = damaged(path, where, "quantities: the cell of a value", f);
    free_tables(&t);
    return outcome;
}

static status read_cases(const char *path, hid_t cases, results *out, fault *f)
{
    char name[NAME];
    status outcome = STATUS_OK;
    H5G_info_t info = {0};
    if (H5Gget_info(cases, &info) < 0)
        return damaged(path, "", "cases", f);
    for (hsize_t i = 0; i < info.nlinks && outcome == STATUS_OK; i++) {
        if (H5Lget_name_by_idx(cases, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT) <= 0)
            return damaged(path, "", "cases", f);
        const hid_t here = H5Gopen2(cases, name, H5P_DEFAULT);
        outcome = here >= 0 ? read_case(path, here, name, out, f) : damaged(path, "", name, f);
        if (here >= 0)
            H5Gclose(here);
    }
    return outcome;
}

static status read_version2(const char *path, hid_t file, results *out, fault *f)
{
    const hid_t cases = H5Gopen2(file, "cases", H5P_DEFAULT);
    const status outcome = cases < 0 ? damaged(path, "", "cases", f) : read_cases(path, cases, out, f);
    out->whole = 1;
    if (cases >= 0)
        H5Gclose(cases);
    return outcome;
}

static status read_file(const char *path, hid_t file, results *out, fault *f)
{
    char schema[64];
    long version = 0;
    if (!attribute_text(file, "schema", schema, sizeof schema) || strcmp(schema, SCHEMA_NAME) != 0 ||
        !attribute_count(file, "schema_version", &version))
        return fault_set(f, STATUS_FAULT, "%.120s: not a file of results; write one with 'beamwork verify -o'", path);
    if (version == 1)
        return results_read_version1(path, file, out, f);
    if (version == SCHEMA_VERSION)
        return read_version2(path, file, out, f);
    return fault_set(f, STATUS_FAULT, "%.120s: results of version %ld, this program reads %d; run 'beamwork verify -o' again", path,
                     version, SCHEMA_VERSION);
}

status results_read_hdf5(const char *path, results *out, fault *f)
{
    const status intact = checksum_check(path, f);
    if (intact != STATUS_OK)
        return intact;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read as HDF5; run 'beamwork verify -o' again", path);
    const status outcome = read_file(path, file, out, f);
    H5Fclose(file);
    return outcome;
}
