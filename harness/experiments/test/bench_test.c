/* A comparison of times must give a result only if the scatter allows it. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/tools/kit/cells.h"

enum { PAIRS = 101, TRIALS = 300 };

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
        outcomes[against_evaluate(PAIRS, a, b).outcome]++;
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
    gsl_test_int(against_evaluate(10, few, twice).outcome, AGAINST_UNDECIDED,
                 "ten pairs cannot give 99.9 %% confidence");
    gsl_test_int(against_evaluate(0, few, twice).outcome, AGAINST_UNDECIDED,
                 "no pair decides nothing");
}

/* The ends of the 99.9 % interval for 101 ratios must be the 34th smallest and the 34th largest
 * ratio, because 5e-4 is between P(Binomial(101, 1/2) < 34) = 3.2e-4 and P(Binomial(101, 1/2) < 35)
 * = 6.7e-4. */
static void test_interval(void)
{
    double a[PAIRS], b[PAIRS];
    for (int i = 0; i < PAIRS; i++) {
        a[i] = 1;
        b[i] = 2 + i;
    }
    const against_times v = against_evaluate(PAIRS, a, b);
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

/* The meshes have the errors 20 %, 0.5 %, 3 %, 0.2 % and 0.05 %. A level is reached by the coarsest
 * mesh that is within the level together with all finer meshes. */
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
    request.solve.steps_between = 20;
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

static void bench_tests(void)
{
    test_against();
    test_interval();
    test_compare();
    test_reach();
    test_counts();
    test_rounds();
}

static int order_of(const cell_request *request)
{
    scene s;
    model *m = NULL;
    fault f = {""};
    int order = -1;
    scene_init(&s, request->type->name);
    const model_request wanted = {.scene = &s,
                                  .type = request->formulation,
                                  .options = request->option,
                                  .elements = request->elements};
    if (case_build(request->type, request->parameter, &s, &f) == STATUS_OK &&
        model_alloc(&wanted, &m, &f) == STATUS_OK)
        order = uncondensed_size(m);
    gsl_test(order < 0, "%s: %s", request->type->name, f.text);
    model_free(m);
    scene_free(&s);
    return order;
}

static dense_reference measure(const cell_request *request)
{
    dense_reference dense = {0};
    cell_result cell;
    fault f = {""};
    cell_run(request, &cell, &f);
    dense_reference_round(request, &cell, 0, &dense);
    cell_result_free(&cell);
    return dense;
}

static void unknowns(void)
{
    static const char *const name[] = {"sheet_cantilever", "elastica", "bend_45"};
    static const char *const key[] = {"sheet_third", "beamw_consistent", "collocation",
                                      "geometrically_exact:nodes=3"};
    int measured = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 4; k++)
            for (int n = 1; n <= 4; n++) {
                const cell_request request = cells_of(case_find(name[c], NULL), key[k], n);
                const dense_reference dense = measure(&request);
                if (dense.unknowns == 0)
                    continue;
                measured++;
                gsl_test_int(dense.unknowns, order_of(&request), "%s, %s, n = %d: unknowns",
                             name[c], key[k], n);
                gsl_test(!(dense.iteration > 0), "%s, %s, n = %d: an iteration takes time", name[c],
                         key[k], n);
            }
    gsl_test(measured < 24, "%d cells were measured", measured);
}

static void not_measured(void)
{
    const cell_request linear = cells_of(case_find("warping_torsion", NULL), "beamw_consistent", 4),
                       continued = cells_of(case_find("snap_through", NULL), "collocation", 2),
                       large = cells_of(case_find("elastica", NULL), "geometrically_exact", 600);
    gsl_test_int(measure(&linear).unknowns, 0, "a linear problem");
    gsl_test_int(measure(&continued).unknowns, 0, "a path that the algorithm cannot follow");
    gsl_test_int(measure(&large).unknowns, 0, "a matrix beyond 3000 unknowns");
}

static void seconds(void)
{
    dense_reference b = {.unknowns = 10, .iteration = 0.3};
    gsl_test_rel(dense_reference_seconds(&b, 7), 2.1, 1e-15, "one iteration for all");
    b.whole = (rounds_reading){.rounds = 2, .round = {1.7, 1.6}};
    gsl_test_rel(dense_reference_seconds(&b, 7), 1.6, 1e-15, "whole runs, where they were made");
    b = (dense_reference){0};
    gsl_test(!isinf(dense_reference_seconds(&b, 7)), "what was not measured has no time");
}

