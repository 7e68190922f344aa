#include "harness/records/records_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"

static status results_hdf5_read(const char *path, const char *experiment, stored_results *out,
                                fault *f);

static int compare_cells(const void *a, const void *b)
{
    return results_order(a, b);
}

static int compare_series(const void *a, const void *b)
{
    return strcmp(((const result_series *)a)->name, ((const result_series *)b)->name);
}

static status sort_cells(const char *path, stored_results *r, fault *f)
{
    if (r->cells > 0)
        qsort(r->cell, (size_t)r->cells, sizeof *r->cell, compare_cells);
    for (int i = 1; i < r->cells; i++)
        if (results_order(&r->cell[i - 1], &r->cell[i]) == 0)
            return fault_set(f, STATUS_FAULT,
                             "%.120s: the run %.120s n=%d occurs twice; remove the file, and "
                             "repeat the command that wrote it",
                             path, r->cell[i].name, r->cell[i].elements);
    return STATUS_OK;
}

static status sort_series(const char *path, stored_results *r, fault *f)
{
    if (r->seriess > 0)
        qsort(r->series, (size_t)r->seriess, sizeof *r->series, compare_series);
    for (int i = 1; i < r->seriess; i++)
        if (compare_series(&r->series[i - 1], &r->series[i]) == 0)
            return fault_set(f, STATUS_FAULT,
                             "%.120s: the series %.120s occurs twice; remove the file, and repeat "
                             "the command that wrote it",
                             path, r->series[i].name);
    return STATUS_OK;
}

static int is_hdf5(FILE *from)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof signature] = {0};
    const size_t length = fread(head, 1, sizeof head, from);
    rewind(from);
    return length == sizeof head && memcmp(head, signature, sizeof head) == 0;
}

static status read_sorted(const char *path, const char *experiment, FILE *from, stored_results *out,
                          fault *f)
{
    const int whole = is_hdf5(from);
    if (!whole)
        line_skip_mark(from);
    TRY(whole ? results_hdf5_read(path, experiment, out, f)
              : results_table_read(path, from, out, f));
    TRY(sort_cells(path, out, f));
    if (out->whole && !out->swept)
        TRY(results_series_summarise(out, f));
    return sort_series(path, out, f);
}

status results_read_any(const char *path, const char *experiment, stored_results *out, fault *f)
{
    memset(out, 0, sizeof *out);
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    const status outcome = read_sorted(path, experiment, from, out, f);
    fclose(from);
    if (outcome != STATUS_OK)
        results_free(out);
    return outcome;
}

status results_read(const char *path, stored_results *out, fault *f)
{
    return results_read_any(path, "verify", out, f);
}

enum { NAME = 200 };

status results_case_damaged(const char *path, const char *where, const char *what, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.120s: %s%.120s is missing or damaged; remove the file, and repeat the "
                     "command that wrote it",
                     path, where, what);
}

typedef struct case_point_row {
    char point[16], parameters[PARAMETERS_TEXT];
} case_point_row;

typedef struct cell_row {
    char point[16], formulation[FORMULATION_KEY], status[RESULTS_STATUS];
    int elements;
    long strain, stress, inertia, iterations, factorisations, solutions;
    double flops, entries;
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
    {"factorisations", FIELD_LONG, offsetof(cell_row, factorisations), 0},
    {"factor_flops", FIELD_DOUBLE, offsetof(cell_row, flops), 0},
    {"solutions", FIELD_LONG, offsetof(cell_row, solutions), 0},
    {"solved_entries", FIELD_DOUBLE, offsetof(cell_row, entries), 0}};
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

/* Tables of a case. limits -1: no limits were evaluated. */
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

/* Reads the tables. Returns the name of a damaged table; NULL: none. */
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

/* Returns the parameters of a point as text; NULL: there is no such point. */
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

/* Reads the values of a cell, starting at row *next of the table. Returns 0 if out of memory. */
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

/* Returns 1 if the counts of work are plausible, and so small that their sums do not overflow. */
static int are_counts(const cell_row *row)
{
    static const double most = 1L << 50;
    const double count[] = {(double)row->iterations,     (double)row->strain,
                            (double)row->stress,         (double)row->inertia,
                            (double)row->factorisations, row->flops,
                            (double)row->solutions,      row->entries};
    for (size_t i = 0; i < sizeof count / sizeof count[0]; i++)
        if (!(count[i] >= 0 && count[i] <= most))
            return 0;
    return 1;
}

