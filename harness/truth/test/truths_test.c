/* Files of truths made here: a good one, and every way in which one can be wrong. */
#include <gsl/gsl_test.h>
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/test/random.h"
#include "harness/catalogue/registry.h"
#include "harness/truth/test/truths_file.h"
#include "harness/truth/truth.h"
#include "harness/truth/truths.h"

/* HDF5 1.10 keeps a few bytes of a damaged file's head for good; our own leaks are still found. */
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

static void refused(const char *path, const char *word, recipe r, const char *what)
{
    truths t;
    fault f = {""};
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_FAULT || strstr(f.text, word) == NULL ||
                 strchr(f.text, '\n') != NULL || strstr(f.text, path) == NULL || t.rows != 0,
             "%s: %s", what, f.text);
}

static void wrong_files(const char *path)
{
    recipe r = right;
    r.hash_change = 1;
    refused(path, "stale", r, "hash of other defaults");
    r = right;
    r.schema = "beamwork-results";
    refused(path, "not a file of truths", r, "foreign schema");
    r = right;
    r.version = TRUTHS_VERSION + 1;
    refused(path, "version", r, "newer version");
    r = right;
    r.left_out_column = "unit";
    refused(path, "unit", r, "missing column");
    r.left_out_column = "proof";
    refused(path, "proof", r, "missing column of the findings");
    r = right;
    r.short_column = 1;
    refused(path, "uncertainty", r, "columns of different length");
    r = right;
    r.value = NAN;
    refused(path, "value", r, "not a number");
    r = right;
    r.uncertainty = -1;
    refused(path, "uncertainty", r, "negative uncertainty");
    r.uncertainty = INFINITY;
    refused(path, "uncertainty", r, "infinite uncertainty");
    r = right;
    r.kind = "rumour";
    refused(path, "kind", r, "unknown kind");
    r = right;
    r.model = "";
    refused(path, "model", r, "no model");
    r = right;
    r.elements = 4;
    refused(path, "elements", r, "a mesh without a formulation");
    r.elements = -1;
    refused(path, "elements", r, "negative number of elements");
    r = right;
    r.kind = "predicted";
    refused(path, "elements", r, "a predicted limit of no formulation");
    r.formulation = "beamw";
    r.elements = 4;
    refused(path, "elements", r, "a predicted limit of one mesh");
    r = right;
    r.theory = "timoshenko";
    refused(path, "theory", r, "unknown theory");
    r = right;
    r.convention = "spatial moments";
    refused(path, "convention", r, "unknown convention");
    r = right;
    r.at = INFINITY;
    refused(path, "at", r, "infinite abscissa");
}

/* Rows that no limit is judged by: of one formulation, of a curve, of no gate. */
static void rows_that_do_not_judge(const char *path)
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

/* A parameter of any value, or all of them: such a row speaks of every point that has the rest. */
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

/* Every length of a file but the whole one, in steps; and bits turned over: refused. */
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

static void strangers(const char *path)
{
    truths t;
    fault f = {""};
    recipe r = right;
    r.case_group = "no_such_case";
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK || t.rows != 0 || t.strangers != 1 ||
                 strcmp(t.stranger, "no_such_case") != 0,
             "truths of an unknown case are counted");
    truths_free(&t);
    r = right;
    r.rule_cases = "no_such_case";
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK,
             "a rule of an unknown case may be there: nobody observes it");
    truths_free(&t);
}

/* Does the rule, with this condition, hold for a point of the first case? */
static int holds(const char *path, const char *condition, const rule_subject *s)
{
    truths t;
    fault f = {""};
    recipe r = right;
    r.condition = condition;
    truths_file_make(path, &r);
    const int read = truths_read(path, &t, &f) == STATUS_OK,
              out = read && rule_holds(&t.rule[0], s);
    gsl_test(!read, "condition '%s' is read %s", condition, f.text);
    truths_free(&t);
    return out;
}

