/* What the sweep of extremes expects, counts and exits with, on outcomes that are made up. */
#include <gsl/gsl_test.h>
#include <stdio.h>

#include "harness/extremes/stress.h"

static char all[] = "*", word[32];

/* Cells of one quantity, all of one kind, and a finding that speaks of another one or of this. */
static stress_count judged(stress_kind kind, const char *expected, int whole, int *unexpected,
                           int *code)
{
    stress_outcome o = {.kind = kind, .x = 1, .neighbours = -1};
    stress_finding row = {
        .extreme = all, .formulation = all, .quantity = all, .outcome = word, .from = 1, .to = 1};
    formulation chosen = {.key = "element"};
    stress_count count = {0};
    stress s = {.formulations = 1,
                .outcomes = 1,
                .findings = expected != NULL,
                .formulation = &chosen,
                .outcome = &o,
                .finding = &row,
                .count = &count};
    snprintf(word, sizeof word, "%s", expected != NULL ? expected : "");
    stress_expect(&s, whole);
    *unexpected = s.unexpected;
    *code = stress_exit(&s);
    return count;
}

static void kinds(void)
{
    for (int k = 0; k < STRESS_KINDS; k++) {
        int unexpected, code;
        const stress_kind kind = (stress_kind)k;
        const int good = kind == STRESS_VALUE || kind == STRESS_COARSE, skip = kind == STRESS_SKIP;
        const stress_count c = judged(kind, NULL, 1, &unexpected, &code);
        gsl_test_int(unexpected, !good && !skip, "%s: without a finding", stress_name(kind));
        gsl_test_int(code, skip ? 3 : good ? 0 : 1, "%s: its exit code", stress_name(kind));
        gsl_test_int(c.tried, !skip, "%s: tried", stress_name(kind));
        gsl_test_int(c.survived, good, "%s: survived", stress_name(kind));
        gsl_test_int(c.coarse, kind == STRESS_COARSE, "%s: coarse", stress_name(kind));
        gsl_test_int(c.wrong, kind == STRESS_WRONG, "%s: wrong", stress_name(kind));
        gsl_test_int(c.faults, kind == STRESS_FAULT, "%s: a fault", stress_name(kind));
        gsl_test_int(c.survived + c.named + c.wrong + c.faults, c.tried, "%s: each is one of them",
                     stress_name(kind));
        judged(kind, stress_name(kind), 1, &unexpected, &code);
        gsl_test_int(code, skip ? 3 : 0, "%s: as the finding says", stress_name(kind));
        judged(kind, kind == STRESS_SINGULAR ? "wrong" : "singular", 1, &unexpected, &code);
        gsl_test_int(unexpected, !skip, "%s: not as the finding says", stress_name(kind));
    }
}

/* A finding that no outcome shows fails a whole run, and only that. */
static void unobserved(void)
{
    for (int whole = 0; whole < 2; whole++) {
        stress_outcome o = {.kind = STRESS_VALUE, .x = 1, .neighbours = -1};
        stress_finding row = {.extreme = all,
                              .formulation = all,
                              .quantity = all,
                              .outcome = word,
                              .from = 2,
                              .to = 3};
        formulation chosen = {.key = "element"};
        stress_count count = {0};
        stress s = {.formulations = 1,
                    .outcomes = 1,
                    .findings = 1,
                    .formulation = &chosen,
                    .outcome = &o,
                    .finding = &row,
                    .count = &count};
        stress_expect(&s, whole);
        gsl_test_int(s.unexpected, 0, "the outcome is as expected");
        gsl_test_int(s.unobserved, whole, "the finding is elsewhere");
        gsl_test_int(stress_exit(&s), whole, "and is missed in a whole run");
    }
}

int main(void)
{
    kinds();
    unobserved();
    return gsl_test_summary();
}
