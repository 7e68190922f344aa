/* What a benchmark says of times: decided only where the noise allows it; work is counted the same
 * every time. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/tools/kit/cells.h"

enum { PAIRS = 101, TRIALS = 300 };

/* A lap of 1.7 ms with the noise of a shared machine: mostly small, at times long, and drifting. */
static double noisy(const gsl_rng *random, double drift)
{
    const double tail =
        gsl_ran_exponential(random, 1) * (gsl_rng_uniform(random) < 0.1 ? 0.5 : 0.01);
    return 1.7e-3 * (1 + drift + tail + fabs(gsl_ran_gaussian(random, 0.03)));
}

static void count_outcomes(double slowdown, int outcomes[3])
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    memset(outcomes, 0, 3 * sizeof *outcomes);
    for (int trial = 0; trial < TRIALS; trial++) {
        double a[PAIRS], b[PAIRS];
        for (int i = 0; i < PAIRS; i++) {
            const double drift = 0.4 * (1 + sin(0.07 * i + trial));
            a[i] = noisy(random, drift);
            b[i] = (1 + slowdown) * noisy(random, drift);
        }
        outcomes[against_judge(PAIRS, a, b).outcome]++;
    }
    gsl_rng_free(random);
}

static void test_against(void)
{
    int outcomes[3];
    count_outcomes(0, outcomes);
    gsl_test_int(outcomes[AGAINST_UNDECIDED], TRIALS, "noise alone is undecided");
    count_outcomes(0.2, outcomes);
    gsl_test_int(outcomes[AGAINST_SLOWER], TRIALS, "a slow-down of 20 %% is found");
    count_outcomes(-1.0 / 6, outcomes);
    gsl_test_int(outcomes[AGAINST_FASTER], TRIALS, "and seen from the other side");
    const double few[10] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
                 twice[10] = {2, 2, 2, 2, 2, 2, 2, 2, 2, 2};
    gsl_test_int(against_judge(10, few, twice).outcome, AGAINST_UNDECIDED,
                 "ten pairs cannot give 99.9 %% confidence");
    gsl_test_int(against_judge(0, few, twice).outcome, AGAINST_UNDECIDED,
                 "no pair decides nothing");
}

/* The median of 101 draws: P(Binomial(101, 1/2) < 34) = 3.2e-4 and P(< 35) = 6.7e-4 enclose the
 * tail of 5e-4. */
static void test_interval(void)
{
    double a[PAIRS], b[PAIRS];
    for (int i = 0; i < PAIRS; i++) {
        a[i] = 1;
        b[i] = 2 + i;
    }
    const contest_clock v = against_judge(PAIRS, a, b);
    gsl_test_abs(v.ratio, 52, 1e-12, "median of the ratios");
    gsl_test_abs(v.low, 2 + 33, 1e-12, "34th smallest is the lower end (binomial tail)");
    gsl_test_abs(v.high, 2 + 67, 1e-12, "34th largest is the upper end");
}

static rounds_reading reading(double first, double step)
{
    rounds_reading c = {.rounds = ROUNDS_COUNT};
    for (int i = 0; i < ROUNDS_COUNT; i++)
        c.round[i] = first + step * ((3 * i) % ROUNDS_COUNT);
    return c;
}

static void test_compare(void)
{
    const rounds_reading a = reading(1, 0.1), b = reading(1.41, 0.1), c = reading(1.39, 0.1);
    const rounds_reading never = {0};
    gsl_test_abs(rounds_least(&a), 1, 1e-15, "least of the rounds");
    gsl_test_abs(rounds_most(&a), 1.4, 1e-15, "slowest of the rounds");
    gsl_test_int(rounds_compare(&a, &b), -1, "all rounds faster");
    gsl_test_int(rounds_compare(&b, &a), 1, "all rounds slower");
    gsl_test_int(rounds_compare(&a, &c), 0, "rounds overlap: undecided");
    gsl_test(isfinite(rounds_least(&never)), "a cell that never ran has no time");
    gsl_test(isfinite(rounds_most(&never)), "and no slowest one");
    gsl_test_int(rounds_compare(&never, &a), 1, "it is no faster than one that ran");
    gsl_test_int(rounds_compare(&never, &never), 0, "nor than another that did not");
    const rounds_reading even = reading(1, 0);
    gsl_test_int(rounds_compare(&even, &even), 0, "times that are equal do not differ");
}

