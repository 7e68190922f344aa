/* Integrators, steps and tolerances as a command line has them. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments.h"

static void list_is(const char *text, double ratio, int count, const double right[])
{
    pace_list out;
    fault f = {""};
    gsl_test(pace_list_read("step", text, ratio, &out, &f) != STATUS_OK, "%s is read: %s", text,
             f.text);
    gsl_test_int(out.count, count, "%s: values", text);
    for (int i = 0; i < count && i < out.count; i++)
        gsl_test_rel(out.value[i], right[i], 4e-16, "%s: value %d", text, i);
}

static void list_is_refused(const char *text)
{
    pace_list out;
    fault f = {""};
    gsl_test(pace_list_read("step", text, 2, &out, &f) != STATUS_REFUSED, "%s is refused", text);
    gsl_test(strstr(f.text, "--step") == NULL || strstr(f.text, text) == NULL,
             "%s: culprit and option are named: %s", text, f.text);
}

static void lists(void)
{
    list_is("0.1", 2, 1, (double[]){0.1});
    list_is("0.1,0.03", 2, 2, (double[]){0.1, 0.03});
    list_is("0.1..0.025", 2, 3, (double[]){0.1, 0.05, 0.025});
    list_is("8..1", 2, 4, (double[]){8, 4, 2, 1});
    list_is("1e-4..1e-8", 100, 3, (double[]){1e-4, 1e-6, 1e-8});
    const char *const wrong[] = {
        "",         "0",           "-1",      "0.1,",
        "0.1..0.2", "a",           "0.1;0.2", "0.1..",
        "1..1e-99", "0.1..0.05,1", "nan",     "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        list_is_refused(wrong[i]);
}

static void method_is(const char *text, scene_scheme scheme, double mass, double force, int order)
{
    pace_method m;
    fault f = {""};
    gsl_test(pace_method_read(text, (int)strlen(text), &m, &f) != STATUS_OK, "%s is read: %s", text,
             f.text);
    gsl_test(m.scheme != scheme || strcmp(m.name, text) != 0, "%s is that", text);
    gsl_test_int(m.order, order, "%s: order", text);
    gsl_test_abs(m.alpha.mass, mass, 1e-15, "%s: alpha_m", text);
    gsl_test_abs(m.alpha.force, force, 1e-15, "%s: alpha_f", text);
}

static void methods(void)
{
    method_is("alpha", SCENE_ALPHA, 0.8 / 1.9, 0.9 / 1.9, 2);
    method_is("alpha:rho=0.5", SCENE_ALPHA, 0, 1 / 3.0, 2);
    method_is("hht", SCENE_ALPHA, 0, 0.05, 2);
    method_is("hht:alpha=0.3", SCENE_ALPHA, 0, 0.3, 2);
    method_is("trapezoidal", SCENE_ALPHA, 0, 0, 2);
    method_is("conserving", SCENE_CONSERVING, 0, 0, 2);
    method_is("radau", SCENE_RADAU, 0, 0, 5);
    method_is("explicit", SCENE_EXPLICIT, 0, 0, 8);
    const char *const wrong[] = {"",        "alph",        "alphas",         "alpha:rho=1.5",
                                 "alpha:r", "hht:alpha=1", "radau:rho=0.5",  "trapezoidal:rho=1",
                                 "Alpha",   "alpha:rho=",  "alpha:rho=0.5x", "hht:rho=0.5"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        pace_method m;
        fault f = {""};
        gsl_test(pace_method_read(wrong[i], (int)strlen(wrong[i]), &m, &f) != STATUS_REFUSED,
                 "'%s' is refused", wrong[i]);
        gsl_test(strstr(f.text, wrong[i]) == NULL, "'%s' is named", wrong[i]);
    }
}

static void method_lists(void)
{
    pace_method list[PACE_LIST_MOST];
    int count = 0;
    fault f = {""};
    gsl_test(pace_method_read_list(pace_method_all, PACE_LIST_MOST, list, &count, &f) != STATUS_OK,
             "all: %s", f.text);
    gsl_test_int(count, 6, "all");
    count = 0;
    gsl_test(pace_method_read_list("radau,alpha,radau", PACE_LIST_MOST, list, &count, &f) !=
                 STATUS_REFUSED,
             "given twice");
    count = 0;
    gsl_test(pace_method_read_list("radau,alpha", 1, list, &count, &f) != STATUS_REFUSED,
             "too many");
}

int main(void)
{
    lists();
    methods();
    method_lists();
    return gsl_test_summary();
}