static void dense_tests(void)
{
    unknowns();
    not_measured();
    seconds();
}

static char all[] = "*", word[32];

static extreme_count evaluated(outcome_kind kind, const char *expected, int whole, int *unexpected,
                               int *code)
{
    extreme_outcome o = {.kind = kind, .x = 1, .neighbours = -1};
    extreme_deviation row = {
        .extreme = all, .formulation = all, .quantity = all, .outcome = word, .from = 1, .to = 1};
    formulation chosen = {.key = "element"};
    extreme_count count = {0};
    extreme_sweep s = {.formulations = 1,
                       .outcomes = 1,
                       .deviations = expected != NULL,
                       .formulation = &chosen,
                       .outcome = &o,
                       .deviation = &row,
                       .count = &count};
    snprintf(word, sizeof word, "%s", expected != NULL ? expected : "");
    extreme_expect(&s, whole);
    *unexpected = s.unexpected;
    *code = extreme_sweep_exit(&s);
    return count;
}

static void kinds(void)
{
    for (int k = 0; k < OUTCOME_KINDS; k++) {
        int unexpected, code;
        const outcome_kind kind = (outcome_kind)k;
        const int good = kind == OUTCOME_VALUE || kind == OUTCOME_COARSE,
                  skip = kind == OUTCOME_SKIP;
        const extreme_count c = evaluated(kind, NULL, 1, &unexpected, &code);
        gsl_test_int(unexpected, !good && !skip, "%s: without a finding", outcome_name(kind));
        const int failed = good ? 0 : 1;
        gsl_test_int(code, skip ? 3 : failed, "%s: its exit code", outcome_name(kind));
        gsl_test_int(c.tried, !skip, "%s: tried", outcome_name(kind));
        gsl_test_int(c.survived, good, "%s: survived", outcome_name(kind));
        gsl_test_int(c.coarse, kind == OUTCOME_COARSE, "%s: coarse", outcome_name(kind));
        gsl_test_int(c.wrong, kind == OUTCOME_WRONG, "%s: wrong", outcome_name(kind));
        gsl_test_int(c.faults, kind == OUTCOME_FAULT, "%s: a fault", outcome_name(kind));
        gsl_test_int(c.survived + c.named + c.wrong + c.faults, c.tried, "%s: each is one of them",
                     outcome_name(kind));
        evaluated(kind, outcome_name(kind), 1, &unexpected, &code);
        gsl_test_int(code, skip ? 3 : 0, "%s: as the finding says", outcome_name(kind));
        evaluated(kind, kind == OUTCOME_SINGULAR ? "wrong" : "singular", 1, &unexpected, &code);
        gsl_test_int(unexpected, !skip, "%s: not as the finding says", outcome_name(kind));
    }
}

typedef struct expectation {
    extreme_outcome o;
    extreme_deviation row;
    formulation chosen;
    extreme_count count;
    extreme_sweep s;
} expectation;

static void one_outcome(outcome_kind kind, double x, expectation *out)
{
    *out = (expectation){.o = {.kind = kind, .x = x, .neighbours = -1},
                         .row = {.extreme = all,
                                 .formulation = all,
                                 .quantity = all,
                                 .outcome = word,
                                 .from = 2,
                                 .to = 3},
                         .chosen = {.key = "element"}};
    out->s = (extreme_sweep){.formulations = 1,
                             .outcomes = 1,
                             .deviations = 1,
                             .formulation = &out->chosen,
                             .outcome = &out->o,
                             .deviation = &out->row,
                             .count = &out->count};
}

static void unobserved(void)
{
    for (int whole = 0; whole < 2; whole++) {
        expectation one;
        one_outcome(OUTCOME_VALUE, 1, &one);
        extreme_expect(&one.s, whole);
        gsl_test_int(one.s.unexpected, 0, "the outcome is as expected");
        gsl_test_int(one.s.unobserved, whole, "the finding is elsewhere");
        gsl_test_int(extreme_sweep_exit(&one.s), whole, "and is missed in a whole run");
    }
}

