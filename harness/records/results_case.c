/* The tables of one case of results.h5 as cells. Nothing is believed of them. */
#include "harness/records/results_case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/table_reader.h"

enum { NAME = 200 };

status results_case_damaged(const char *path, const char *where, const char *what, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.120s: %s%.120s is missing or damaged; run 'beamwork verify -o' again", path,
                     where, what);
}

typedef struct case_point_row {
    char point[16], parameters[PARAMETERS_TEXT];
} case_point_row;

typedef struct cell_row {
    char point[16], formulation[FORMULATION_KEY], status[RESULTS_STATUS];
    int elements;
    long strain, stress, inertia, iterations, factorisations;
} cell_row;

typedef struct case_value_row {
    char point[16], formulation[FORMULATION_KEY], quantity[SCENE_NAME];
    int elements;
    double value, error, near_zero;
} case_value_row;

typedef struct limit_row {
    char point[16], formulation[FORMULATION_KEY], quantity[SCENE_NAME];
    double limit;
} limit_row;

/* A text whose column has the member's name. */
#define TEXT(row, member) #member, FIELD_TEXT, offsetof(row, member), sizeof((row *)0)->member
static const table_column point_columns[] = {{TEXT(case_point_row, point)},
                                             {TEXT(case_point_row, parameters)}};
static const table_column cell_columns[] = {
    {TEXT(cell_row, point)},
    {TEXT(cell_row, formulation)},
    {TEXT(cell_row, status)},
    {"elements", FIELD_INT, offsetof(cell_row, elements), 0},
    {"strain_evaluations", FIELD_LONG, offsetof(cell_row, strain), 0},
    {"stress_evaluations", FIELD_LONG, offsetof(cell_row, stress), 0},
    {"inertia_evaluations", FIELD_LONG, offsetof(cell_row, inertia), 0},
    {"iterations", FIELD_LONG, offsetof(cell_row, iterations), 0},
    {"factorisations", FIELD_LONG, offsetof(cell_row, factorisations), 0}};
static const table_column value_columns[] = {
    {TEXT(case_value_row, point)},
    {TEXT(case_value_row, formulation)},
    {TEXT(case_value_row, quantity)},
    {"elements", FIELD_INT, offsetof(case_value_row, elements), 0},
    {"value", FIELD_DOUBLE, offsetof(case_value_row, value), 0},
    {"error", FIELD_DOUBLE, offsetof(case_value_row, error), 0},
    {"near_zero", FIELD_DOUBLE, offsetof(case_value_row, near_zero), 0}};

static const table_column limit_columns[] = {
    {TEXT(limit_row, point)},
    {TEXT(limit_row, formulation)},
    {TEXT(limit_row, quantity)},
    {"limit", FIELD_DOUBLE, offsetof(limit_row, limit), 0}};
#define COLUMNS(name) sizeof(name) / sizeof *(name), name

/* The tables of one case. limits: -1: nothing was judged. */
typedef struct case_tables {
    int points, cells, values, limits;
    case_point_row *point;
    cell_row *cell;
    case_value_row *value;
    limit_row *limit;
} case_tables;

static void free_tables(case_tables *t)
{
    free(t->point);
    free(t->cell);
    free(t->value);
    free(t->limit);
}

/* NULL, or the name of the table that is damaged. */
static const char *read_tables(hid_t at, case_tables *t)
{
    void *rows;
    memset(t, 0, sizeof *t);
    t->points = table_reader_rows(at, "points", COLUMNS(point_columns), sizeof *t->point, &rows);
    t->point = rows;
    if (t->points < 0)
        return "points";
    t->cells = table_reader_rows(at, "cells", COLUMNS(cell_columns), sizeof *t->cell, &rows);
    t->cell = rows;
    if (t->cells < 0)
        return "cells";
    t->values =
        table_reader_rows(at, "quantities", COLUMNS(value_columns), sizeof *t->value, &rows);
    t->value = rows;
    if (t->values < 0)
        return "quantities";
    t->limits = -1;
    if (H5Lexists(at, "verdicts", H5P_DEFAULT) <= 0)
        return NULL;
    t->limits = table_reader_rows(at, "verdicts", COLUMNS(limit_columns), sizeof *t->limit, &rows);
    t->limit = rows;
    return t->limits < 0 ? "verdicts" : NULL;
}

/* The parameters of a point in words, or NULL: there is no such point. */
static const char *parameters_of(const case_tables *t, const char *name)
{
    for (int i = 0; i < t->points; i++)
        if (strcmp(t->point[i].point, name) == 0)
            return t->point[i].parameters[0] != '\0' ? t->point[i].parameters : "default";
    return NULL;
}

static int is_of(const cell_row *cell, const case_value_row *value)
{
    return cell->elements == value->elements &&
           strcmp(cell->formulation, value->formulation) == 0 &&
           strcmp(cell->point, value->point) == 0;
}

