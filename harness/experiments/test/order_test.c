/* Orders and what an error costs, of runs whose errors are made up. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"

enum { RUNS = 5 };

/* Steps 0.1, 0.05, ... of one integrator. */
static void fill(pace *p, pace_group *g, pace_run run[RUNS], const char *method, int nominal,
                 const double error[RUNS])
{
    memset(p, 0, sizeof *p);
    *g = (pace_group){.reference = 0, .uncertainty = 1e-12};
    memset(run, 0, RUNS * sizeof *run);
    for (int i = 0; i < RUNS; i++) {
        run[i].step = 0.1 / (1 << i);
        run[i].error = error[i];
        run[i].cost = 1 << i;
        run[i].method.order = nominal;
        strcpy(run[i].method.name, method);
    }
    *p = (pace){.groups = 1, .runs = RUNS, .group = g, .run = run};
}

static void verdict_is(const char *what, int nominal, const double error[RUNS],
                       pace_order_kind right)
{
    pace p;
    pace_group g;
    pace_run run[RUNS];
    fill(&p, &g, run, "one", nominal, error);
    const pace_ladder l = pace_order_of(&p, 0);
    gsl_test_int(l.count, RUNS, "%s: steps", what);
    gsl_test(l.kind != right, "%s: %s, orders %g %g", what, pace_order_name(l.kind), l.before,
             l.order);
}

static void verdicts(void)
{
    verdict_is("order 2", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625}, PACE_ORDER_PASS);
    verdict_is("order 1", 2, (double[]){1, 0.5, 0.25, 0.125, 0.0625}, PACE_ORDER_LOW);
    verdict_is("order 1, then 2", 2, (double[]){1, 0.5, 0.25, 0.125, 0.03125},
               PACE_ORDER_UNDECIDED);
    verdict_is("order 5 down to rounding", 5, (double[]){3e-5, 1e-6, 3.2e-8, 1e-9, 4e-12},
               PACE_ORDER_PASS);
    verdict_is("a run without an error", 2, (double[]){1, 0.25, NAN, 0.015625, 0.00390625},
               PACE_ORDER_UNDECIDED);
    verdict_is("all below the floor", 2, (double[]){1e-13, 1e-13, 1e-13, 1e-13, 1e-13},
               PACE_ORDER_UNDECIDED);
}

static void order_of_each(void)
{
    pace p;
    pace_group g;
    pace_run run[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.125, 0.015625, 0.00390625});
    strcpy(run[3].method.name, "another");
    pace_order_fill(&p);
    gsl_test(!isnan(run[0].order) || !isnan(run[3].order), "the first of an integrator has none");
    gsl_test_rel(run[1].order, 2, 1e-14, "against the run before");
    gsl_test_rel(run[2].order, 1, 1e-14, "against the run before");
}

/* Errors and costs are powers of the step: a level between two runs costs what that power says. */
static void cost_of_a_level(void)
{
    pace p;
    pace_group g;
    pace_run run[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625});
    pace_reach r = pace_reach_of(&p, 0, "one", 0.03125);
    gsl_test(r.run != &run[3], "the first run within it");
    gsl_test_rel(r.cost, 4 * sqrt(2), 1e-14, "between two runs");
    r = pace_reach_of(&p, 0, "one", 2);
    gsl_test(r.run != &run[0] || r.cost != 1, "the longest step is within it");
    r = pace_reach_of(&p, 0, "one", 1e-3);
    gsl_test(r.run != NULL, "none is within it");
    run[4].error = 0.02;
    r = pace_reach_of(&p, 0, "one", 0.016);
    gsl_test(r.run != NULL, "a shorter step is not within it");
}

/* Errors of a quantity, beside those of places. */
static int stands(const double error[RUNS], double floor)
{
    pace p;
    pace_group g;
    pace_run run[RUNS];
    double value[RUNS];
    fill(&p, &g, run, "one", 2, (double[]){1, 0.25, 0.0625, 0.015625, 0.00390625});
    g.uncertainty = floor / 10;
    for (int i = 0; i < RUNS; i++) {
        value[i] = error[i];
        run[i].values = &value[i];
    }
    const pace_ladder l = pace_order_of(&p, 0);
    return pace_order_stands(&p, &l, 0);
}

static void what_does_not_converge(void)
{
    gsl_test_int(stands((double[]){0.5, 0.7, 0.4, 0.6, 0.45}, 1e-9), 1, "errors that stay");
    gsl_test_int(stands((double[]){0.5, 0.12, 0.03, 7e-3, 2e-3}, 1e-9), 0, "errors that fall");
    gsl_test_int(stands((double[]){9e-4, 9e-4, 9e-4, 9e-4, 9e-4}, 1e-9), 0,
                 "errors that are small");
    gsl_test_int(stands((double[]){0.5, 0.5, 0.5, 0.5, 0.5}, 0.6), 0, "errors of the reference");
    gsl_test_int(stands((double[]){0.5, 0.5, 0.5, 0.5, NAN}, 1e-9), 0, "a run without an error");
    gsl_test_int(pace_order_is_stopped(&(pace_group){.order = 1.8}), 1, "order 1.8 of five");
    gsl_test_int(pace_order_is_stopped(&(pace_group){.order = 4.7}), 0, "order 4.7 of five");
    gsl_test_int(pace_order_is_stopped(&(pace_group){.order = NAN}), 0, "no order is known");
}

int main(void)
{
    verdicts();
    order_of_each();
    cost_of_a_level();
    what_does_not_converge();
    return gsl_test_summary();
}
