#include "harness/truth/truths.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/choice.h"
#include "harness/catalogue/registry.h"
#include "harness/truth/checksum.h"
#include "harness/truth/columns.h"
#include "harness/truth/truth.h"

/* Parameters of a row, and whether they still mean what they meant when the table was packed. */
static status check_row(const columns *r, const case_type *type, int i, const char *text,
                        uint64_t hash, double value[], int any[])
{
    fault why = {""};
    if (parameters_parse(type, text, value, any, &why) != STATUS_OK)
        return fault_set(r->f, STATUS_FAULT, "%s: row %d of %s: %.200s", r->path, i + 1, r->name,
                         why.text);
    if (parameters_hash(type, value, any) != hash)
        return fault_set(r->f, STATUS_FAULT,
                         "%s: row %d of %s is stale: the defaults of the case have changed; "
                         "correct reference/defaults.csv and its tables",
                         r->path, i + 1, r->name);
    return STATUS_OK;
}

/* What a moment does while its node turns, and how prescribed rotations combine. */
static const char conventions[] =
    "vector|RyRzRx|spatial|spatial vector|spatial RyRzRx|semitangential|semitangential vector|"
    "semitangential RyRzRx|symmetrised|symmetrised vector|symmetrised RyRzRx";

static int is_known(const char *word, const char *choices)
{
    return choice_index(choices, word) >= 0;
}

static int is_known_or_empty(const char *word, const char *choices)
{
    return word[0] == '\0' || is_known(word, choices);
}

/* Are formulation and elements filled as the kind asks? */
static int elements_fit(const truth *row)
{
    const int of_formulation = row->formulation[0] != '\0';
    if (strcmp(row->kind, "predicted") == 0)
        return of_formulation && row->elements == 0;
    return row->elements >= 0 && (row->elements > 0) == of_formulation;
}

/* The first column that makes no sense, or NULL. */
static const char *wrong_column(const truth *row)
{
    if (!isfinite(row->value))
        return "value";
    if (!isfinite(row->uncertainty) || row->uncertainty < 0)
        return "uncertainty";
    if (isinf(row->at))
        return "at";
    if (!is_known(row->kind, truth_kinds))
        return "kind";
    if (!elements_fit(row))
        return "elements";
    if (!is_known(row->model, "same|other"))
        return "model";
    if (!is_known_or_empty(row->theory, TRUTH_THEORIES))
        return "theory";
    return is_known_or_empty(row->convention, conventions) ? NULL : "convention";
}

/* Columns of a table that are not members of a row. */
typedef struct loose_columns {
    char **parameters;
    uint64_t *hash;
    int *elements;
} loose_columns;

static status read_columns(const columns *r, loose_columns *loose, truth *row)
{
    static const columns_field field[] = {{"formulation", 1, offsetof(truth, formulation)},
                                          {"theory", 1, offsetof(truth, theory)},
                                          {"quantity", 1, offsetof(truth, quantity)},
                                          {"unit", 1, offsetof(truth, unit)},
                                          {"kind", 1, offsetof(truth, kind)},
                                          {"model", 1, offsetof(truth, model)},
                                          {"convention", 1, offsetof(truth, convention)},
                                          {"source", 1, offsetof(truth, source)},
                                          {"at", 0, offsetof(truth, at)},
                                          {"value", 0, offsetof(truth, value)},
                                          {"uncertainty", 0, offsetof(truth, uncertainty)}};
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(r, &field[k], row, sizeof *row));
    TRY(columns_numbers(r, "elements", H5T_NATIVE_INT, loose->elements));
    TRY(columns_numbers(r, "hash", H5T_NATIVE_UINT64, loose->hash));
    return columns_strings(r, "parameters", loose->parameters);
}

static status fill_rows(const columns *r, const case_type *type, const loose_columns *loose,
                        truth *row)
{
    for (int i = 0; i < r->rows; i++) {
        row[i].type = type;
        row[i].elements = loose->elements[i];
        row[i].on_curve = !isnan(row[i].at);
        TRY(check_row(r, type, i, loose->parameters[i], loose->hash[i], row[i].parameter,
                      row[i].any));
        const char *wrong = wrong_column(&row[i]);
        if (wrong != NULL)
            return columns_broken(r, wrong);
    }
    return STATUS_OK;
}

