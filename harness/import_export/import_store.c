#include "harness/import_export/import_export_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/records.h"

typedef struct point_row {
    char point[16], parameters[PARAMETERS_TEXT];
} point_row;

typedef struct value_row {
    char point[16], formulation[FORMULATION_KEY], quantity[SCENE_NAME], file[IMPORTED_FILE],
        model[IMPORTED_WORD], convention[IMPORTED_WORD], version[IMPORTED_WORD],
        file_unit[IMPORTED_UNIT];
    int elements, line, unknowns;
    double factor, seconds, x, value, uncertainty;
} value_row;

#define TEXT(row, member)   {#member, FIELD_TEXT, offsetof(row, member), sizeof((row *)0)->member}
#define INT(row, member)    {#member, FIELD_INT, offsetof(row, member), 0}
#define DOUBLE(row, member) {#member, FIELD_DOUBLE, offsetof(row, member), 0}
static const table_column point_columns[] = {TEXT(point_row, point), TEXT(point_row, parameters)};
static const table_column value_columns[] = {
    TEXT(value_row, point),     TEXT(value_row, formulation), TEXT(value_row, quantity),
    TEXT(value_row, file),      TEXT(value_row, model),       TEXT(value_row, convention),
    TEXT(value_row, file_unit), INT(value_row, elements),     INT(value_row, line),
    INT(value_row, unknowns),   DOUBLE(value_row, factor),    DOUBLE(value_row, seconds),
    DOUBLE(value_row, x),       DOUBLE(value_row, value),     DOUBLE(value_row, uncertainty),
    TEXT(value_row, version) /* the last column, because older files do not have it */};
#define COLUMNS(name) sizeof(name) / sizeof *(name), name

typedef struct tables {
    int points, values;
    point_row *point;
    value_row *value;
} tables;

typedef struct store_reader {
    const char *path;
    int gates;
    sweep *s;
    import_left *left;
    fault *f;
} store_reader;

static const char *parameters_of(const tables *t, const char *name)
{
    for (int i = 0; i < t->points; i++)
        if (strcmp(t->point[i].point, name) == 0)
            return t->point[i].parameters;
    return NULL;
}

/* Returns the point of the run with this case and these parameters; -1: there is none. */
static int point_of(const sweep *s, const char *of, const char *parameters)
{
    for (int i = 0; i < s->seriess; i++) {
        const sweep_point *p = &s->point[s->series[i].point];
        if (strcmp(p->type->name, of) == 0 && strcmp(p->text, parameters) == 0)
            return s->series[i].point;
    }
    return -1;
}

static int is_there(const sweep *s, int place, const char *name)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].point == place && strcmp(s->series[i].formulation.key, name) == 0)
            return 1;
    return 0;
}

static imported *gather_rows(const value_row *first, int count)
{
    imported *out = calloc(1, sizeof *out);
    if (out == NULL || (out->row = calloc((size_t)count + 1, sizeof *out->row)) == NULL) {
        free(out);
        return NULL;
    }
    memcpy(out->program, first->formulation, sizeof out->program);
    memcpy(out->file, first->file, sizeof out->file);
    memcpy(out->model, first->model, sizeof out->model);
    memcpy(out->convention, first->convention, sizeof out->convention);
    memcpy(out->version, first->version, sizeof out->version);
    for (int i = 0; i < count; i++) {
        const value_row *from = &first[i];
        imported_row *to = &out->row[out->rows++];
        *to = (imported_row){.line = from->line,
                             .elements = from->elements,
                             .unknowns = from->unknowns,
                             .factor = from->factor,
                             .seconds = from->seconds,
                             .x = from->x,
                             .value = from->value,
                             .uncertainty = from->uncertainty};
        memcpy(to->quantity, from->quantity, sizeof to->quantity);
        memcpy(to->unit, from->file_unit, sizeof to->unit);
    }
    return out;
}

static const char remedy[] = "give a file written by 'beamwork import theirs.csv -o theirs.h5'";

static status damaged(const store_reader *r, const char *where)
{
    return fault_set(r->f, STATUS_FAULT,
                     "%.120s: %.60s is missing or damaged; remove the file, and repeat the "
                     "'beamwork import' command that wrote it",
                     r->path, where);
}

