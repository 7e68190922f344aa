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
    int version, elements, short_column;
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

static void put(hid_t at, const char *name, hid_t type, hsize_t rows, const void *value)
{
    const hid_t space = H5Screate_simple(1, &rows, NULL);
    const hid_t set = H5Dcreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value);
    H5Dclose(set);
    H5Sclose(space);
}

static void put_text(hid_t at, const recipe *r, const char *name, const char *text)
{
    char field[64] = "";
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, sizeof field);
    snprintf(field, sizeof field, "%s", text);
    if (strcmp(name, r->left_out_column) != 0)
        put(at, name, type, 1, field);
    H5Tclose(type);
}

static void put_truth(hid_t file, const recipe *r, const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0}, pair[2] = {r->value, r->value};
    int any[CASE_MAX_PARAMETERS] = {0};
    parameters_parse(type, r->parameters, value, any, NULL);
    const uint64_t hash = parameters_hash(type, value, any) + r->hash_change;
    const hid_t all = H5Gcreate2(file, "truths", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t at = H5Gcreate2(all, r->case_group != NULL ? r->case_group : type->name,
                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_text(at, r, "parameters", r->parameters);
    put_text(at, r, "formulation", r->formulation);
    put_text(at, r, "quantity", "load");
    put_text(at, r, "unit", "N");
    put_text(at, r, "kind", r->kind);
    put_text(at, r, "model", r->model);
    put_text(at, r, "theory", r->theory);
    put_text(at, r, "convention", r->convention);
    put_text(at, r, "source", "test");
    put(at, "value", H5T_NATIVE_DOUBLE, 1, pair);
    const double uncertainty[2] = {r->uncertainty, r->uncertainty};
    put(at, "uncertainty", H5T_NATIVE_DOUBLE, r->short_column ? 2 : 1, uncertainty);
    put(at, "at", H5T_NATIVE_DOUBLE, 1, &r->at);
    put(at, "elements", H5T_NATIVE_INT, 1, &r->elements);
    put(at, "hash", H5T_NATIVE_UINT64, 1, &hash);
    H5Gclose(at);
    H5Gclose(all);
}

static const char *or_else(const char *given, const char *usual)
{
    return given != NULL ? given : usual;
}

static void put_rule(hid_t file, const recipe *r, const case_type *type)
{
    const double largest = 0.1;
    const hid_t at = H5Gcreate2(file, "findings", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_text(at, r, "rule", "made_up");
    put_text(at, r, "formulations", "some* another:mass=lumped");
    put_text(at, r, "cases", or_else(r->rule_cases, type->name));
    put_text(at, r, "condition", or_else(r->condition, ""));
    put_text(at, r, "quantities", "lo?d");
    put_text(at, r, "verdicts", "low order|wrong limit");
    put_text(at, r, "predicted", or_else(r->predicted, ""));
    put_text(at, r, "cause", "test");
    put_text(at, r, "proof", "test");
    put(at, "largest_error", H5T_NATIVE_DOUBLE, 1, &largest);
    H5Gclose(at);
}

static void put_accepted(hid_t file, const recipe *r)
{
    const hid_t at = H5Gcreate2(file, "accepted", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_text(at, r, "formulation", or_else(r->accepted, registry_formulations[0]->name));
    H5Gclose(at);
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