static status take_cell(const char *path, const char *of, const case_tables *t, const cell_row *row,
                        int *next, stored_results *out, fault *f)
{
    char name[NAME + PARAMETERS_TEXT + FORMULATION_KEY];
    const char *parameters = parameters_of(t, row->point);
    if (parameters == NULL)
        return results_case_damaged(path, of, ": the point of a run", f);
    snprintf(name, sizeof name, "%s/%s/%s", of, parameters, row->formulation);
    if (row->elements < 1 || row->elements > RESULTS_MOST_ELEMENTS || !are_counts(row))
        return results_case_damaged(path, name, "", f);
    result_cell *cell = results_add(out);
    if (cell == NULL || (cell->name = strdup(name)) == NULL || !take_values(t, row, next, cell))
        return fault_memory(f, "results");
    cell->elements = row->elements;
    memcpy(cell->status, row->status, sizeof cell->status);
    cell->work[WORK_ITERATIONS] = row->iterations;
    cell->work[WORK_EVALUATIONS] = row->strain + row->stress + row->inertia;
    cell->work[WORK_FACTORISATIONS] = row->factorisations;
    cell->work[WORK_FLOPS] = (long)row->flops;
    cell->work[WORK_SOLUTIONS] = row->solutions;
    cell->work[WORK_ENTRIES] = (long)row->entries;
    return STATUS_OK;
}

/* Returns the row of the finest mesh in the series of a limit; -1: there is none. */
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

static status take_limits(const char *path, const char *of, const case_tables *t,
                          result_cell cell[], fault *f)
{
    for (int i = 0; i < t->limits; i++) {
        const limit_row *limit = &t->limit[i];
        if (!isfinite(limit->limit) || strcmp(limit->point, "default") != 0)
            continue;
        const int finest = finest_cell(t, limit);
        if (finest < 0 || !set_limit(&cell[finest], limit))
            return results_case_damaged(path, of, ": the run of a limit", f);
    }
    return STATUS_OK;
}

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
        return results_case_damaged(path, where, "quantities: the run of a value", f);
    return take_limits(path, name, t, out->cells > first ? &out->cell[first] : NULL, f);
}

static status results_case_read(const char *path, hid_t at, const char *name, stored_results *out,
                                fault *f)
{
    case_tables t;
    const status outcome = take_case(path, at, name, &t, out, f);
    out->limits = out->limits || t.limits >= 0;
    free_tables(&t);
    return outcome;
}

enum { HDF5_NAME = 200 };

static status read_case(const char *path, hid_t cases, const char *name, stored_results *out,
                        fault *f)
{
    const hid_t here = H5Gopen2(cases, name, H5P_DEFAULT);
    if (here < 0)
        return results_case_damaged(path, "", name, f);
    const status outcome = results_case_read(path, here, name, out, f);
    H5Gclose(here);
    return outcome;
}

static status read_cases(const char *path, hid_t cases, stored_results *out, fault *f)
{
    char name[HDF5_NAME];
    H5G_info_t info = {0};
    if (H5Gget_info(cases, &info) < 0)
        return results_case_damaged(path, "", "cases", f);
    for (hsize_t i = 0; i < info.nlinks; i++) {
        if (H5Lget_name_by_idx(cases, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) <= 0)
            return results_case_damaged(path, "", "cases", f);
        TRY(read_case(path, cases, name, out, f));
    }
    return STATUS_OK;
}

static status hdf5_read_tables(const char *path, hid_t at, stored_results *out, fault *f)
{
    const hid_t cases = H5Gopen2(at, "cases", H5P_DEFAULT);
    const status outcome =
        cases < 0 ? results_case_damaged(path, "", "cases", f) : read_cases(path, cases, out, f);
    out->whole = 1;
    if (cases >= 0)
        H5Gclose(cases);
    return outcome;
}

/* Copies a text attribute. *out is NULL if the attribute is missing. Returns 0 if out of memory, or
 * if the attribute is empty or cannot be read. */
static int read_text(hid_t file, const char *name, char **out)
{
    enum { MOST = 1 << 16 };
    char *room = malloc(MOST);
    *out = NULL;
    if (room != NULL && table_reader_attribute_text(file, name, room, MOST) && room[0] != '\0')
        *out = strdup(room);
    const int good = room != NULL && (*out != NULL || H5Aexists(file, name) <= 0);
    free(room);
    return good;
}

typedef struct declared_row {
    char formulation[FORMULATION_KEY];
    signed char is_new;
} declared_row;

static status read_fresh(const char *path, hid_t file, results_part *out, fault *f)
{
    static const table_column columns[] = {
        {"formulation", FIELD_TEXT, offsetof(declared_row, formulation), FORMULATION_KEY},
        {"is_new", FIELD_FLAG, offsetof(declared_row, is_new), 0}};
    void *rows;
    if (H5Lexists(file, "declarations", H5P_DEFAULT) <= 0)
        return STATUS_OK;
    const int count =
        table_reader_rows(file, "declarations", 2, columns, sizeof(declared_row), &rows);
    const declared_row *row = rows;
    size_t size = 0;
    FILE *to = count >= 0 ? open_memstream(&out->fresh, &size) : NULL;
    for (int i = 0; to != NULL && i < count; i++)
        if (row[i].is_new)
            fprintf(to, "%s%s", ftell(to) > 0 ? "\n" : "", row[i].formulation);
    const int good = to != NULL && fclose(to) == 0;
    free(rows);
    return good ? STATUS_OK : results_case_damaged(path, "", "declarations", f);
}

