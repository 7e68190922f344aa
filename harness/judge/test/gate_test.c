/* What the gate says of its counts, and the tables of "reached with n elements", both against what they should be by their
 * definition. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "harness/judge/judgement.h"
#include "harness/judge/reach.h"

/* Counts of which each alone fails the gate. */
static const size_t failing[] = {
    offsetof(judgement, unexpected), offsetof(judgement, disagreements),
    offsetof(judgement, unobserved), offsetof(judgement, unmet), offsetof(judgement, flaws)};
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
    static const size_t pointer[] = {offsetof(judgement, verdict), offsetof(judgement, agreement),
                                     offsetof(judgement, coverage), offsetof(judgement, flaw)};
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
        }
        judgement none = {0};
        set(&none, at, 1);
        gsl_test_int(judgement_exit(&none), is_among(at, CHECKING, checking) ? 0 : 3,
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

enum { MESHES = 7 };
static const double truth_value = -4;

typedef struct bench {
    sweep s;
    point p;
    series one;
    cell_result cell[MESHES];
    quantity_result quantity[MESHES];
    cell_timing timing[MESHES];
    truth row;
    verdict v;
} bench;

static void bench_make(bench *b)
{
    memset(b, 0, sizeof *b);
    scene_init(&b->p.scene, "made_up");
    scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    b->one = (series){.meshes = MESHES, .cell = b->cell, .timing = b->timing};
    b->s = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->one};
    b->row.value = truth_value;
    b->v.truth = &b->row;
    for (int i = 0; i < MESHES; i++) {
        b->cell[i].solve.quantities = 1;
        b->cell[i].solve.quantity = &b->quantity[i];
        b->timing[i].as_is.rounds = 1;
    }
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
        error[i] = uniform() < 0.1 ? NAN : uniform() < 0.5 ? -size : size;
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

static int fastest_by_definition(const bench *b, int first)
{
    int best = first;
    for (int i = first; first >= 0 && i < MESHES; i++)
        if (b->timing[i].as_is.round[0] < b->timing[best].as_is.round[0])
            best = i;
    return best;
}

static void reached(void)
{
    bench b;
    int wrong[REACH_LEVELS] = {0}, slow = 0, seen[MESHES + 1] = {0};
    bench_make(&b);
    for (int round = 0; round < 20000; round++) {
        double error[MESHES];
        throw_errors(error);
        for (int i = 0; i < MESHES; i++) {
            b.quantity[i].value = truth_value + error[i] * fabs(truth_value);
            error[i] = verdict_error(&b.p.scene.quantity[0], b.quantity[i].value, truth_value);
            b.timing[i].as_is.round[0] = uniform();
        }
        for (int k = 0; k < REACH_LEVELS; k++) {
            const int right = by_definition(error, reach_level[k]);
            wrong[k] += reach_mesh(&b.s, &b.v, reach_level[k]) != right;
            slow += reach_fastest(&b.s, &b.v, reach_level[k]) != fastest_by_definition(&b, right);
            seen[right + 1]++;
        }
    }
    for (int k = 0; k < REACH_LEVELS; k++)
        gsl_test_int(wrong[k], 0, "wrong meshes at level %g", reach_level[k]);
    gsl_test_int(slow, 0, "wrong fastest meshes");
    for (int i = 0; i <= MESHES; i++)
        gsl_test(seen[i] == 0, "every answer occurs: %d (%d times)", i - 1, seen[i]);
    scene_free(&b.p.scene);
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
    bench b;
    bench_make(&b);
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = truth_value;
    gsl_test_int(reach_mesh(&b.s, &b.v, 0.1), 0, "exact from the first mesh on");
    b.v.truth = NULL;
    gsl_test_int(reach_mesh(&b.s, &b.v, 0.1), -1, "no truth");
    gsl_test_int(reach_fastest(&b.s, &b.v, 0.1), -1, "no truth, no fastest");
    b.v.truth = &b.row;
    strcpy(b.one.missing, "shear");
    gsl_test_int(reach_mesh(&b.s, &b.v, 0.1), -1, "not offered");
    b.one.missing[0] = '\0';
    b.cell[MESHES - 1].solve.quantities = 0;
    gsl_test_int(reach_mesh(&b.s, &b.v, 0.1), -1, "no value on the finest mesh");
    b.cell[MESHES - 1].solve.quantities = 1;
    b.cell[2].solve.quantities = 0;
    gsl_test_int(reach_mesh(&b.s, &b.v, 0.1), 3, "no value on a coarse one: those behind it");
    b.one.timing = NULL;
    gsl_test_int(reach_fastest(&b.s, &b.v, 0.1), 3, "without times the coarsest");
    scene_free(&b.p.scene);
}

int main(void)
{
    exit_codes();
    failures_together();
    levels();
    reached();
    unreached();
    return gsl_test_summary();
}