/* Errors 20 %, 0.5 %, 3 %, 0.2 %, 0.05 %: what counts is the coarsest mesh from which on all are
 * within. */
static void test_reach(void)
{
    const double error[5] = {0.2, -0.005, 0.03, 0.002, -0.0005};
    scene_quantity quantity = {.tolerance = 1e-3};
    sweep_point p = {.scene = {.quantities = 1, .quantity = &quantity}};
    quantity_result value[5];
    cell_result cell[5] = {{.size.free = 0}};
    cell_timing timing[5];
    series one = {.meshes = 5, .mesh = {1, 2, 4, 8, 16}, .cell = cell};
    sweep s = {.points = 1, .seriess = 1, .point = &p, .series = &one};
    truth row = {.value = 5};
    verdict v = {.truth = &row};
    for (int i = 0; i < 5; i++) {
        value[i] = (quantity_result){.value = 5 * (1 + error[i])};
        cell[i].solve.quantities = 1;
        cell[i].solve.quantity = &value[i];
        timing[i] = (cell_timing){.as_is = reading(i == 3 ? 1 : 2, 0.01)};
    }
    gsl_test_int(reach_mesh(&s, &v, 0.1), 1, "within 10 %% from the second mesh on");
    gsl_test_int(reach_mesh(&s, &v, 0.01), 3, "an accidental hit of a coarse mesh does not count");
    gsl_test_int(reach_mesh(&s, &v, 0.001), 4, "within 0.1 %% on the finest only");
    gsl_test_int(reach_mesh(&s, &v, 0.0001), -1, "never within 0.01 %%");
    one.timing = timing;
    gsl_test_int(reach_mesh(&s, &v, 0.1), 1, "a finer mesh that is faster is no less a mesh");
    value[4].value = NAN;
    gsl_test_int(reach_mesh(&s, &v, 0.1), -1, "a finest mesh without a value reaches nothing");
}

static void test_counts(void)
{
    cell_request request = cells_of(case_find("sheet_cantilever", NULL), "sheet_third", 3);
    fault f = {""};
    counters first = {0};
    for (int i = 0; i < 2; i++) {
        cell_result cell;
        gsl_test(cell_run(&request, &cell, &f) != STATUS_OK, "run %d %s", i, f.text);
        if (i == 0)
            first = cell.counters;
        else
            gsl_test(memcmp(&first, &cell.counters, sizeof first) != 0,
                     "the same work is counted again");
        cell_result_free(&cell);
    }
    request.solve.steps_between = 20; /* planted work */
    cell_result more;
    gsl_test(cell_run(&request, &more, &f) != STATUS_OK, "run with more steps %s", f.text);
    gsl_test(more.counters.strain_evaluations <= first.strain_evaluations,
             "more steps are seen in the counts");
    cell_result_free(&more);
}

static void test_rounds(void)
{
    const cell_request request = cells_of(case_find("c_column", NULL), "beamw", 2);
    rounds_reading c = {0};
    for (int i = 0; i < ROUNDS_COUNT + 2; i++)
        rounds_run(&request, 0, &c);
    gsl_test_int(c.rounds, ROUNDS_COUNT, "rounds end");
    gsl_test_int(c.repeats, ROUNDS_COUNT, "at least one repetition in each");
    gsl_test(!(c.setup > 0 && c.solve > 0), "set-up and solution both take time");
    gsl_test_rel(c.setup + c.solve, rounds_least(&c), 1e-12,
                 "both belong to the fastest repetition");
}

int main(void)
{
    test_against();
    test_interval();
    test_compare();
    test_reach();
    test_counts();
    test_rounds();
    return gsl_test_summary();
}
