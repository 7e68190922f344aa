/* Orders and what an error costs, of runs whose errors are made up. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/pace/pace_order.h"
#include "harness/pace/pace_reach.h"

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

int main(void)
{
    verdicts();
    order_of_each();
    cost_of_a_level();
    return gsl_test_summary();
}
