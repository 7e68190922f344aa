#include "harness/run/truths.h"

#include <fnmatch.h>
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/run/registry.h"

typedef struct reader {
    const char *path;
    hid_t group;
    char name[64]; /* of the group, for messages */
    int rows;
    fault *f;
} reader;

static status broken(const reader *r, const char *column)
{
    return fault_set(r->f, STATUS_FAULT, "%s: column %s of %s is missing or damaged; build it again ('make all')", r->path, column,
                     r->name);
}

/* Number of rows of a column, or -1. */
static int length_of(hid_t group, const char *column)
{
    hsize_t size = 0;
    const hid_t set = H5Dopen2(group, column, H5P_DEFAULT);
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    const int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 && H5Sget_simple_extent_dims(space, &size, NULL) == 1 &&
                     size < 10000000;
    if (space >= 0)
        H5Sclose(space);
    if (set >= 0)
        H5Dclose(set);
    return good ? (int)size : -1;
}

static status read_numbers(const reader *r, const char *column, hid_t type, void *out)
{
    const hid_t set = length_of(r->group, column) == r->rows ? H5Dopen2(r->group, column, H5P_DEFAULT) : -1;
    const int good = set >= 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0;
    if (set >= 0)
        H5Dclose(set);
    return good ? STATUS_OK : broken(r, column);
}

/* Fixed-length strings; out[rows], each malloced. */
static status read_strings(const reader *r, const char *column, char **out)
{
    const hid_t set = length_of(r->group, column) == r->rows ? H5Dopen2(r->group, column, H5P_DEFAULT) : -1;
    const hid_t stored = set >= 0 ? H5Dget_type(set) : -1;
    int good = stored >= 0 && H5Tget_class(stored) == H5T_STRING && !H5Tis_variable_str(stored);
    const size_t size = good ? H5Tget_size(stored) + 1 : 1;
    char *all = good && size < 100000 ? calloc((size_t)r->rows + 1, size) : NULL;
    const hid_t memory = good ? H5Tcopy(H5T_C_S1) : -1;
    good = good && all != NULL && memory >= 0 && H5Tset_size(memory, size) >= 0 && H5Tset_cset(memory, H5Tget_cset(stored)) >= 0 &&
           H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0;
    for (int i = 0; i < r->rows && good; i++)
        good = (out[i] = strndup(all + (size_t)i * size, size)) != NULL;
    free(all);
    if (memory >= 0)
        H5Tclose(memory);
    if (stored >= 0)
        H5Tclose(stored);
    if (set >= 0)
        H5Dclose(set);
    return good ? STATUS_OK : broken(r, column);
}

/* One column of strings into a field of an array of structs. */
static status read_field(const reader *r, const char *column, void *base, size_t stride, size_t offset)
{
    char **text = calloc((size_t)r->rows + 1, sizeof *text);
    status outcome = text == NULL ? fault_set(r->f, STATUS_FAULT, "out of memory for truths") : read_strings(r, column, text);
    for (int i = 0; i < r->rows && text != NULL; i++)
        memcpy((char *)base + (size_t)i * stride + offset, &text[i], sizeof text[i]);
    free(text);
    return outcome;
}

static status read_number_field(const reader *r, const char *column, void *base, size_t stride, size_t offset)
{
    double *value = calloc((size_t)r->rows + 1, sizeof *value);
    status outcome = value == NULL ? fault_set(r->f, STATUS_FAULT, "out of memory for truths")
                                   : read_numbers(r, column, H5T_NATIVE_DOUBLE, value);
    for (int i = 0; i < r->rows && value != NULL; i++)
        memcpy((char *)base + (size_t)i * stride + offset, &value[i], sizeof value[i]);
    free(value);
    return outcome;
}

/* Parameters of a row, and whether they still mean what they meant when the table was packed. */
static status check_row(const reader *r, const case_type *type, int i, const char *text, uint64_t hash, double value[], int any[])
{
    fault why = {""};
    if (parameters_parse(type, text, value, any, &why) != STATUS_OK)
        return fault_set(r->f, STATUS_FAULT, "%s: row %d of %s: %.200s", r->path, i + 1, r->name, why.text);
    if (parameters_hash(type, value, any) != hash)
        return fault_set(
            r->f, STATUS_FAULT,
            "%s: row %d of %s is stale: the defaults of the case have changed; correct reference/defaults.csv and its tables",
            r->path, i + 1, r->name);
    return STATUS_OK;
}

