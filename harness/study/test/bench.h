/* An artificial series with reference values and an evaluation, for tests of verdicts. */
#ifndef BEAMWORK_TEST_BENCH_H
#define BEAMWORK_TEST_BENCH_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/study/study.h"

enum { MESHES = 5 };
static const int mesh[MESHES] = {2, 4, 8, 16, 32};

static const parameter_type parameter[] = {{"length", "m", 2, 1, 9, NULL, "some length"}, {0}};

static inline status no_build(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)s;
    return fault_set(f, STATUS_FAULT, "not to be built");
}

static const case_type made_up = {.name = "made_up",
                                  .summary = "a case of the test",
                                  .source = "none",
                                  .parameters = {parameter},
                                  .build = no_build};
static const element_type element = {.name = "element", .abi = ELEMENT_ABI};

/* One point, one series of five meshes, and one quantity. The reference value is 3, the tolerance
 * 1e-4, the minimum order 2. */
typedef struct evaluation_bench {
    sweep s;
    sweep_point p;
    series one;
    cell_result cell[MESHES];
    quantity_result quantity[MESHES];
    truths t;
    truth row[2];
    rule known, twice[2];
    evaluation j;
} evaluation_bench;

static char words[][32] = {
    "load",        "N",       "exact",        "same",      "test",        "",          "element",
    "wrong limit", "why",     "kN",           "low order", "other",       "published", "predicted",
    "engesser",    "haringx", "unrepeatable", "made_up",   "made_up/load"};
enum {
    LOAD,
    NEWTON,
    EXACT,
    SAME,
    TEST,
    NOTHING,
    ELEMENT,
    WRONG_LIMIT,
    WHY,
    KILONEWTON,
    LOW_ORDER,
    OTHER,
    PUBLISHED,
    PREDICTED,
    ENGESSER,
    HARINGX,
    UNREPEATABLE,
    MADE_UP,
    LOAD_OF_IT
};

static inline void bench_make(evaluation_bench *b)
{
    memset(b, 0, sizeof *b);
    b->p.type = &made_up;
    b->p.parameter[0] = 2;
    scene_init(&b->p.scene, "made_up");
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    q->tolerance = 1e-4;
    q->least_order = 2;
    b->one = (series){
        .formulation = {.type = &element, .key = "element"}, .meshes = MESHES, .cell = b->cell};
    memcpy(b->one.mesh, mesh, sizeof mesh);
    for (int i = 0; i < MESHES; i++) {
        b->quantity[i].value = NAN;
        b->cell[i].solve.quantities = 1;
        b->cell[i].solve.quantity = &b->quantity[i];
    }
    b->s = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->one};
    b->row[0] = (truth){.type = &made_up,
                        .parameter = {2},
                        .formulation = words[NOTHING],
                        .theory = words[NOTHING],
                        .quantity = words[LOAD],
                        .unit = words[NEWTON],
                        .kind = words[EXACT],
                        .model = words[SAME],
                        .source = words[TEST],
                        .value = 3};
    b->t = (truths){.rows = 1, .row = b->row};
}

/* Adds a second row with this value, otherwise equal to the first row. The caller may change the
 * new row. */
static inline truth *bench_add_row(evaluation_bench *b, double value)
{
    b->row[1] = b->row[0];
    b->row[1].value = value;
    b->t.rows = 2;
    return &b->row[1];
}

static inline truth *bench_add_prediction(evaluation_bench *b, double limit)
{
    truth *row = bench_add_row(b, limit);
    row->kind = words[PREDICTED];
    row->formulation = words[ELEMENT];
    return row;
}

/* Sets the values limit + size n^-order. */
static inline void bench_fill(evaluation_bench *b, double limit, double size, double order)
{
    for (int i = 0; i < MESHES; i++)
        b->quantity[i].value = limit + size * pow(mesh[i], -order);
}

static inline void bench_converge(evaluation_bench *b)
{
    bench_make(b);
    bench_fill(b, 3, 0.7, 2);
}

static inline const verdict *bench_evaluate(evaluation_bench *b)
{
    fault f = {""};
    evaluation_free(&b->j);
    gsl_test(evaluation_make(&b->s, &b->t, 1, &b->j, &f) != STATUS_OK || b->j.verdicts != 1,
             "one verdict: %s", f.text);
    return &b->j.verdict[0];
}

static inline void bench_free(evaluation_bench *b)
{
    evaluation_free(&b->j);
    scene_free(&b->p.scene);
}

static inline void bench_expect(evaluation_bench *b, verdict_kind kind, int code, const char *what)
{
    const verdict *v = bench_evaluate(b);
    gsl_test(v->kind != kind, "%s: %s", what, verdict_name(v->kind));
    gsl_test_int(evaluation_exit(&b->j), code, "%s: exit code", what);
}

static inline void bench_expect_words(const evaluation_bench *b, const char *words_of_it)
{
    char sentence[2 * FAULT_TEXT];
    sentence_of_verdict(&b->j.verdict[0], 2, sentence, sizeof sentence);
    gsl_test(strcmp(sentence, words_of_it) != 0, "says '%s'", sentence);
}

#endif
