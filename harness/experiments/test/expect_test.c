/* What the sweep of extremes expects, counts and exits with, on outcomes that are made up. */
#include <gsl/gsl_test.h>
#include <stdio.h>

#include "harness/experiments/experiments_impl.h"

static char all[] = "*", word[32];

/* Cells of one quantity, all of one kind, and a finding that speaks of another one or of this. */
static extreme_count judged(outcome_kind kind, const char *expected, int whole, int *unexpected,
                            int *code)
{
    extreme_outcome o = {.kind = kind, .x = 1, .neighbours = -1};
    extreme_finding row = {
        .extreme = all, .formulation = all, .quantity = all, .outcome = word, .from = 1, .to = 1};
    formulation chosen = {.key = "element"};
    extreme_count count = {0};
    extreme_sweep s = {.formulations = 1,
                       .outcomes = 1,
                       .findings = expected != NULL,
                       .formulation = &chosen,
                       .outcome = &o,
                       .finding = &row,
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
        const extreme_count c = judged(kind, NULL, 1, &unexpected, &code);
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
        judged(kind, outcome_name(kind), 1, &unexpected, &code);
        gsl_test_int(code, skip ? 3 : 0, "%s: as the finding says", outcome_name(kind));
        judged(kind, kind == OUTCOME_SINGULAR ? "wrong" : "singular", 1, &unexpected, &code);
        gsl_test_int(unexpected, !skip, "%s: not as the finding says", outcome_name(kind));
    }
}

/* One outcome, and one finding of whatever `word` says for x from 2 to 3. */
typedef struct expectation {
    extreme_outcome o;
    extreme_finding row;
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
                             .findings = 1,
                             .formulation = &out->chosen,
                             .outcome = &out->o,
                             .finding = &out->row,
                             .count = &out->count};
}

/* A finding that no outcome shows fails a whole run, and only that. */
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

/* Two outcomes of one cell (0: of two cells), in either order: a cell is as bad as its worst. */
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

/* A finding speaks of its range, both ends included but for their last digits. */
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

int main(void)
{
    cells();
    ranges();
    kinds();
    unobserved();
    return gsl_test_summary();
}
