/* What the gate says of its counts, and the tables of "reached with n elements", both against what
 * they should be by their definition. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"
#include "harness/study/test/bench.h"

/* Counts of which each alone fails the gate. */
static const size_t failing[] = {
    offsetof(judgement, unexpected), offsetof(judgement, disagreements),
    offsetof(judgement, unobserved), offsetof(judgement, unmet),
    offsetof(judgement, flaws),      offsetof(judgement, breaches),
    offsetof(judgement, regressions)};
/* Counts of what was checked: with none of these there is no answer. */
static const size_t checking[] = {offsetof(judgement, judged), offsetof(judgement, agreements)};
enum {
    FAILING = sizeof failing / sizeof failing[0],
    CHECKING = sizeof checking / sizeof checking[0]
};

static int is_among(size_t offset, int count, const size_t list[])
{
    for (int i = 0; i < count; i++)
        if (list[i] == offset)
            return 1;
    return 0;
}

static int is_pointer(size_t offset)
{
    static const size_t pointer[] = {
        offsetof(judgement, verdict),  offsetof(judgement, agreement),
        offsetof(judgement, coverage), offsetof(judgement, flaw),
        offsetof(judgement, breach),   offsetof(judgement, regression)};
    for (size_t i = 0; i < sizeof pointer / sizeof pointer[0]; i++)
        if (offset >= pointer[i] && offset < pointer[i] + sizeof(void *))
            return 1;
    return 0;
}

static void set(judgement *j, size_t offset, int value)
{
    memcpy((char *)j + offset, &value, sizeof value);
}

/* Every count of the judgement, one by one: a new one is walked too. */
static void exit_codes(void)
{
    int walked = 0;
    for (size_t at = 0; at + sizeof(int) <= sizeof(judgement); at += sizeof(int)) {
        if (is_pointer(at))
            continue;
        walked++;
        for (int k = 0; k < CHECKING; k++) {
            judgement j = {0};
            set(&j, checking[k], 1);
            gsl_test_int(judgement_exit(&j), 0, "something was checked, nothing differs");
            set(&j, at, 1);
            gsl_test_int(judgement_exit(&j), is_among(at, FAILING, failing),
                         "the count at byte %d alone", (int)at);
            gsl_test(strcmp(judgement_outcome(&j), judgement_exit(&j) ? "fail" : "pass") != 0,
                     "its word");
        }
        judgement none = {0};
        set(&none, at, 1);
        const int broken = at == offsetof(judgement, breaches) ||
                           at == offsetof(judgement, regressions); /* fail without a verdict */
        gsl_test_int(judgement_exit(&none),
                     is_among(at, CHECKING, checking) ? 0
                     : broken                         ? 1
                                                      : 3,
                     "nothing else: the count at byte %d", (int)at);
    }
    gsl_test(walked < FAILING + CHECKING + VERDICT_KINDS, "%d counts", walked);
}

/* No two failures cancel each other. */
static void failures_together(void)
{
    for (unsigned chosen = 0; chosen < 1u << FAILING; chosen++) {
        judgement j = {.judged = 1};
        for (int k = 0; k < FAILING; k++)
            set(&j, failing[k], (int)(chosen >> k & 1u));
        gsl_test_int(judgement_exit(&j), chosen != 0, "counts %u together", chosen);
    }
}

static const double truth_value = -4;

/* A series with times, and the verdict that reach is asked of. */
typedef struct timed {
    judge_bench b;
    cell_timing timing[MESHES];
    verdict v;
} timed;

static void timed_make(timed *t)
{
    memset(t, 0, sizeof *t);
    bench_make(&t->b);
    t->b.row[0].value = truth_value;
    t->b.one.timing = t->timing;
    t->v.truth = &t->b.row[0];
    for (int i = 0; i < MESHES; i++)
        t->timing[i].as_is.rounds = 1;
}

static double uniform(void)
{
    return rand() / (RAND_MAX + 1.0);
}

/* Errors of every size and sign, also exactly at a level, also none. */
static void throw_errors(double error[MESHES])
{
    for (int i = 0; i < MESHES; i++) {
        const double size =
            uniform() < 0.2 ? reach_level[rand() % REACH_LEVELS] : pow(10, -6 * uniform());
        error[i] = NAN;
        if (uniform() >= 0.1)
            error[i] = uniform() < 0.5 ? -size : size;
    }
}

/* From which mesh on is every error within the level?  Tried one by one. */
static int by_definition(const double error[MESHES], double level)
{
    for (int first = 0; first < MESHES; first++) {
        int all = 1;
        for (int i = first; i < MESHES; i++)
            all = all && fabs(error[i]) <= level; /* NAN is not */
        if (all)
            return first;
    }
    return -1;
}

static void meshes_reached(void)
{
    timed t;
    int wrong[REACH_LEVELS] = {0}, seen[MESHES + 1] = {0};
    timed_make(&t);
    for (int round = 0; round < 20000; round++) {
        double error[MESHES];
        throw_errors(error);
        for (int i = 0; i < MESHES; i++) {
            t.b.quantity[i].value = truth_value + error[i] * fabs(truth_value);
            error[i] = verdict_error(&t.b.p.scene.quantity[0], t.b.quantity[i].value, truth_value);
            t.timing[i].as_is.round[0] = uniform(); /* which has no say */
        }
        for (int k = 0; k < REACH_LEVELS; k++) {
            const int right = by_definition(error, reach_level[k]);
            wrong[k] += reach_mesh(&t.b.s, &t.v, reach_level[k]) != right;
            seen[right + 1]++;
        }
    }
    for (int k = 0; k < REACH_LEVELS; k++)
        gsl_test_int(wrong[k], 0, "wrong meshes at level %g", reach_level[k]);
    for (int i = 0; i <= MESHES; i++)
        gsl_test(seen[i] == 0, "every answer occurs: %d (%d times)", i - 1, seen[i]);
    bench_free(&t.b);
}

/* Levels as they are named in every table. */
static void levels(void)
{
    for (int k = 0; k < REACH_LEVELS; k++)
        gsl_test_rel(reach_level[k], pow(10, -1 - k), 1e-15, "level %d", k);
}

/* Nothing is reached without a truth, without the formulation, or by a value that is not there. */
static void unreached(void)
{
    timed t;
    timed_make(&t);
    for (int i = 0; i < MESHES; i++)
        t.b.quantity[i].value = truth_value;
    gsl_test_int(reach_mesh(&t.b.s, &t.v, 0.1), 0, "exact from the first mesh on");
    t.v.truth = NULL;
    gsl_test_int(reach_mesh(&t.b.s, &t.v, 0.1), -1, "no truth");
    t.v.truth = &t.b.row[0];
    strcpy(t.b.one.missing, "shear");
    gsl_test_int(reach_mesh(&t.b.s, &t.v, 0.1), -1, "not offered");
    t.b.one.missing[0] = '\0';
    t.b.cell[MESHES - 1].solve.quantities = 0;
    gsl_test_int(reach_mesh(&t.b.s, &t.v, 0.1), -1, "no value on the finest mesh");
    t.b.cell[MESHES - 1].solve.quantities = 1;
    t.b.cell[2].solve.quantities = 0;
    gsl_test_int(reach_mesh(&t.b.s, &t.v, 0.1), 3, "no value on a coarse one: those behind it");
    bench_free(&t.b);
}

int main(void)
{
    exit_codes();
    failures_together();
    levels();
    meshes_reached();
    unreached();
    return gsl_test_summary();
}