static status read_rows(const reader *r, const case_type *type, truth *row)
{
    static const struct {
        const char *name;
        size_t offset;
    } text[] = {{"formulation", offsetof(truth, formulation)},
                {"quantity", offsetof(truth, quantity)},
                {"unit", offsetof(truth, unit)},
                {"kind", offsetof(truth, kind)},
                {"model", offsetof(truth, model)},
                {"convention", offsetof(truth, convention)},
                {"source", offsetof(truth, source)}};
    char **parameters = calloc((size_t)r->rows + 1, sizeof *parameters);
    uint64_t *hash = calloc((size_t)r->rows + 1, sizeof *hash);
    int *elements = calloc((size_t)r->rows + 1, sizeof *elements);
    status outcome = STATUS_OK;
    if (parameters == NULL || hash == NULL || elements == NULL)
        outcome = fault_set(r->f, STATUS_FAULT, "out of memory for truths");
    for (size_t k = 0; k < sizeof text / sizeof text[0] && outcome == STATUS_OK; k++)
        outcome = read_field(r, text[k].name, row, sizeof *row, text[k].offset);
    if (outcome == STATUS_OK)
        outcome = read_number_field(r, "value", row, sizeof *row, offsetof(truth, value));
    if (outcome == STATUS_OK)
        outcome = read_number_field(r, "uncertainty", row, sizeof *row, offsetof(truth, uncertainty));
    if (outcome == STATUS_OK)
        outcome = read_numbers(r, "elements", H5T_NATIVE_INT, elements);
    if (outcome == STATUS_OK)
        outcome = read_numbers(r, "hash", H5T_NATIVE_UINT64, hash);
    if (outcome == STATUS_OK)
        outcome = read_strings(r, "parameters", parameters);
    for (int i = 0; i < r->rows && outcome == STATUS_OK; i++) {
        row[i].type = type;
        row[i].elements = elements[i];
        outcome = check_row(r, type, i, parameters[i], hash[i], row[i].parameter, row[i].any);
        if (outcome == STATUS_OK && !isfinite(row[i].value))
            outcome = broken(r, "value");
    }
    for (int i = 0; i < r->rows && parameters != NULL; i++)
        free(parameters[i]);
    free(parameters);
    free(hash);
    free(elements);
    return outcome;
}

static status read_case(const char *path, hid_t all, const case_type *type, truths *out, fault *f)
{
    reader r = {.path = path, .f = f};
    snprintf(r.name, sizeof r.name, "%s", type->name);
    if (H5Lexists(all, type->name, H5P_DEFAULT) <= 0)
        return STATUS_OK; /* a case without truths is reported by the judge */
    r.group = H5Gopen2(all, type->name, H5P_DEFAULT);
    r.rows = r.group >= 0 ? length_of(r.group, "value") : -1;
    status outcome = r.rows < 0 ? broken(&r, "value") : STATUS_OK;
    truth *more = outcome == STATUS_OK ? realloc(out->row, (size_t)(out->rows + r.rows + 1) * sizeof *more) : NULL;
    if (more != NULL) {
        out->row = more;
        memset(more + out->rows, 0, (size_t)r.rows * sizeof *more);
        out->rows += r.rows;
        outcome = read_rows(&r, type, more + out->rows - r.rows);
    }
    if (r.group >= 0)
        H5Gclose(r.group);
    return outcome;
}

static status check_finding(const reader *r, finding *row, int i, char *const case_name[], char *const parameters[])
{
    fault why = {""};
    for (int k = 0; registry_cases[k] != NULL; k++)
        if (strcmp(registry_cases[k]->name, case_name[i]) == 0)
            row[i].type = registry_cases[k];
    if (row[i].type != NULL && parameters_parse(row[i].type, parameters[i], row[i].parameter, row[i].any, &why) != STATUS_OK)
        return fault_set(r->f, STATUS_FAULT, "%s: finding %d: %.200s", r->path, i + 1, why.text);
    return STATUS_OK;
}

static status read_findings(const char *path, hid_t file, truths *out, fault *f)
{
    static const struct {
        const char *name;
        size_t offset;
    } text[] = {{"formulation", offsetof(finding, formulation)},
                {"quantity", offsetof(finding, quantity)},
                {"verdict", offsetof(finding, verdict)},
                {"proof", offsetof(finding, proof)}};
    reader r = {.path = path, .name = "findings", .f = f};
    r.group = H5Gopen2(file, "findings", H5P_DEFAULT);
    r.rows = r.group >= 0 ? length_of(r.group, "verdict") : -1;
    if (r.rows < 0)
        return broken(&r, "verdict");
    char **case_name = calloc((size_t)r.rows + 1, sizeof *case_name), **parameters = calloc((size_t)r.rows + 1, sizeof *parameters);
    out->finding = calloc((size_t)r.rows + 1, sizeof *out->finding);
    status outcome = STATUS_OK;
    if (case_name == NULL || parameters == NULL || out->finding == NULL)
        outcome = fault_set(f, STATUS_FAULT, "out of memory for findings");
    else
        out->findings = r.rows;
    for (size_t k = 0; k < sizeof text / sizeof text[0] && outcome == STATUS_OK; k++)
        outcome = read_field(&r, text[k].name, out->finding, sizeof *out->finding, text[k].offset);
    if (outcome == STATUS_OK)
        outcome = read_number_field(&r, "limit", out->finding, sizeof *out->finding, offsetof(finding, limit));
    if (outcome == STATUS_OK)
        outcome = read_number_field(&r, "uncertainty", out->finding, sizeof *out->finding, offsetof(finding, uncertainty));
    if (outcome == STATUS_OK)
        outcome = read_strings(&r, "case", case_name);
    if (outcome == STATUS_OK)
        outcome = read_strings(&r, "parameters", parameters);
    for (int i = 0; i < r.rows && outcome == STATUS_OK; i++)
        outcome = check_finding(&r, out->finding, i, case_name, parameters);
    for (int i = 0; i < r.rows && case_name != NULL && parameters != NULL; i++) {
        free(case_name[i]);
        free(parameters[i]);
    }
    free(case_name);
    free(parameters);
    H5Gclose(r.group);
    return outcome;
}