/* Reads one series, which consists of consecutive rows of a program at a point. */
static status take_series(store_reader *r, const char *of, const tables *t, const value_row *first,
                          int count)
{
    const char *parameters = parameters_of(t, first->point);
    if (parameters == NULL)
        return damaged(r, "the parameter point of an import");
    for (int i = 0; i < count; i++)
        if (first[i].elements < 1 || !isfinite(first[i].value))
            return damaged(r, "an imported value");
    r->left->all++;
    const int place = point_of(r->s, of, parameters);
    if (place < 0) {
        if (r->left->series++ == 0)
            snprintf(r->left->first, sizeof r->left->first, "%.60s/%.100s/%.80s", of,
                     parameters[0] != '\0' ? parameters : "default", first->formulation);
        return STATUS_OK;
    }
    if (is_there(r->s, place, first->formulation))
        return fault_set(r->f, STATUS_REFUSED,
                         "%.100s: results of %.60s/%.60s with %.100s have already been read from "
                         "another file; remove one of the two files from --imported",
                         r->path, of, parameters[0] != '\0' ? parameters : "default",
                         first->formulation);
    imported *found = gather_rows(first, count);
    if (found == NULL)
        return fault_memory(r->f, "imported values");
    found->gates = r->gates;
    return import_cells_add(r->s, place, found, r->f);
}

static status take_case(store_reader *r, const char *of, const tables *t)
{
    for (int i = 0, count; i < t->values; i += count) {
        for (count = 1; i + count < t->values &&
                        strcmp(t->value[i + count].point, t->value[i].point) == 0 &&
                        strcmp(t->value[i + count].formulation, t->value[i].formulation) == 0;)
            count++;
        TRY(take_series(r, of, t, &t->value[i], count));
    }
    return STATUS_OK;
}

static status read_case(store_reader *r, hid_t at, const char *of)
{
    tables t = {0};
    void *rows = NULL;
    if (H5Lexists(at, "imports", H5P_DEFAULT) <= 0)
        return STATUS_OK;
    t.points = table_reader_rows(at, "points", COLUMNS(point_columns), sizeof *t.point, &rows);
    t.point = rows;
    rows = NULL;
    t.values = table_reader_rows(at, "imports", COLUMNS(value_columns), sizeof *t.value, &rows);
    if (t.values < 0)
        t.values =
            table_reader_rows(at, "imports", sizeof value_columns / sizeof *value_columns - 1,
                              value_columns, sizeof *t.value, &rows);
    t.value = rows;
    const status outcome = t.points < 0 || t.values < 0 ? damaged(r, of) : take_case(r, of, &t);
    free(t.point);
    free(t.value);
    return outcome;
}

static status read_named(store_reader *r, hid_t cases, const char *name)
{
    const hid_t here = H5Gopen2(cases, name, H5P_DEFAULT);
    if (here < 0)
        return damaged(r, name);
    const status outcome = read_case(r, here, name);
    H5Gclose(here);
    return outcome;
}

static status read_cases(store_reader *r, hid_t cases)
{
    char name[200];
    H5G_info_t info = {0};
    if (cases < 0 || H5Gget_info(cases, &info) < 0)
        return damaged(r, "cases");
    for (hsize_t i = 0; i < info.nlinks; i++) {
        if (H5Lget_name_by_idx(cases, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) <= 0)
            return damaged(r, "cases");
        TRY(read_named(r, cases, name));
    }
    return STATUS_OK;
}

static status read_file(store_reader *r, hid_t file)
{
    char schema[64];
    long version = 0;
    if (!table_reader_attribute_text(file, "schema", schema, sizeof schema) ||
        strcmp(schema, SCHEMA_NAME) != 0 ||
        !table_reader_attribute_count(file, "schema_version", &version) ||
        version < SCHEMA_OLDEST || version > SCHEMA_VERSION)
        return fault_set(r->f, STATUS_FAULT,
                         "%.120s is not a results file of this version of beamwork; %s", r->path,
                         remedy);
    if (H5Lexists(file, "cases", H5P_DEFAULT) <= 0) {
        char kinds[KEPT_NAMES];
        kept_names(file, kinds);
        return fault_set(r->f, STATUS_REFUSED,
                         "%.120s contains results of %.120s, not imported results; %s", r->path,
                         kinds, remedy);
    }
    const hid_t cases = H5Gopen2(file, "cases", H5P_DEFAULT);
    const status outcome = read_cases(r, cases);
    if (cases >= 0)
        H5Gclose(cases);
    TRY(outcome);
    if (r->left->all == 0)
        return fault_set(r->f, STATUS_REFUSED, "%.120s contains no imported results; %s", r->path,
                         remedy);
    return STATUS_OK;
}

status import_store_read(const char *path, int gates, sweep *s, import_left *left, fault *f)
{
    store_reader r = {path, gates, s, left, f};
    *left = (import_left){0, 0, ""};
    const char *dot = strrchr(path, '.');
    if (dot != NULL && strcmp(dot, ".csv") == 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.120s is a CSV file; convert it with 'beamwork import %.120s -o "
                         "theirs.h5', and give --imported theirs.h5",
                         path, path);
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT, "%.120s is not valid HDF5; %s", path, remedy);
    const status outcome = read_file(&r, file);
    H5Fclose(file);
    return outcome;
}