static void cells(void)
{
    for (int good = 0; good < OUTCOME_KINDS; good++)
        for (int swapped = 0; swapped < 2; swapped++)
            for (int one_cell = 0; one_cell < 2; one_cell++) {
                extreme_outcome o[2] = {{.kind = (outcome_kind)good, .x = 1, .neighbours = -1},
                                        {.kind = OUTCOME_FAULT, .x = 1, .neighbours = -1}};
                formulation chosen = {.key = "element"};
                extreme_count c = {0};
                extreme_sweep s = {.formulations = 1,
                                   .outcomes = 2,
                                   .formulation = &chosen,
                                   .outcome = o,
                                   .count = &c};
                if (swapped) {
                    o[1].kind = o[0].kind;
                    o[0].kind = OUTCOME_FAULT;
                }
                o[1].series = !one_cell;
                extreme_expect(&s, 0);
                const int skip = good == OUTCOME_SKIP, failed = good == OUTCOME_FAULT;
                gsl_test_int(c.tried, one_cell || skip ? 1 : 2, "%s and a fault: cells tried",
                             outcome_name((outcome_kind)good));
                gsl_test_int(c.faults, one_cell || !failed ? 1 : 2, "%s and a fault: faults",
                             outcome_name((outcome_kind)good));
                gsl_test_int(c.survived, !one_cell && outcome_is_good((outcome_kind)good),
                             "%s and a fault: survived", outcome_name((outcome_kind)good));
            }
}

static void ranges(void)
{
    static const struct {
        double x;
        int inside;
    } at[] = {{2, 1},
              {3, 1},
              {2.5, 1},
              {2 * (1 - 1e-12), 1},
              {3 * (1 + 1e-12), 1},
              {1.99, 0},
              {3.01, 0},
              {2 * (1 - 1e-6), 0},
              {3 * (1 + 1e-6), 0}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        expectation one;
        one_outcome(OUTCOME_SINGULAR, at[i].x, &one);
        snprintf(word, sizeof word, "singular");
        extreme_expect(&one.s, 0);
        gsl_test_int(one.s.unexpected, !at[i].inside, "a finding of 2 .. 3 at %.15g", at[i].x);
    }
}

static void expect_tests(void)
{
    cells();
    ranges();
    kinds();
    unobserved();
}

enum { MESHES = 1 + OUTCOME_NEIGHBOURS };
static const double exact = 7;

typedef struct neighbours_bench {
    extreme_sweep s;
    sweep_point p;
    series first, others;
    cell_result cell, other[OUTCOME_NEIGHBOURS];
    quantity_result value, other_value[OUTCOME_NEIGHBOURS];
    formulation chosen;
    element_type element;
    truths t;
    truth row;
    extreme_outcome o;
} neighbours_bench;

static char words[][16] = {"", "exact", "same", "m"};

static int exact_extreme(void)
{
    int i = 0;
    while (extremes[i].criterion != EXTREME_EXACT)
        i++;
    return i;
}

/* Makes an outcome with the relative error error[0] on a mesh of `own` elements. The neighbouring
 * meshes have the other errors. NAN: no value. */
static void make(int own, const int mesh[OUTCOME_NEIGHBOURS], const double error[MESHES],
                 neighbours_bench *b)
{
    static char name[SCENE_NAME];
    const int index = exact_extreme();
    memset(b, 0, sizeof *b);
    snprintf(name, sizeof name, "%s", extremes[index].quantity[0].name);
    b->p.type = case_find(extremes[index].base, NULL);
    scene_init(&b->p.scene, "made_up");
    scene_add_quantity(&b->p.scene, name, "m", 0, scene_coordinate(0, SCENE_UX));
    b->element = (element_type){.name = "element"};
    b->chosen = (formulation){.key = "element", .type = &b->element};
    b->value = (quantity_result){.value = exact * (1 + error[0])};
    b->cell.solve.quantities = 1;
    b->cell.solve.quantity = &b->value;
    b->first = (series){.formulation = b->chosen, .meshes = 1, .mesh = {own}, .cell = &b->cell};
    b->others = (series){.formulation = b->chosen, .meshes = OUTCOME_NEIGHBOURS, .cell = b->other};
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++) {
        b->others.mesh[i] = mesh[i];
        b->other_value[i] =
            (quantity_result){.value = exact * (1 + error[i + 1]),
                              .status = isnan(error[i + 1]) ? STATUS_SINGULAR : STATUS_OK};
        b->other[i].solve.quantities = 1;
        b->other[i].solve.quantity = &b->other_value[i];
    }
    b->row = (truth){.type = b->p.type,
                     .formulation = words[0],
                     .theory = words[0],
                     .quantity = name,
                     .unit = words[3],
                     .kind = words[1],
                     .model = words[2],
                     .value = exact};
    b->t = (truths){.rows = 1, .row = &b->row};
    b->s = (extreme_sweep){.formulations = 1, .formulation = &b->chosen};
    b->s.first = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->first};
    b->s.neighbours = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->others};
    b->o = (extreme_outcome){.extreme = index};
}

