/* Points of a sweep: grids, and sequences that fill a box. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"

static const parameter_type table[] = {
    {"a", "m", 1, -100, 100, NULL, ""},
    {"b", "m", 1, -100, 100, NULL, ""},
    {"c", "m", 1, -100, 100, NULL, ""},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};
static const case_type box = {.name = "box", .parameters = {table}};

static void unit_axes(sweep_axis out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (sweep_axis){.of = &table[i], .index = i, .kind = AXIS_LINEAR, .from = 0, .to = 1};
}

static void grid(void)
{
    static const double right[] = {0, 1, 0, 2, 0, 3, 5, 1, 5, 2, 5, 3};
    sweep_axis a[2];
    design d;
    double at[12];
    axis_read(&box, "a=0..5/1", &a[0], NULL);
    axis_read(&box, "b=1,2,3", &a[1], NULL);
    gsl_test(design_make(DESIGN_GRID, 2, a, 0, 0, &d, NULL) != STATUS_OK, "a grid");
    gsl_test_int((int)d.points, 6, "points of a grid");
    design_points(&d, 0, 6, at, NULL);
    gsl_test(memcmp(at, right, sizeof right) != 0, "order of a grid");
    design_points(&d, 4, 1, at, NULL);
    gsl_test(memcmp(at, right + 8, 2 * sizeof *at) != 0, "any point of a grid");
    design_free(&d);
    axis_free(&a[1]);
}

static void sobol(void)
{
    static const double right[] = {0.5, 0.5, 0.75, 0.25, 0.25, 0.75, 0.375, 0.375, 0.875, 0.875};
    sweep_axis a[3];
    design d;
    double at[10];
    unit_axes(a);
    gsl_test(design_make(DESIGN_SOBOL, 2, a, 5, 0, &d, NULL) != STATUS_OK, "Sobol");
    design_points(&d, 0, 5, at, NULL);
    gsl_test(memcmp(at, right, sizeof right) != 0, "the first points of Sobol");
    design_free(&d);
}

/* Returns the digits of n in a base, mirrored at the radix point, as a number in [0, 1). */
static double mirrored(int n, int base)
{
    double out = 0, digit = 1.0 / base;
    for (; n > 0; n /= base, digit /= base)
        out += n % base * digit;
    return out;
}

static void halton(void)
{
    static const int base[] = {2, 3, 5};
    sweep_axis a[3];
    design d;
    double at[3 * 200];
    unit_axes(a);
    gsl_test(design_make(DESIGN_HALTON, 3, a, 200, 0, &d, NULL) != STATUS_OK, "Halton");
    design_points(&d, 0, 200, at, NULL);
    double worst = 0;
    for (int i = 0; i < 600; i++)
        worst = fmax(worst, fabs(at[i] - mirrored(i / 3 + 1, base[i % 3])));
    gsl_test(!(worst < 1e-15), "200 points of Halton: %g", worst);
    design_free(&d);
}

static void anywhere(design_kind kind)
{
    enum { POINTS = 2 * DESIGN_STRIDE + 100 };
    sweep_axis a[3];
    design d;
    double *all = malloc(3 * POINTS * sizeof *all), some[3 * 40];
    unit_axes(a);
    gsl_test(all == NULL || design_make(kind, 3, a, POINTS, 7, &d, NULL) != STATUS_OK, "%s",
             design_name(kind));
    design_points(&d, 0, POINTS, all, NULL);
    static const long from[] = {0, 1, DESIGN_STRIDE - 20, DESIGN_STRIDE, 2 * DESIGN_STRIDE + 60};
    for (size_t i = 0; i < sizeof from / sizeof from[0]; i++) {
        design_points(&d, from[i], 40, some, NULL);
        gsl_test(memcmp(some, all + 3 * from[i], sizeof some) != 0, "%s: 40 points from %ld",
                 design_name(kind), from[i]);
    }
    for (int i = 0; i < 3 * POINTS; i++)
        if (!(all[i] >= 0 && all[i] < 1))
            gsl_test(1, "%s: outside the box", design_name(kind));
    design_free(&d);
    free(all);
}

static void seeds(void)
{
    sweep_axis a[3];
    double at[3][3];
    unit_axes(a);
    for (int i = 0; i < 3; i++) {
        design d;
        design_make(DESIGN_RANDOM, 3, a, 1, i < 2 ? 1 : 2, &d, NULL);
        design_points(&d, 0, 1, at[i], NULL);
        design_free(&d);
    }
    gsl_test(memcmp(at[0], at[1], sizeof at[0]) != 0, "one seed, one sequence");
    gsl_test(memcmp(at[0], at[2], sizeof at[0]) == 0, "two seeds, two sequences");
}

static void is_refused(design_kind kind, const sweep_axis *a, long points, const char *word)
{
    design d;
    fault f = {""};
    gsl_test(design_make(kind, 1, a, points, 0, &d, &f) != STATUS_REFUSED, "refused: %s", word);
    gsl_test(strstr(f.text, word) == NULL, "says '%s': %s", word, f.text);
}

static void design_tests(void)
{
    sweep_axis open[3], parted;
    grid();
    sobol();
    halton();
    anywhere(DESIGN_SOBOL);
    anywhere(DESIGN_HALTON);
    anywhere(DESIGN_RANDOM);
    seeds();
    unit_axes(open);
    axis_read(&box, "a=0..1/4", &parted, NULL);
    is_refused(DESIGN_GRID, open, 0, "the number of parts is missing");
    is_refused(DESIGN_SOBOL, open, 0, "--points");
    is_refused(DESIGN_SOBOL, &parted, 10,
               "'/4' applies only to a grid, and --design gives another kind of points; remove it");
}

