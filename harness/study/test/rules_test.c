/* Rules of the list of known deviations: the verdicts to which they apply, their conditions, and
 * whether they are observed. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study_impl.h"
#include "harness/study/test/truths_file.h"

static int holds(const char *path, const char *condition, const rule_subject *s)
{
    truths t;
    fault f = {""};
    recipe r = right;
    r.condition = condition;
    truths_file_make(path, &r);
    const int read = truths_read(path, &t, &f) == STATUS_OK,
              out = read && rules_hold(&t.rule[0], s);
    gsl_test(!read, "condition '%s' is read %s", condition, f.text);
    truths_free(&t);
    return out;
}

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

/* first: index of a numeric parameter of the case */
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
        truths_file_refused(path, "condition", r, wrong[i]);
    }
    snprintf(text, sizeof text, "%s=many", parameter_at(type->parameters, first)->name);
    recipe r = right;
    r.condition = text;
    truths_file_refused(path, "condition", r, "a word for a number");
}

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
    gsl_test(rules_is_observed(one), "not observed yet");
    one->observed = 1;
    gsl_test(rules_is_observed(one), "observed, but not as predicted");
    rules_confirm_limit(one, &(rule_subject){.type = type, .quantity = "other"});
    rules_confirm_limit(one, &(rule_subject){.type = type, .quantity = "third"});
    gsl_test(rules_is_observed(one), "one of two predictions met");
    rules_confirm_limit(one, &(rule_subject){.type = type, .quantity = "load"});
    gsl_test(!rules_is_observed(one), "both");
    one->observed = 0;
    gsl_test(rules_is_observed(one), "predictions alone are no observation");
    truths_free(&t);
}

int main(void)
{
    static void (*const all[])(const char *) = {subjects, conditions, predictions};
    return truths_file_run((int)(sizeof all / sizeof all[0]), all);
}