/* Values stand in the order of their cells: those of this one, from *next on. 0: out of memory. */
static int take_values(const case_tables *t, const cell_row *row, int *next, result_cell *cell)
{
    int count = 0;
    while (*next + count < t->values && is_of(row, &t->value[*next + count]))
        count++;
    cell->value = calloc((size_t)count + 1, sizeof *cell->value);
    if (cell->value != NULL)
        for (int i = 0; i < count; i++) {
            const case_value_row *from = &t->value[*next + i];
            result_value *v = &cell->value[cell->values++];
            memcpy(v->quantity, from->quantity, sizeof v->quantity);
            v->value = from->value;
            v->error = from->error;
            v->near_zero = from->near_zero;
            v->limit = NAN;
        }
    *next += count;
    return cell->value != NULL;
}

/* Counts of work that a run can have, so small that their sums stay in range. */
static int are_counts(const cell_row *row)
{
    static const long most = 1L << 50;
    const long count[] = {row->iterations, row->strain, row->stress, row->inertia,
                          row->factorisations};
    for (size_t i = 0; i < sizeof count / sizeof count[0]; i++)
        if (count[i] < 0 || count[i] > most)
            return 0;
    return 1;
}

static status take_cell(const char *path, const char *of, const case_tables *t, const cell_row *row,
                        int *next, stored_results *out, fault *f)
{
    char name[NAME + PARAMETERS_TEXT + FORMULATION_KEY];
    const char *parameters = parameters_of(t, row->point);
    if (parameters == NULL)
        return results_case_damaged(path, of, ": the point of a cell", f);
    snprintf(name, sizeof name, "%s/%s/%s", of, parameters, row->formulation);
    if (row->elements < 1 || row->elements > RESULTS_MOST_ELEMENTS || !are_counts(row))
        return results_case_damaged(path, name, "", f);
    result_cell *cell = results_add(out);
    if (cell == NULL || (cell->name = strdup(name)) == NULL || !take_values(t, row, next, cell))
        return fault_set(f, STATUS_FAULT, "out of memory for results");
    cell->elements = row->elements;
    memcpy(cell->status, row->status, sizeof cell->status);
    cell->work[WORK_ITERATIONS] = row->iterations;
    cell->work[WORK_EVALUATIONS] = row->strain + row->stress + row->inertia;
    cell->work[WORK_FACTORISATIONS] = row->factorisations;
    return STATUS_OK;
}

/* The row of the finest mesh of what a limit belongs to; -1: there is none. */
static int finest_cell(const case_tables *t, const limit_row *limit)
{
    int finest = -1;
    for (int i = 0; i < t->cells; i++)
        if (strcmp(t->cell[i].formulation, limit->formulation) == 0 &&
            strcmp(t->cell[i].point, limit->point) == 0 &&
            (finest < 0 || t->cell[i].elements > t->cell[finest].elements))
            finest = i;
    return finest;
}

static int set_limit(result_cell *cell, const limit_row *limit)
{
    for (int i = 0; i < cell->values; i++)
        if (strcmp(cell->value[i].quantity, limit->quantity) == 0) {
            cell->value[i].limit = limit->limit;
            return 1;
        }
    return 0;
}

/* Limits at the default point, to the finest of the cells, which are those of the tables in their
 * order. */
static status take_limits(const char *path, const char *of, const case_tables *t,
                          result_cell cell[], fault *f)
{
    for (int i = 0; i < t->limits; i++) {
        const limit_row *limit = &t->limit[i];
        if (!isfinite(limit->limit) || strcmp(limit->point, "default") != 0)
            continue;
        const int finest = finest_cell(t, limit);
        if (finest < 0 || !set_limit(&cell[finest], limit))
            return results_case_damaged(path, of, ": the cell of a limit", f);
    }
    return STATUS_OK;
}

/* With what results_case_read frees. */
static status take_case(const char *path, hid_t at, const char *name, case_tables *t,
                        stored_results *out, fault *f)
{
    int next = 0;
    const int first = out->cells;
    char where[NAME + 8];
    snprintf(where, sizeof where, "%s/", name);
    const char *bad = read_tables(at, t);
    if (bad != NULL)
        return results_case_damaged(path, where, bad, f);
    for (int i = 0; i < t->cells; i++)
        TRY(take_cell(path, name, t, &t->cell[i], &next, out, f));
    if (next < t->values)
        return results_case_damaged(path, where, "quantities: the cell of a value", f);
    return take_limits(path, name, t, out->cells > first ? &out->cell[first] : NULL, f);
}

status results_case_read(const char *path, hid_t at, const char *name, stored_results *out,
                         fault *f)
{
    case_tables t;
    const status outcome = take_case(path, at, name, &t, out, f);
    out->limits = out->limits || t.limits >= 0;
    free_tables(&t);
    return outcome;
}