/* Is it ours, and of this version? */
static status check_schema(hid_t file, const char *path, fault *f)
{
    char name[64] = "";
    int version = 0;
    const hid_t schema = H5Aexists(file, "schema") > 0 ? H5Aopen(file, "schema", H5P_DEFAULT) : -1;
    const hid_t type = schema >= 0 ? H5Aget_type(schema) : -1;
    if (type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) && H5Tget_size(type) < sizeof name)
        H5Aread(schema, type, name);
    const hid_t number = H5Aexists(file, "version") > 0 ? H5Aopen(file, "version", H5P_DEFAULT) : -1;
    if (number >= 0)
        H5Aread(number, H5T_NATIVE_INT, &version);
    if (number >= 0)
        H5Aclose(number);
    if (type >= 0)
        H5Tclose(type);
    if (schema >= 0)
        H5Aclose(schema);
    if (strcmp(name, "beamwork-truths") != 0)
        return fault_set(f, STATUS_FAULT, "%s: not a file of truths; build it with 'make all'", path);
    if (version != TRUTHS_VERSION)
        return fault_set(f, STATUS_FAULT, "%s: truths of version %d, this program reads %d; build it again ('make all')", path,
                         version, TRUTHS_VERSION);
    return STATUS_OK;
}

status truths_read(const char *path, truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT,
                         "%s: cannot be read as HDF5 (missing, truncated or of another kind); build it with 'make all'", path);
    status outcome = check_schema(file, path, f);
    const hid_t all = outcome == STATUS_OK ? H5Gopen2(file, "truths", H5P_DEFAULT) : -1;
    if (outcome == STATUS_OK && all < 0)
        outcome = fault_set(f, STATUS_FAULT, "%s: no truths in it; build it again ('make all')", path);
    for (int i = 0; registry_cases[i] != NULL && outcome == STATUS_OK; i++)
        outcome = read_case(path, all, registry_cases[i], out, f);
    if (outcome == STATUS_OK)
        outcome = read_findings(path, file, out, f);
    if (all >= 0)
        H5Gclose(all);
    H5Fclose(file);
    if (outcome != STATUS_OK)
        truths_free(out);
    return outcome;
}

void truths_free(truths *t)
{
    for (int i = 0; i < t->rows; i++) {
        truth *r = &t->row[i];
        char *const all[] = {r->formulation, r->quantity, r->unit, r->kind, r->model, r->convention, r->source};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    for (int i = 0; i < t->findings; i++) {
        finding *r = &t->finding[i];
        char *const all[] = {r->formulation, r->quantity, r->verdict, r->proof};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    free(t->row);
    free(t->finding);
    memset(t, 0, sizeof *t);
}

static int same_point(const case_type *type, const double value[], const double at[], const int any[])
{
    for (int i = 0; type->parameters[i].name != NULL; i++)
        if (!any[i] && fabs(value[i] - at[i]) > 1e-14 * fabs(at[i]))
            return 0;
    return 1;
}

int truth_holds(const truth *row, const case_type *type, const double value[])
{
    return row->type == type && same_point(type, value, row->parameter, row->any);
}

int finding_holds(const finding *row, const case_type *type, const double value[], const char *key, const char *quantity)
{
    char bare[64];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(key, ":"), key);
    return row->type == type && same_point(type, value, row->parameter, row->any) && fnmatch(row->quantity, quantity, 0) == 0 &&
           (fnmatch(row->formulation, key, 0) == 0 || fnmatch(row->formulation, bare, 0) == 0);
}

static int rank(const char *kind)
{
    static const char *const order[] = {"exact", "independent", "consensus", "published", "reconstructed", "experiment"};
    for (int i = 0; i < 6; i++)
        if (strcmp(order[i], kind) == 0)
            return i;
    return 6;
}

const truth *truth_of(const truths *t, const case_type *type, const double value[], const char *quantity, const char *model)
{
    const truth *best = NULL;
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        const int fits = row->elements == 0 && row->formulation[0] == '\0' && strcmp(row->quantity, quantity) == 0 &&
                         strcmp(row->model, model) == 0;
        if (fits && truth_holds(row, type, value) && (best == NULL || rank(row->kind) < rank(best->kind)))
            best = row;
    }
    return best;
}
