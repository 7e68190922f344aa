/* A valid file of reference values must be read, and invalid files of every kind must be
 * rejected. */
#include <gsl/gsl_test.h>
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/study/test/truths_file.h"

/* In a damaged file, HDF5 1.10 never frees a few bytes of the header. Only these leaks are
 * ignored. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5\n";
}

static void good_file(const char *path)
{
    truths t;
    fault f = {""};
    double value[CASE_MAX_PARAMETERS] = {0};
    const case_type *type = registry_cases[0];
    truths_file_make(path, &right);
    parameters_default(type, value);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK, "a good file is read %s", f.text);
    gsl_test_int(t.rows, 1, "one truth");
    gsl_test_int(t.rules, 1, "one rule");
    const truth *row = truth_of(&t, type, value, "load", "same");
    gsl_test(row == NULL || row->value != 3 || row->uncertainty != 1e-9 ||
                 strcmp(row->unit, "N") != 0,
             "its fields");
    gsl_test(truth_of(&t, type, value, "load", "other") != NULL, "no truth of another model");
    value[0] += 1;
    gsl_test(truth_of(&t, type, value, "load", "same") != NULL, "another point has no truth");
    truths_free(&t);
}

static void wrong_files(const char *path)
{
    recipe r = right;
    r.hash_change = 1;
    truths_file_refused(path, "stale", r, "hash of other defaults");
    r = right;
    r.schema = "beamwork-results";
    truths_file_refused(path, "does not contain reference values", r, "foreign schema");
    r = right;
    r.version = TRUTHS_VERSION + 1;
    truths_file_refused(path, "version", r, "newer version");
    r = right;
    r.left_out_column = "unit";
    truths_file_refused(path, "unit", r, "missing column");
    r.left_out_column = "proof";
    truths_file_refused(path, "proof", r, "missing column of the findings");
    r = right;
    r.single_precision = 1;
    truths_file_refused(path, registry_cases[0]->name, r, "a column in single precision");
    r = right;
    r.value = NAN;
    truths_file_refused(path, "value", r, "not a number");
    r = right;
    r.uncertainty = -1;
    truths_file_refused(path, "uncertainty", r, "negative uncertainty");
    r.uncertainty = INFINITY;
    truths_file_refused(path, "uncertainty", r, "infinite uncertainty");
    r = right;
    r.kind = "rumour";
    truths_file_refused(path, "kind", r, "unknown kind");
    r = right;
    r.model = "";
    truths_file_refused(path, "model", r, "no model");
    r = right;
    r.elements = 4;
    truths_file_refused(path, "elements", r, "a mesh without a formulation");
    r.elements = -1;
    truths_file_refused(path, "elements", r, "negative number of elements");
    r = right;
    r.kind = "predicted";
    truths_file_refused(path, "elements", r, "a predicted limit of no formulation");
    r.formulation = "beamw";
    r.elements = 4;
    truths_file_refused(path, "elements", r, "a predicted limit of one mesh");
    r = right;
    r.theory = "timoshenko";
    truths_file_refused(path, "theory", r, "unknown theory");
    r = right;
    r.convention = "spatial moments";
    truths_file_refused(path, "convention", r, "unknown convention");
    r = right;
    r.at = INFINITY;
    truths_file_refused(path, "at", r, "infinite abscissa");
}

static void rows_without_effect(const char *path)
{
    recipe of_formulation = right, of_curve = right, agreed = right, unrepeatable = right;
    of_formulation.kind = "predicted";
    of_formulation.formulation = "beamw";
    of_curve.at = 0.5;
    agreed.kind = "agreement";
    unrepeatable.kind = "unrepeatable";
    const recipe all[] = {of_formulation, of_curve, agreed, unrepeatable};
    for (int i = 0; i < 4; i++) {
        truths t;
        fault f = {""};
        double value[CASE_MAX_PARAMETERS] = {0};
        truths_file_make(path, &all[i]);
        parameters_default(registry_cases[0], value);
        gsl_test(truths_read(path, &t, &f) != STATUS_OK || t.rows != 1, "row %d is read %s", i,
                 f.text);
        gsl_test(truth_of(&t, registry_cases[0], value, "load", "same") != NULL,
                 "row %d judges nothing", i);
        truths_free(&t);
    }
}

static void any_value(const char *path)
{
    const case_type *type = registry_cases[0];
    char text[128];
    for (int all = 0; all < 2; all++) {
        truths t;
        fault f = {""};
        double value[CASE_MAX_PARAMETERS] = {0};
        recipe r = right;
        snprintf(text, sizeof text, "%s=*", parameter_at(type->parameters, 1)->name);
        r.parameters = all ? "*" : text;
        truths_file_make(path, &r);
        gsl_test(truths_read(path, &t, &f) != STATUS_OK, "%s is read %s", r.parameters, f.text);
        parameters_default(type, value);
        gsl_test(truth_of(&t, type, value, "load", "same") == NULL, "%s: the defaults",
                 r.parameters);
        value[1] = parameter_at(type->parameters, 1)->max;
        gsl_test(truth_of(&t, type, value, "load", "same") == NULL, "%s: another value",
                 r.parameters);
        value[0] += 1;
        gsl_test((truth_of(&t, type, value, "load", "same") != NULL) != all,
                 "%s: another value of another one", r.parameters);
        truths_free(&t);
    }
}

static void new_columns(const char *path)
{
    recipe r = right;
    truths t;
    fault f = {""};
    r.theory = "haringx";
    r.convention = "spatial RyRzRx";
    r.at = 0.5;
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK || strcmp(t.row[0].theory, r.theory) != 0 ||
                 strcmp(t.row[0].convention, r.convention) != 0 || t.row[0].on_curve != 1 ||
                 t.row[0].at != 0.5,
             "theory, convention and abscissa %s", f.text);
    truths_free(&t);
}

static void damaged_files(const char *path)
{
    static char bytes[1 << 20];
    truths t;
    fault f = {""};
    truths_file_make(path, &right);
    FILE *file = fopen(path, "rb");
    const size_t size = file != NULL ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file != NULL)
        fclose(file);
    gsl_test(size == 0 || size == sizeof bytes, "a whole file in memory");
    int accepted = 0, turned = 0, broken = 0, left_open = 0;
    for (size_t cut = 0; cut < size; cut += 97) {
        file = fopen(path, "wb");
        fwrite(bytes, 1, cut, file);
        fclose(file);
        if (truths_read(path, &t, &f) == STATUS_OK)
            accepted++;
        truths_free(&t);
    }
    gsl_test_int(accepted, 0, "truncated files that were accepted");
    uint64_t random = 12345;
    for (int i = 0; i < 400; i++) {
        const size_t at = (size_t)random_below(&random, (int)size);
        const char kept = bytes[at];
        bytes[at] = (char)(bytes[at] ^ (1 << (i & 7)));
        file = fopen(path, "wb");
        fwrite(bytes, 1, size, file);
        fclose(file);
        bytes[at] = kept;
        const status outcome = truths_read(path, &t, &f);
        turned += outcome == STATUS_OK;
        left_open += H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) > 0;
        broken += outcome != STATUS_OK &&
                  (outcome != STATUS_FAULT || f.text[0] == '\0' || strchr(f.text, '\n') != NULL);
        truths_free(&t);
    }
    gsl_test_int(turned, 0, "files with a bit turned over that were accepted");
    gsl_test_int(left_open, 0, "damaged files that stay open");
    gsl_test_int(broken, 0, "damaged files without a clear refusal");
}

static void accepted_ones(const char *path)
{
    truths t;
    fault f = {""};
    recipe r = right;
    for (int i = 0; registry_formulations[i] != NULL; i++)
        gsl_test(formulations_is_new(registry_formulations[i]), "%s gates before a table is read",
                 registry_formulations[i]->name);
    r.accepted = "no_such_formulation";
    truths_file_make(path, &r);
    gsl_test(truths_read_rules(path, &t, &f) != STATUS_OK, "one that is not here %s", f.text);
    truths_free(&t);
    truths_file_make(path, &right);
    gsl_test(truths_read_rules(path, &t, &f) != STATUS_OK, "the first one is accepted %s", f.text);
    truths_free(&t);
    for (int i = 0; registry_formulations[i] != NULL; i++)
        gsl_test_int(formulations_is_new(registry_formulations[i]), i > 0, "%s is new",
                     registry_formulations[i]->name);
    r.left_out_column = "formulation";
    truths_file_make(path, &r);
    gsl_test(truths_read_rules(path, &t, &f) != STATUS_FAULT || strstr(f.text, "accepted") == NULL,
             "a table without its column: %s", f.text);
}

static void unknown_cases(const char *path)
{
    truths t;
    fault f = {""};
    recipe r = right;
    r.case_group = "no_such_case";
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK || t.rows != 0 || t.unknown_cases != 1 ||
                 strcmp(t.unknown_case, "no_such_case") != 0,
             "truths of an unknown case are counted");
    truths_free(&t);
    r = right;
    r.rule_cases = "no_such_case";
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK,
             "a rule of an unknown case may be there: nobody observes it");
    truths_free(&t);
}

int main(void)
{
    static void (*const all[])(const char *) = {accepted_ones,       good_file,    wrong_files,
                                                rows_without_effect, any_value,    new_columns,
                                                damaged_files,       unknown_cases};
    return truths_file_run((int)(sizeof all / sizeof all[0]), all);
}
