/* What --vary says: values, limits, refusals. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments.h"

static const parameter_type axis_table[] = {
    {"width", "m", 0.05, 1e-3, 10, NULL, "of a strip"},
    {"turn", "rad", 0, -1, 1, NULL, "of an end"},
    {"shear", "1", 1, 0, 1, NULL, "0 or 1"},
    {"ends", "", 0, 0, 0, "fixed|free|sliding", "how they are held"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};
static const case_type strip = {.name = "strip", .parameters = {axis_table}};

static sweep_axis read_good(const char *text)
{
    sweep_axis a;
    fault f = {""};
    gsl_test(axis_read(&strip, text, &a, &f) != STATUS_OK, "%s is read: %s", text, f.text);
    return a;
}

static void values_are(const char *text, axis_kind kind, int count, const double right[])
{
    sweep_axis a = read_good(text);
    gsl_test(a.kind != kind, "%s: kind %s", text, axis_kind_name(a.kind));
    gsl_test_int(a.count, count, "%s: values", text);
    for (int i = 0; i < a.count && i < count; i++)
        gsl_test_rel(axis_value(&a, i), right[i], 4e-16, "%s: value %d", text, i);
    axis_free(&a);
}

/* The ends are the numbers that stand there, not sums. */
static void ends_are_exact(void)
{
    sweep_axis a = read_good("width=0.2..0.9/7"), b = read_good("width=0.2..0.9/7:log");
    gsl_test(axis_value(&a, 0) != 0.2 || axis_value(&a, 7) != 0.9, "equal parts");
    gsl_test(axis_value(&b, 0) != 0.2 || axis_value(&b, 7) != 0.9, "equal ratios");
    axis_free(&a);
    axis_free(&b);
}

/* Where a share of the way is: ends, middles, the share that falls on each word. */
static void shares(void)
{
    sweep_axis a = read_good("turn=-1..1"), b = read_good("width=0.01..1:log"),
               c = read_good("ends=free,fixed");
    gsl_test_int(a.count, 0, "a range without parts has no values");
    gsl_test_rel(axis_at(&a, 0.25), -0.5, 1e-15, "a quarter of the way");
    gsl_test_rel(axis_at(&b, 0.5), 0.1, 1e-15, "half of the ratio");
    gsl_test_int((int)axis_at(&c, 0.49), 1, "the first word");
    gsl_test_int((int)axis_at(&c, 0.5), 0, "the second word");
    gsl_test_int((int)axis_at(&c, 0.999999), 0, "the second word to the end");
    axis_free(&c);
}

static void is_refused(const char *text, const char *word)
{
    sweep_axis a;
    fault f = {""};
    gsl_test(axis_read(&strip, text, &a, &f) != STATUS_REFUSED, "%s is refused", text);
    gsl_test(strstr(f.text, word) == NULL, "%s: says '%s': %s", text, word, f.text);
}

int main(void)
{
    values_are("width=0.1..0.5/4", AXIS_LINEAR, 5, (const double[]){0.1, 0.2, 0.3, 0.4, 0.5});
    values_are("turn=1..-1/2", AXIS_LINEAR, 3, (const double[]){1, 0, -1});
    values_are("width=0.001..10/4:log", AXIS_LOG, 5, (const double[]){0.001, 0.01, 0.1, 1, 10});
    values_are("turn=-1..-0.01/2:log", AXIS_LOG, 3, (const double[]){-1, -0.1, -0.01});
    values_are("width=0.3,0.1", AXIS_LIST, 2, (const double[]){0.3, 0.1});
    values_are("shear=0..1/1", AXIS_LINEAR, 2, (const double[]){0, 1});
    values_are("ends=sliding,fixed", AXIS_WORDS, 2, (const double[]){2, 0});
    ends_are_exact();
    shares();
    is_refused("widht=1..2/3", "did you mean 'width'");
    is_refused("width", "NAME=A..B/N");
    is_refused("width=", "NAME=A..B/N");
    is_refused("width=1..20/3", "outside its range");
    is_refused("width=1..11/3", "outside its range");
    is_refused("width=1,20", "outside its range");
    is_refused("width=1mm..2/3", "SI without units");
    is_refused("width=1..2/2.5", "whole number");
    is_refused("width=1..2/0", "whole number");
    is_refused("width=1..1/2", "one value");
    is_refused("turn=-1..1/2:log", "one sign");
    is_refused("width=1..2/2:ln", "equal ratios");
    is_refused("width=1,1", "twice");
    is_refused("width=1,,2", "missing");
    is_refused("shear=0..1/2", "give 0 or 1");
    is_refused("shear=0..1", "give 0 or 1");
    is_refused("ends=fixed..free/1", "fixed|free|sliding");
    is_refused("ends=fixd", "unknown choice");
    return gsl_test_summary();
}