enum { RUNS = 5 };

static void fill(integrators *p, integrators_group *g, integrators_run run[RUNS],
                 const char *method, int nominal, const double error[RUNS])
{
    memset(p, 0, sizeof *p);
    *g = (integrators_group){.reference = 0, .uncertainty = 1e-12};
    memset(run, 0, RUNS * sizeof *run);
    for (int i = 0; i < RUNS; i++) {
        run[i].step = 0.1 / (1 << i);
        run[i].error = error[i];
        run[i].cost = 1 << i;
        run[i].method.order = nominal;
        strcpy(run[i].method.name, method);
    }
    *p = (integrators){.groups = 1, .runs = RUNS, .group = g, .run = run};
}

static void verdict_is(const char *what, int nominal, const double error[RUNS],
                       integrators_order_kind right)
{
    integrators p;
    integrators_group g;
    integrators_run run[RUNS];
    fill(&p, &g, run, "one", nominal, error);
    const integrators_ladder l = integrators_order_of(&p, 0);
    gsl_test_int(l.count, RUNS, "%s: steps", what);
    gsl_test(l.kind != right, "%s: %s, orders %g %g", what, integrators_order_name(l.kind),
             l.before, l.order);
}

static void verdicts(void)
{
    verdict_is("order 2", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625},
               INTEGRATORS_ORDER_PASS);
    verdict_is("order 1", 2, (double[]){1, 0.5, 0.25, 0.125, 0.0625}, INTEGRATORS_ORDER_LOW);
    verdict_is("order 1, then 2", 2, (double[]){1, 0.5, 0.25, 0.125, 0.03125},
               INTEGRATORS_ORDER_UNDECIDED);
    verdict_is("order 5 down to rounding", 5, (double[]){3e-5, 1e-6, 3.2e-8, 1e-9, 4e-12},
               INTEGRATORS_ORDER_PASS);
    verdict_is("a run without an error", 2, (double[]){1, 0.25, NAN, 0.015625, 0.00390625},
               INTEGRATORS_ORDER_UNDECIDED);
    verdict_is("all below the floor", 2, (double[]){1e-13, 1e-13, 1e-13, 1e-13, 1e-13},
               INTEGRATORS_ORDER_UNDECIDED);
}

static void order_of_each(void)
{
    integrators p;
    integrators_group g;
    integrators_run run[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.125, 0.015625, 0.00390625});
    strcpy(run[3].method.name, "another");
    integrators_order_fill(&p);
    gsl_test(!isnan(run[0].order) || !isnan(run[3].order), "the first of an integrator has none");
    gsl_test_rel(run[1].order, 2, 1e-14, "against the run before");
    gsl_test_rel(run[2].order, 1, 1e-14, "against the run before");
}

static void cost_of_a_level(void)
{
    integrators p;
    integrators_group g;
    integrators_run run[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625});
    integrators_reach r = integrators_reach_of(&p, 0, "one", 0.03125);
    gsl_test(r.run != &run[3], "the first run within it");
    gsl_test_rel(r.cost, 4 * sqrt(2), 1e-14, "between two runs");
    r = integrators_reach_of(&p, 0, "one", 2);
    gsl_test(r.run != &run[0] || r.cost != 1, "the longest step is within it");
    r = integrators_reach_of(&p, 0, "one", 1e-3);
    gsl_test(r.run != NULL, "none is within it");
    run[4].error = 0.02;
    r = integrators_reach_of(&p, 0, "one", 0.016);
    gsl_test(r.run != NULL, "a shorter step is not within it");
}

static int stands(const double error[RUNS], double floor)
{
    integrators p;
    integrators_group g;
    integrators_run run[RUNS];
    double value[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625});
    g.uncertainty = floor / 10;
    for (int i = 0; i < RUNS; i++) {
        value[i] = error[i];
        run[i].values = &value[i];
    }
    const integrators_ladder l = integrators_order_of(&p, 0);
    return integrators_order_stagnates(&p, &l, 0);
}

static void what_does_not_converge(void)
{
    gsl_test_int(stands((double[]){0.5, 0.7, 0.4, 0.6, 0.45}, 1e-9), 1, "errors that stay");
    gsl_test_int(stands((double[]){0.5, 0.12, 0.03, 7e-3, 2e-3}, 1e-9), 0, "errors that fall");
    gsl_test_int(stands((double[]){9e-4, 9e-4, 9e-4, 9e-4, 9e-4}, 1e-9), 0,
                 "errors that are small");
    gsl_test_int(stands((double[]){0.5, 0.5, 0.5, 0.5, 0.5}, 0.6), 0, "errors of the reference");
    gsl_test_int(stands((double[]){0.5, 0.5, 0.5, 0.5, NAN}, 1e-9), 0, "a run without an error");
    gsl_test_int(integrators_order_is_stopped(&(integrators_group){.order = 1.8}), 1,
                 "order 1.8 of five");
    gsl_test_int(integrators_order_is_stopped(&(integrators_group){.order = 4.7}), 0,
                 "order 4.7 of five");
    gsl_test_int(integrators_order_is_stopped(&(integrators_group){.order = NAN}), 0,
                 "no order is known");
}

static void order_tests(void)
{
    verdicts();
    order_of_each();
    cost_of_a_level();
    what_does_not_converge();
}

int main(void)
{
    design_tests();
    order_tests();
    return gsl_test_summary();
}