static void expect(int own, const int mesh[OUTCOME_NEIGHBOURS], const double error[MESHES],
                   outcome_kind kind, const char *what)
{
    neighbours_bench b;
    fault f = {""};
    make(own, mesh, error, &b);
    gsl_test(extreme_evaluate_first(&b.s, &b.t, &b.o, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(b.o.kind != OUTCOME_WRONG, "%s: its own value is off: %s", what,
             outcome_name(b.o.kind));
    gsl_test_rel(b.o.error, error[0], 1e-9, "%s: its error", what);
    extreme_evaluate_neighbours(&b.s, &b.t, &b.o);
    gsl_test(b.o.kind != kind, "%s: %s", what, outcome_name(b.o.kind));
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++)
        if (isnan(error[i + 1]))
            gsl_test(!isnan(b.o.neighbour_error[i]), "%s: mesh %d has none", what, mesh[i]);
        else
            gsl_test_rel(b.o.neighbour_error[i], error[i + 1], 1e-9, "%s: error on mesh %d", what,
                         mesh[i]);
    scene_free(&b.p.scene);
}

static void neighbours_tests(void)
{
    static const int finer[] = {8, 16}, coarser[] = {8, 16}, around[] = {8, 32};
    expect(4, finer, (double[]){0.16, 0.04, 0.01}, OUTCOME_COARSE, "second order, finer meshes");
    expect(4, finer, (double[]){-0.16, 0.04, -0.01}, OUTCOME_COARSE, "its sign may change");
    expect(4, finer, (double[]){0.16, 0.1, 0.079}, OUTCOME_COARSE, "half an order is enough");
    expect(4, finer, (double[]){0.16, 0.1, 0.081}, OUTCOME_WRONG, "less is not");
    expect(4, finer, (double[]){0.16, 0.01, 0.02}, OUTCOME_WRONG, "it rises at the end");
    expect(4, finer, (double[]){0.16, 0.3, 0.02}, OUTCOME_COARSE, "it rises and falls");
    expect(4, finer, (double[]){0.16, 0.16, 0.16}, OUTCOME_WRONG, "a limit of its own");
    expect(4, finer, (double[]){0.16, NAN, 0.01}, OUTCOME_COARSE, "without the middle mesh");
    expect(4, finer, (double[]){0.16, NAN, 0.09}, OUTCOME_WRONG, "without it: too slow");
    expect(4, finer, (double[]){0.16, 0.04, NAN}, OUTCOME_COARSE, "without the finest mesh");
    expect(4, finer, (double[]){0.16, 0.12, NAN}, OUTCOME_WRONG, "without it: too slow");
    expect(4, finer, (double[]){0.16, NAN, NAN}, OUTCOME_WRONG, "no neighbour has a value");
    expect(64, coarser, (double[]){0.01, 0.16, 0.04}, OUTCOME_COARSE, "coarser meshes were worse");
    expect(64, coarser, (double[]){0.04, 0.01, 0.02}, OUTCOME_WRONG, "coarser meshes were better");
    expect(64, coarser, (double[]){0.03, 0.08, 0.02}, OUTCOME_WRONG, "a coarser mesh was better");
    expect(64, coarser, (double[]){0.05, 0.16, NAN}, OUTCOME_COARSE, "one coarser mesh");
    expect(64, coarser, (double[]){0.06, 0.16, NAN}, OUTCOME_WRONG, "one coarser mesh: too slow");
    expect(16, around, (double[]){0.04, 0.16, 0.01}, OUTCOME_COARSE, "its own is the middle one");
    expect(16, around, (double[]){0.16, 0.04, 0.01}, OUTCOME_COARSE,
           "the middle one is out of line");
    expect(16, around, (double[]){0.01, 0.16, 0.04}, OUTCOME_WRONG, "the finest one is not best");
}

int main(void)
{
    bench_tests();
    dense_tests();
    expect_tests();
    neighbours_tests();
    return gsl_test_summary();
}