static status read_part(const char *path, hid_t file, results_part *out, fault *f)
{
    if (!read_text(file, "selection", &out->select) ||
        !read_text(file, "selection_cases", &out->cases) ||
        !read_text(file, "selection_formulations", &out->formulations))
        return results_case_damaged(path, "", "selection", f);
    if (out->select != NULL && select_matches(out->select, "") < 0)
        return results_case_damaged(path, "", "selection", f);
    return read_fresh(path, file, out, f);
}

static status check_version(const char *path, hid_t file, fault *f)
{
    char schema[64];
    long version = 0;
    if (H5Aexists(file, KEPT_SWEEP_MARK) > 0)
        return STATUS_OK;
    if (!table_reader_attribute_text(file, "schema", schema, sizeof schema) ||
        strcmp(schema, SCHEMA_NAME) != 0 ||
        !table_reader_attribute_count(file, "schema_version", &version))
        return fault_set(f, STATUS_FAULT,
                         "%.120s is not a results file; give a file written by 'beamwork verify -o "
                         "FILE.h5' or 'beamwork sweep -o FILE.h5'",
                         path);
    if (version >= SCHEMA_OLDEST && version <= SCHEMA_VERSION)
        return STATUS_OK;
    return fault_set(f, STATUS_FAULT,
                     "%.120s: the results have format version %ld, but this version of beamwork "
                     "reads %d to %d; remove the file, and repeat the command that wrote it",
                     path, version, SCHEMA_OLDEST, SCHEMA_VERSION);
}

/* Opens the group of an experiment; -1: there is none. The root belongs to verify, or to a sweep in
 * a separate file. */
static hid_t open_group(hid_t file, const char *name)
{
    const int is_sweep = strcmp(name, KEPT_SWEEP) == 0, is_own = strcmp(name, "verify") == 0;
    if (is_sweep && H5Aexists(file, KEPT_SWEEP_MARK) > 0)
        return H5Gopen2(file, "/", H5P_DEFAULT);
    if (is_own)
        return H5Lexists(file, "cases", H5P_DEFAULT) > 0 ? H5Gopen2(file, "/", H5P_DEFAULT) : -1;
    const hid_t all = H5Lexists(file, KEPT_GROUPS, H5P_DEFAULT) > 0
                          ? H5Gopen2(file, KEPT_GROUPS, H5P_DEFAULT)
                          : -1,
                own = all >= 0 && H5Lexists(all, name, H5P_DEFAULT) > 0
                          ? H5Gopen2(all, name, H5P_DEFAULT)
                          : -1;
    handles_close(1, &all);
    return own;
}

static status read_group(const char *path, hid_t at, stored_results *out, fault *f)
{
    if (H5Aexists(at, KEPT_SWEEP_MARK) > 0)
        return results_sweep_read(path, at, out, f);
    TRY(read_part(path, at, &out->part, f));
    return hdf5_read_tables(path, at, out, f);
}

static status read_file(const char *path, const char *experiment, hid_t file, stored_results *out,
                        fault *f)
{
    static const char *const of_cells[] = {"verify", "bench", KEPT_SWEEP};
    hid_t at = -1;
    TRY(check_version(path, file, f));
    for (size_t i = 0; i < sizeof of_cells / sizeof *of_cells && at < 0; i++)
        if (experiment == NULL || strcmp(experiment, of_cells[i]) == 0)
            at = open_group(file, of_cells[i]);
    if (at < 0) {
        char kinds[KEPT_NAMES];
        kept_names(file, kinds);
        return fault_set(f, STATUS_FAULT,
                         "%.120s contains results of %.120s, not of %.40s; give a file written by "
                         "'beamwork %.40s -o FILE.h5'",
                         path, kinds, experiment != NULL ? experiment : "verify, bench or sweep",
                         experiment != NULL ? experiment : "verify");
    }
    const status outcome = read_group(path, at, out, f);
    H5Gclose(at);
    return outcome;
}

static status results_hdf5_read(const char *path, const char *experiment, stored_results *out,
                                fault *f)
{
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: the file is not valid HDF5; remove the file, and repeat the "
                         "command that wrote it",
                         path);
    const status outcome = read_file(path, experiment, file, out, f);
    H5Fclose(file);
    return outcome;
}