/* Every part of a rule must fit by itself. */
static void subjects(const char *path)
{
    const case_type *type = registry_cases[0];
    double value[CASE_MAX_PARAMETERS] = {0};
    parameters_default(type, value);
    const rule_subject fits = {type,   value,        FEATURE_SHEAR, "something:mass=lumped",
                               "load", "wrong limit"};
    rule_subject s = fits;
    gsl_test(!holds(path, "", &s), "a rule fits: a pattern, its bare name");
    s.formulation = "another:mass=lumped";
    gsl_test(!holds(path, "", &s), "a name with its option");
    s.formulation = "another";
    gsl_test(holds(path, "", &s), "the name without its option");
    s = fits;
    s.quantity = "loads";
    gsl_test(holds(path, "", &s), "another quantity");
    s = fits;
    s.verdict = "diverged";
    gsl_test(holds(path, "", &s), "a verdict that it does not allow");
    s = fits;
    s.type = registry_cases[1];
    gsl_test(holds(path, "", &s), "another case");
}

/* first: a parameter of the case that is a number. */
static void conditions(const char *path)
{
    const case_type *type = registry_cases[0];
    double value[CASE_MAX_PARAMETERS] = {0};
    parameters_default(type, value);
    int first = 0;
    while (parameter_at(type->parameters, first)->choices != NULL)
        first++;
    value[first] = 0.25;
    const rule_subject s = {type,   value,  FEATURE_SHEAR | FEATURE_WAGNER_TORQUE,
                            "some", "load", "low order"};
    static const struct {
        const char *sign;
        int holds;
    } terms[] = {{"=0.25", 1},      {"=0.3", 0},  {"=0.3|0.25", 1}, {"!=0.25", 0}, {"!=0.3", 1},
                 {"!=0.3|0.25", 0}, {"<0.25", 0}, {"<0.26", 1},     {"<=0.25", 1}, {"<=0.24", 0},
                 {">0.25", 0},      {">0.24", 1}, {">=0.25", 1},    {">=0.26", 0}};
    char text[64];
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++) {
        snprintf(text, sizeof text, "%s%s", parameter_at(type->parameters, first)->name,
                 terms[i].sign);
        gsl_test_int(holds(path, text, &s), terms[i].holds, "condition %s where it is 0.25", text);
    }
    gsl_test_int(holds(path, "shear", &s), 1, "a feature that is needed");
    gsl_test_int(holds(path, "not shear", &s), 0, "not");
    gsl_test_int(holds(path, "warping", &s), 0, "a feature that is not needed");
    gsl_test_int(holds(path, "not warping; wagner torque", &s), 1, "two terms that hold");
    gsl_test_int(holds(path, "wagner torque;warping", &s), 0, "two terms of which one does not");
    static const char *const wrong[] = {"sheer", "no_parameter=1", "shear=1;", "=3",
                                        "shear and warping"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        recipe r = right;
        r.condition = wrong[i];
        refused(path, "condition", r, wrong[i]);
    }
    snprintf(text, sizeof text, "%s=many", parameter_at(type->parameters, first)->name);
    recipe r = right;
    r.condition = text;
    refused(path, "condition", r, "a word for a number");
}

/* A rule is observed when a verdict shows it and verdicts meet each of its predictions. */
static void predictions(const char *path)
{
    truths t;
    fault f = {""};
    char text[128];
    const case_type *type = registry_cases[0];
    recipe r = right;
    snprintf(text, sizeof text, "%s/load %s/other", type->name, type->name);
    r.predicted = text;
    truths_file_make(path, &r);
    gsl_test(truths_read(path, &t, &f) != STATUS_OK, "a rule with two predictions %s", f.text);
    rule *one = &t.rule[0];
    gsl_test(rule_is_observed(one), "not observed yet");
    one->observed = 1;
    gsl_test(rule_is_observed(one), "observed, but not as predicted");
    rule_foretell(one, &(rule_subject){.type = type, .quantity = "other"});
    rule_foretell(one, &(rule_subject){.type = type, .quantity = "third"});
    gsl_test(rule_is_observed(one), "one of two predictions met");
    rule_foretell(one, &(rule_subject){.type = type, .quantity = "load"});
    gsl_test(!rule_is_observed(one), "both");
    one->observed = 0;
    gsl_test(rule_is_observed(one), "predictions alone are no observation");
    truths_free(&t);
}

int main(void)
{
    char path[] = "/tmp/beamwork-truths-XXXXXX";
    const int file = mkstemp(path);
    if (file < 0)
        return 1;
    close(file);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    good_file(path);
    wrong_files(path);
    rows_that_do_not_judge(path);
    any_value(path);
    new_columns(path);
    damaged_files(path);
    strangers(path);
    subjects(path);
    conditions(path);
    predictions(path);
    unlink(path);
    return gsl_test_summary();
}
