/* Makes a small file of reference values, valid or invalid in one respect. */
#ifndef BEAMWORK_TEST_TRUTHS_FILE_H
#define BEAMWORK_TEST_TRUTHS_FILE_H

#include <gsl/gsl_test.h>
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Contents of the file. The defaults are valid. */
typedef struct recipe {
    const char *schema, *case_group, *kind, *model, *theory, *convention, *formulation, *parameters,
        *left_out_column, *rule_cases, *condition, *predicted, *accepted;
    int version, elements, single_precision;
    double value, uncertainty, at;
    uint64_t hash_change;
} recipe;

static const recipe right = {.schema = "beamwork-truths",
                             .kind = "exact",
                             .model = "same",
                             .formulation = "",
                             .parameters = "",
                             .left_out_column = "",
                             .theory = "",
                             .convention = "",
                             .version = TRUTHS_VERSION,
                             .value = 3,
                             .uncertainty = 1e-9,
                             .at = NAN};

/* A table of one row. */
typedef struct table_made {
    struct {
        const char *name;
        hid_t type;
        size_t offset;
    } column[16];
    int columns;
    size_t size;
    char row[16 * 64];
} table_made;

static void put(table_made *t, const char *name, hid_t type, const void *value)
{
    t->column[t->columns].name = name;
    t->column[t->columns].type = H5Tcopy(type);
    t->column[t->columns++].offset = t->size;
    memcpy(t->row + t->size, value, H5Tget_size(type));
    t->size += H5Tget_size(type);
}

static void put_text(table_made *t, const recipe *r, const char *name, const char *text)
{
    char field[64] = "";
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, sizeof field);
    snprintf(field, sizeof field, "%s", text);
    if (strcmp(name, r->left_out_column) != 0)
        put(t, name, type, field);
    H5Tclose(type);
}

static void put_table(hid_t at, const char *name, table_made *t)
{
    const hsize_t rows = 1;
    const hid_t type = t->size > 0 ? H5Tcreate(H5T_COMPOUND, t->size) : H5Tcopy(H5T_NATIVE_INT),
                space = H5Screate_simple(1, &rows, NULL);
    for (int i = 0; i < t->columns; i++) {
        H5Tinsert(type, t->column[i].name, t->column[i].offset, t->column[i].type);
        H5Tclose(t->column[i].type);
    }
    const hid_t set = H5Dcreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, t->row);
    handles_close(3, (const hid_t[]){set, space, type});
}

static void put_truth(hid_t file, const recipe *r, const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    int any[CASE_MAX_PARAMETERS] = {0};
    parameters_parse(type, r->parameters, value, any, NULL);
    const uint64_t hash = parameters_hash(type, value, any) + r->hash_change;
    const hid_t all = H5Gcreate2(file, "truths", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const float single = (float)r->uncertainty;
    table_made t = {.columns = 0};
    put_text(&t, r, "parameters", r->parameters);
    put_text(&t, r, "formulation", r->formulation);
    put_text(&t, r, "quantity", "load");
    put_text(&t, r, "unit", "N");
    put_text(&t, r, "kind", r->kind);
    put_text(&t, r, "model", r->model);
    put_text(&t, r, "theory", r->theory);
    put_text(&t, r, "convention", r->convention);
    put_text(&t, r, "source", "test");
    put(&t, "value", H5T_NATIVE_DOUBLE, &r->value);
    if (r->single_precision)
        put(&t, "uncertainty", H5T_NATIVE_FLOAT, &single);
    else
        put(&t, "uncertainty", H5T_NATIVE_DOUBLE, &r->uncertainty);
    put(&t, "at", H5T_NATIVE_DOUBLE, &r->at);
    put(&t, "elements", H5T_NATIVE_INT, &r->elements);
    put(&t, "hash", H5T_NATIVE_UINT64, &hash);
    put_table(all, r->case_group != NULL ? r->case_group : type->name, &t);
    H5Gclose(all);
}

static const char *or_else(const char *given, const char *usual)
{
    return given != NULL ? given : usual;
}

static void put_rule(hid_t file, const recipe *r, const case_type *type)
{
    const double largest = 0.1;
    table_made t = {.columns = 0};
    put_text(&t, r, "rule", "made_up");
    put_text(&t, r, "formulations", "some* another:mass=lumped");
    put_text(&t, r, "cases", or_else(r->rule_cases, type->name));
    put_text(&t, r, "condition", or_else(r->condition, ""));
    put_text(&t, r, "quantities", "lo?d");
    put_text(&t, r, "verdicts", "low order|wrong limit");
    put_text(&t, r, "predicted", or_else(r->predicted, ""));
    put_text(&t, r, "cause", "test");
    put_text(&t, r, "proof", "test");
    put(&t, "largest_error", H5T_NATIVE_DOUBLE, &largest);
    put_table(file, "findings", &t);
}

static void put_accepted(hid_t file, const recipe *r)
{
    table_made t = {.columns = 0};
    put_text(&t, r, "formulation", or_else(r->accepted, registry_formulations[0]->name));
    put_table(file, "accepted", &t);
}

static void truths_file_checksum(const char *path)
{
    static char all[1 << 20];
    char line[CHECKSUM_LENGTH + 1];
    FILE *file = fopen(path, "rb+");
    const size_t size = fread(all, 1, sizeof all, file);
    checksum_write(all, size, line);
    fseek(file, 0, SEEK_END);
    fputs(line, file);
    fclose(file);
}

static void truths_file_make(const char *path, const recipe *r)
{
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                scalar = H5Screate(H5S_SCALAR);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(r->schema) + 1);
    hid_t a = H5Acreate2(file, "schema", type, scalar, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, type, r->schema);
    H5Aclose(a);
    a = H5Acreate2(file, "version", H5T_NATIVE_INT, scalar, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, H5T_NATIVE_INT, &r->version);
    H5Aclose(a);
    put_truth(file, r, registry_cases[0]);
    put_rule(file, r, registry_cases[0]);
    put_accepted(file, r);
    H5Tclose(type);
    H5Sclose(scalar);
    H5Fclose(file);
    truths_file_checksum(path);
}

/* Checks that the file is rejected, with a message of one line that contains `word`. */
static inline void truths_file_refused(const char *path, const char *word, recipe r,
                                       const char *what)
{
    truths t;
    fault f = {""};
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_FAULT || strstr(f.text, word) == NULL ||
                 strchr(f.text, '\n') != NULL || strstr(f.text, path) == NULL || t.rows != 0,
             "%s: %s", what, f.text);
}

/* Runs every test with the path of the same temporary file. Returns the exit status of the test
 * program. */
static int truths_file_run(int count, void (*const test[])(const char *path))
{
    char path[] = "/tmp/beamwork-truths-XXXXXX";
    const int file = mkstemp(path);
    if (file < 0)
        return 1;
    close(file);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    for (int i = 0; i < count; i++)
        test[i](path);
    unlink(path);
    return gsl_test_summary();
}

#endif