static status read_loose(const columns *r, const case_type *type, loose_columns *loose, truth *row)
{
    if (loose->parameters == NULL || loose->hash == NULL || loose->elements == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for truths");
    TRY(read_columns(r, loose, row));
    return fill_rows(r, type, loose, row);
}

static status read_rows(const columns *r, const case_type *type, truth *row)
{
    assert(r->rows >= 0);
    loose_columns loose = {.parameters = calloc((size_t)r->rows + 1, sizeof *loose.parameters),
                           .hash = calloc((size_t)r->rows + 1, sizeof *loose.hash),
                           .elements = calloc((size_t)r->rows + 1, sizeof *loose.elements)};
    const status outcome = read_loose(r, type, &loose, row);
    if (loose.parameters != NULL)
        for (int i = 0; i < r->rows; i++)
            free(loose.parameters[i]);
    free(loose.parameters);
    free(loose.hash);
    free(loose.elements);
    return outcome;
}

static status read_table(columns *r, const case_type *type, truths *out)
{
    r->rows = r->group >= 0 ? columns_length(r->group, "value") : -1;
    if (r->rows < 0)
        return columns_broken(r, "value");
    truth *more = realloc(out->row, (size_t)(out->rows + r->rows + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for truths");
    out->row = more;
    memset(more + out->rows, 0, (size_t)r->rows * sizeof *more);
    out->rows += r->rows;
    return read_rows(r, type, more + out->rows - r->rows);
}

static status read_case(const char *path, hid_t all, const case_type *type, truths *out, fault *f)
{
    columns r = {.path = path, .f = f};
    snprintf(r.name, sizeof r.name, "%s", type->name);
    if (H5Lexists(all, type->name, H5P_DEFAULT) <= 0)
        return STATUS_OK; /* its verdicts will be "no truth" */
    r.group = H5Gopen2(all, type->name, H5P_DEFAULT);
    const status outcome = read_table(&r, type, out);
    if (r.group >= 0)
        H5Gclose(r.group);
    return outcome;
}

static status read_cases(const char *path, hid_t all, truths *out, fault *f)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        TRY(read_case(path, all, registry_cases[i], out, f));
    return STATUS_OK;
}

/* Tables of cases that do not exist would otherwise never be missed. */
static void find_strangers(hid_t all, truths *out)
{
    char name[64];
    for (hsize_t i = 0; H5Lget_name_by_idx(all, ".", H5_INDEX_NAME, H5_ITER_INC, i, name,
                                           sizeof name, H5P_DEFAULT) > 0;
         i++) {
        int known = 0;
        for (int k = 0; registry_cases[k] != NULL; k++)
            known |= strcmp(registry_cases[k]->name, name) == 0;
        if (!known && out->strangers++ == 0)
            snprintf(out->stranger, sizeof out->stranger, "%s", name);
    }
}

/* Is it ours, and of this version? */
static status check_schema(hid_t file, const char *path, fault *f)
{
    char name[64] = "";
    int version = 0;
    const hid_t schema = H5Aexists(file, "schema") > 0 ? H5Aopen(file, "schema", H5P_DEFAULT) : -1;
    const hid_t type = schema >= 0 ? H5Aget_type(schema) : -1;
    if (type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) &&
        H5Tget_size(type) < sizeof name)
        H5Aread(schema, type, name);
    const hid_t number =
        H5Aexists(file, "version") > 0 ? H5Aopen(file, "version", H5P_DEFAULT) : -1;
    if (number >= 0)
        H5Aread(number, H5T_NATIVE_INT, &version);
    if (number >= 0)
        H5Aclose(number);
    if (type >= 0)
        H5Tclose(type);
    if (schema >= 0)
        H5Aclose(schema);
    if (strcmp(name, "beamwork-truths") != 0)
        return fault_set(f, STATUS_FAULT, "%s: not a file of truths; build it with 'make all'",
                         path);
    if (version != TRUTHS_VERSION)
        return fault_set(
            f, STATUS_FAULT,
            "%s: truths of version %d, this program reads %d; build it again ('make all')", path,
            version, TRUTHS_VERSION);
    return STATUS_OK;
}

/* The tables of one group, one for every case. */
static status read_tables(const char *path, hid_t file, const char *name, truths *out, fault *f)
{
    const hid_t all = H5Gopen2(file, name, H5P_DEFAULT);
    if (all < 0)
        return fault_set(f, STATUS_FAULT, "%s: no %s in it; build it again ('make all')", path,
                         name);
    const status outcome = read_cases(path, all, out, f);
    if (outcome == STATUS_OK)
        find_strangers(all, out);
    H5Gclose(all);
    return outcome;
}

/* FAULT when it is damaged or not ours; below 0: nothing is open. */
static status open_truths(const char *path, hid_t *file, fault *f)
{
    *file = -1;
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file < 0)
        return fault_set(f, STATUS_FAULT, "%s: cannot be read as HDF5; build it with 'make all'",
                         path);
    return check_schema(*file, path, f);
}

/* With what read_file closes. group NULL: no tables. */
static status read_open(const char *path, const char *group, int with_rules, hid_t *file,
                        truths *out, fault *f)
{
    TRY(open_truths(path, file, f));
    if (group != NULL)
        TRY(read_tables(path, *file, group, out, f));
    return with_rules ? rules_read(path, *file, &out->rule, &out->rules, f) : STATUS_OK;
}

static status read_file(const char *path, const char *group, int with_rules, truths *out, fault *f)
{
    hid_t file;
    const status outcome = read_open(path, group, with_rules, &file, out, f);
    if (file >= 0)
        H5Fclose(file);
    return outcome;
}

status truths_read(const char *path, truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    const status outcome = read_file(path, "truths", 1, out, f);
    if (outcome != STATUS_OK)
        truths_free(out);
    return outcome;
}

status truths_read_rules(const char *path, truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    const status outcome = read_file(path, NULL, 1, out, f);
    if (outcome != STATUS_OK)
        truths_free(out);
    return outcome;
}

status truths_read_extremes(const char *path, truths *out, fault *f)
{
    return read_file(path, "extremes", 0, out, f);
}

void truths_free(truths *t)
{
    for (int i = 0; i < t->rows; i++) {
        truth *r = &t->row[i];
        char *const all[] = {r->formulation, r->theory, r->quantity,   r->unit,
                             r->kind,        r->model,  r->convention, r->source};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    rules_free(t->rule, t->rules);
    free(t->row);
    memset(t, 0, sizeof *t);
}
