/* The overview must show the worst verdict for each case and formulation, with unexpected verdicts
 * before expected ones. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/study/test/bench.h"

enum { VERDICTS = 40 };

typedef struct run {
    sweep s;
    sweep_point point[2];
    series one[6];
    evaluation j;
    verdict verdict[VERDICTS];
} run;

static const case_type other = {.name = "other"};
static char keys[][32] = {"a", "b:x=1", "c"};

static void make(run *r)
{
    memset(r, 0, sizeof *r);
    r->point[0].type = &made_up;
    r->point[1].type = &other;
    for (int i = 0; i < 6; i++) {
        r->one[i].point = i / 3;
        r->one[i].formulation.type = &element;
        strcpy(r->one[i].formulation.key, keys[i % 3]);
    }
    r->s = (sweep){.points = 2, .seriess = 6, .point = r->point, .series = r->one};
    r->j = (evaluation){.verdict = r->verdict, .evaluated = 1};
}

static void add(run *r, int series_index, verdict_kind kind, int matches, int times)
{
    for (int i = 0; i < times; i++)
        r->verdict[r->j.verdicts++] =
            (verdict){.series = series_index, .kind = kind, .matches = matches};
    r->j.unexpected += matches ? 0 : times;
}

static void shows(const run *r, int row, int column, const char *ascii, const char *utf8)
{
    overview o;
    fault f = {""};
    char text[OVERVIEW_TEXT];
    gsl_test(overview_make(&r->s, &r->j, &o, &f) != STATUS_OK, "made: %s", f.text);
    for (int k = 0; k < 2; k++) {
        overview_text(overview_at(&o, row, column), k, text);
        gsl_test(strcmp(text, k ? utf8 : ascii) != 0, "row %d, column %d: %s", row, column, text);
    }
    overview_free(&o);
}

static void the_worst(void)
{
    static const verdict_kind rising[] = {VERDICT_SKIP,
                                          VERDICT_PASS,
                                          VERDICT_LOW_ORDER,
                                          VERDICT_UNDECIDED,
                                          VERDICT_BIASED_AS_PREDICTED,
                                          VERDICT_WRONG_AS_PREDICTED,
                                          VERDICT_DIVERGED};
    static const char *const ascii[] = {".", "ok", "v2", "?2", "~2", "#2", "x2"};
    static const char *const utf8[] = {"·", "✓", "↓2", "?2", "≈2", "≠2", "×2"};
    const int kinds = sizeof rising / sizeof rising[0];
    for (int worst = 0; worst < kinds; worst++)
        for (int first = 0; first < 2; first++) {
            run r;
            make(&r);
            add(&r, 4, rising[worst], 1, first);
            for (int k = 0; k < worst; k++)
                add(&r, 4, rising[k], 1, 3);
            add(&r, 4, rising[worst], 1, 2 - first);
            shows(&r, 1, 1, ascii[worst], utf8[worst]);
            shows(&r, 0, 1, ".", "·");
        }
}

static void the_unexpected(void)
{
    run r;
    make(&r);
    add(&r, 2, VERDICT_DIVERGED, 1, 10);
    add(&r, 2, VERDICT_BIASED, 0, 1);
    add(&r, 2, VERDICT_WRONG_LIMIT, 1, 1);
    shows(&r, 0, 2, "!~1", "!≈1");
    agreement away = {.series = 2};
    flaw odd = {.series = 2};
    r.j.agreement = &away;
    r.j.agreements = r.j.disagreements = 1;
    r.j.flaw = &odd;
    r.j.flaws = 1;
    shows(&r, 0, 2, "!c2", "!c2");
    away.good = 1;
    shows(&r, 0, 2, "!c1", "!c1");
}

static void output(const run *r, const char *expected)
{
    char text[1000];
    sentence_of_run(&r->s, &r->j, text, sizeof text);
    gsl_test(strcmp(text, expected) != 0, "says '%s', should say '%s'", text, expected);
}

static void sentences(void)
{
    run r;
    rule known = {.name = words[WHY]};
    make(&r);
    add(&r, 0, VERDICT_PASS, 1, 3);
    output(&r, "PASS: every verdict is as expected.");
    add(&r, 0, VERDICT_WRONG_AS_PREDICTED, 1, 2);
    add(&r, 0, VERDICT_BIASED_AS_PREDICTED, 1, 1);
    add(&r, 0, VERDICT_UNDECIDED, 1, 4);
    for (int i = 3; i < r.j.verdicts; i++)
        r.verdict[i].rule = &known;
    output(&r,
           "PASS: every verdict is as expected; 3 of them concern limits that differ from the "
           "reference value (1 "
           "within the tolerance, 2 outside it), as derived for these formulations (beamwork "
           "explain \"wrong limit, as predicted\"), 4 more are explained by a known deviation.");
    r.s.unfinished = 7;
    output(&r,
           "INTERRUPTED: until then every verdict is as expected; 3 of them concern limits that "
           "differ from the "
           "reference value (1 within the tolerance, 2 outside it), as derived for these "
           "formulations (beamwork explain \"wrong limit, as predicted\"), 4 more are explained "
           "by a known deviation.");
    r.s.unfinished = 0;
    add(&r, 0, VERDICT_BIASED, 0, 1);
    output(&r, "FAIL: 1 verdict differs from the expected one.");
    r.j.disagreements = 2;
    r.j.flaws = 1;
    r.j.unobserved = 2;
    r.j.unmet = 1;
    output(&r,
           "FAIL: 1 verdict differs from the expected one, 2 values differ from their stored "
           "values, 1 inconsistent run record, 2 known deviations were not observed, 1 reference "
           "value "
           "refers to "
           "an unknown name.");
    r.j.evaluated = 0;
    output(&r, "");
}

static void single_ones(void)
{
    run r;
    rule known = {.name = words[WHY]};
    make(&r);
    add(&r, 0, VERDICT_WRONG_AS_PREDICTED, 1, 1);
    add(&r, 0, VERDICT_UNDECIDED, 1, 1);
    for (int i = 0; i < r.j.verdicts; i++)
        r.verdict[i].rule = &known;
    output(&r,
           "PASS: every verdict is as expected; 1 of them concerns a limit that differs from the "
           "reference value (0 "
           "within the tolerance, 1 outside it), as derived for its formulation (beamwork "
           "explain \"wrong limit, as predicted\"), 1 more is explained by a known deviation.");
    make(&r);
    add(&r, 0, VERDICT_PASS, 1, 3);
    r.j.is_new = 2;
    output(&r, "PASS: every verdict is as expected; 2 belong to new formulations and do not affect "
               "the exit status; none requires a known deviation.");
    r.j.proposed = 1;
    output(&r, "PASS: everything that affects the exit status is as expected; without "
               "effect on the exit status: "
               "1 of 2 verdicts "
               "of new formulations is not a pass and would need a known deviation "
               "(--propose-deviations FILE "
               "lists it).");
    r.j.proposed = 2;
    output(&r, "PASS: everything that affects the exit status is as expected; without "
               "effect on the exit status: "
               "2 of 2 verdicts "
               "of new formulations are not a pass and would need a known deviation "
               "(--propose-deviations FILE "
               "lists them).");
    r.j.is_new = r.j.proposed = 1;
    output(&r, "PASS: everything that affects the exit status is as expected; without "
               "effect on the exit status: "
               "1 of 1 verdict of "
               "a new formulation is not a pass and would need a known deviation "
               "(--propose-deviations FILE "
               "lists it).");
    r.j.proposed = 0;
    output(&r, "PASS: every verdict is as expected; 1 belongs to a new formulation and does not "
               "affect the exit status; none requires a known deviation.");
}

static void of_the_request(void)
{
    run r;
    make(&r);
    add(&r, 0, VERDICT_PASS, 1, 3);
    r.j.tolerated = 1;
    output(&r, "PASS: every verdict is as expected; 1 of them is no pass, but within the tolerance "
               "given by --tolerance.");
    r.j.tolerated = 0;
    r.j.imported = 2;
    output(&r, "PASS: every verdict is as expected; 2 verdicts on imported values do not affect "
               "the exit status (--imported-must-pass).");
    r.j.imported_failed = 1;
    output(&r, "PASS: everything that affects the exit status is as expected; without effect on "
               "the exit status: 1 of 2 verdicts on imported values is not as expected "
               "(--imported-must-pass lets it fail the run).");
}

static void columns(void)
{
    enum { MANY = 30 };
    static series many[MANY];
    sweep_point here = {.type = &made_up};
    sweep s = {.points = 1, .seriess = 3, .point = &here, .series = many};
    evaluation j = {0};
    overview o;
    fault f = {""};
    for (int i = 0; i < MANY; i++) {
        many[i].formulation.type = &element;
        snprintf(many[i].formulation.key, sizeof many[i].formulation.key, "element:x=%d", i);
    }
    for (s.seriess = 3; s.seriess <= MANY; s.seriess += MANY - 3) {
        gsl_test(overview_make(&s, &j, &o, &f) != STATUS_OK, "made");
        gsl_test_int(o.columns, s.seriess == 3 ? 3 : 1, "columns");
        gsl_test_int(o.joined, s.seriess == MANY, "joined");
        overview_free(&o);
    }
}

static void new_ones(void)
{
    static element_type mine;
    run r;
    overview o;
    fault f = {""};
    mine = *formulations_at(0);
    mine.name = "mine";
    make(&r);
    for (int i = 0; i < 6; i += 3)
        r.one[i].formulation.type = &mine;
    gsl_test(overview_make(&r.s, &r.j, &o, &f) != STATUS_OK, "made");
    gsl_test(o.accepted != 3 || strcmp(o.column[0], "a") != 0, "none is new");
    overview_free(&o);
    gsl_test(formulations_add(&mine, NULL, &f) != STATUS_OK, "added: %s", f.text);
    gsl_test(overview_make(&r.s, &r.j, &o, &f) != STATUS_OK, "made");
    gsl_test(o.columns != 3 || o.accepted != 3, "what is loaded gates");
    overview_free(&o);
    formulations_accept("mine");
    gsl_test(overview_make(&r.s, &r.j, &o, &f) != STATUS_OK, "made");
    gsl_test(o.columns != 3 || o.accepted != 1 || strcmp(o.column[0], "a") != 0,
             "the new ones are the last");
    overview_free(&o);
    r.s.named = 1;
    gsl_test(overview_make(&r.s, &r.j, &o, &f) != STATUS_OK, "made");
    gsl_test(o.columns != 3 || o.accepted != 3, "what is named gates");
    overview_free(&o);
}

static void overview_tests(void)
{
    the_worst();
    the_unexpected();
    sentences();
    single_ones();
    of_the_request();
    columns();
    new_ones();
}

static const size_t failing[] = {
    offsetof(evaluation, unexpected), offsetof(evaluation, disagreements),
    offsetof(evaluation, unobserved), offsetof(evaluation, unmet),
    offsetof(evaluation, flaws),      offsetof(evaluation, breaches),
    offsetof(evaluation, regressions)};
static const size_t checking[] = {offsetof(evaluation, evaluated),
                                  offsetof(evaluation, agreements)};
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
        offsetof(evaluation, verdict),  offsetof(evaluation, agreement),
        offsetof(evaluation, coverage), offsetof(evaluation, flaw),
        offsetof(evaluation, breach),   offsetof(evaluation, regression)};
    for (size_t i = 0; i < sizeof pointer / sizeof pointer[0]; i++)
        if (offset >= pointer[i] && offset < pointer[i] + sizeof(void *))
            return 1;
    return 0;
}

static void set(evaluation *j, size_t offset, int value)
{
    memcpy((char *)j + offset, &value, sizeof value);
}

static void exit_codes(void)
{
    int walked = 0;
    for (size_t at = 0; at + sizeof(int) <= sizeof(evaluation); at += sizeof(int)) {
        if (is_pointer(at))
            continue;
        walked++;
        for (int k = 0; k < CHECKING; k++) {
            evaluation j = {0};
            set(&j, checking[k], 1);
            gsl_test_int(evaluation_exit(&j), 0, "something was checked, nothing differs");
            set(&j, at, 1);
            gsl_test_int(evaluation_exit(&j), is_among(at, FAILING, failing),
                         "the count at byte %d alone", (int)at);
            gsl_test(strcmp(evaluation_outcome(&j), evaluation_exit(&j) ? "fail" : "pass") != 0,
                     "its word");
        }
        evaluation none = {0};
        set(&none, at, 1);
        const int broken =
            at == offsetof(evaluation, breaches) || at == offsetof(evaluation, regressions);
        gsl_test_int(evaluation_exit(&none),
                     is_among(at, CHECKING, checking) ? 0
                     : broken                         ? 1
                                                      : 3,
                     "nothing else: the count at byte %d", (int)at);
    }
    gsl_test(walked < FAILING + CHECKING + VERDICT_KINDS, "%d counts", walked);
}

static void failures_together(void)
{
    for (unsigned chosen = 0; chosen < 1u << FAILING; chosen++) {
        evaluation j = {.evaluated = 1};
        for (int k = 0; k < FAILING; k++)
            set(&j, failing[k], (int)(chosen >> k & 1u));
        gsl_test_int(evaluation_exit(&j), chosen != 0, "counts %u together", chosen);
    }
}

static const double truth_value = -4;

typedef struct timed {
    evaluation_bench b;
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

/* Returns the index of the coarsest mesh for which the errors on this mesh and all finer meshes are
 * within the level. Each mesh is tested. */
static int by_definition(const double error[MESHES], double level)
{
    for (int first = 0; first < MESHES; first++) {
        int all = 1;
        for (int i = first; i < MESHES; i++)
            all = all && fabs(error[i]) <= level;
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
            t.timing[i].as_is.round[0] = uniform();
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

static void levels(void)
{
    for (int k = 0; k < REACH_LEVELS; k++)
        gsl_test_rel(reach_level[k], pow(10, -1 - k), 1e-15, "level %d", k);
}

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

static void gate_tests(void)
{
    exit_codes();
    failures_together();
    levels();
    meshes_reached();
    unreached();
}

static const double just = 3e-3;

static verdict_kind evaluated(evaluation_bench *b, double limit, double apart)
{
    b->row[1].value = limit + apart;
    return bench_evaluate(b)->kind;
}

static void edges(evaluation_bench *b, double edge, verdict_kind beyond, const char *what)
{
    const double limit = bench_evaluate(b)->fit.limit;
    const verdict_kind within =
        beyond == VERDICT_BIASED ? VERDICT_BIASED_AS_PREDICTED : VERDICT_WRONG_AS_PREDICTED;
    for (int side = -1; side <= 1; side += 2) {
        const verdict_kind in = evaluated(b, limit, side * edge * (1 - just)),
                           out = evaluated(b, limit, side * edge * (1 + just));
        gsl_test(in != within, "%s: inside its edge %+.1e: %s", what, side * edge,
                 verdict_name(in));
        gsl_test(out != beyond, "%s: beyond its edge %+.1e: %s", what, side * edge,
                 verdict_name(out));
    }
}

static void with_prediction(evaluation_bench *b, double limit)
{
    static double none[1] = {0};
    bench_make(b);
    b->one.noise = none;
    bench_fill(b, limit, 0.7, 2);
    bench_add_prediction(b, limit);
}

static void sharp_limits(void)
{
    static const double error[] = {0.003, -0.003, 0.3, -0.03};
    for (int i = 0; i < 4; i++) {
        evaluation_bench b;
        with_prediction(&b, 3 + error[i]);
        const mesh_limit fit = bench_evaluate(&b)->fit;
        const double uncertainty = fit.limit_uncertainty, part = 1e-3 * error[i];
        gsl_test(!(uncertainty < 1e-5 * fabs(error[i])), "(the limit is known well: %.1e)",
                 uncertainty);
        gsl_test(evaluated(&b, fit.limit, part) != VERDICT_WRONG_LIMIT ||
                     evaluated(&b, fit.limit, -part) != VERDICT_WRONG_LIMIT,
                 "a thousandth of the error is another limit");
        b.row[1].uncertainty = fabs(error[i]) / 50;
        edges(&b, 3 * uncertainty + b.row[1].uncertainty, VERDICT_WRONG_LIMIT,
              "the prediction's uncertainty");
        b.row[0].uncertainty = fabs(error[i]) / 10;
        edges(&b, 3 * uncertainty + b.row[1].uncertainty, VERDICT_WRONG_LIMIT,
              "the reference value's own uncertainty does not count");
        bench_free(&b);
    }
}

static void uncertain_limits(void)
{
    evaluation_bench b;
    double noise[1] = {1e-5};
    with_prediction(&b, 3.03);
    b.one.noise = noise;
    const double uncertainty = bench_evaluate(&b)->fit.limit_uncertainty;
    gsl_test(!(3 * uncertainty > 1.5e-3 * 0.03), "(the limit is not known well: %.1e)",
             uncertainty);
    edges(&b, 3 * uncertainty, VERDICT_WRONG_LIMIT, "three uncertainties");
    b.row[1].uncertainty = uncertainty / 2;
    edges(&b, 3.5 * uncertainty, VERDICT_WRONG_LIMIT, "three uncertainties and the prediction's");
    bench_free(&b);
}

static void biases(void)
{
    static const double error[] = {2e-4, -2e-4};
    for (int i = 0; i < 2; i++) {
        evaluation_bench b;
        with_prediction(&b, 3 + error[i]);
        b.row[1].uncertainty = 1e-6;
        const double uncertainty = bench_evaluate(&b)->fit.limit_uncertainty;
        edges(&b, 3 * uncertainty + 1e-6, VERDICT_BIASED, "within the tolerance");
        b.row[1].value = 3 + 2 * error[i];
        char sentence[2 * FAULT_TEXT];
        sentence_of_verdict(bench_evaluate(&b), 2, sentence, sizeof sentence);
        gsl_test(strstr(sentence, i == 0 ? "also differs from the derived limit 3.0004"
                                         : "also differs from the derived limit 2.9996") == NULL,
                 "says '%s'", sentence);
        b.row[1].value = 3 + error[i];
        bench_fill(&b, 3, 0.7, 2);
        bench_expect(&b, VERDICT_PASS, 0,
                     "a limit that is the reference value, and not the derived one");
        bench_free(&b);
    }
}

static void undecided(void)
{
    evaluation_bench b;
    with_prediction(&b, 3.03);
    double noise[1] = {1e-2};
    b.one.noise = noise;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "noise that hides where the limit is");
    b.one.noise = NULL;
    b.one.meshes = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1,
                 "three meshes say of no limit that it is the derived one");
    bench_free(&b);
}

static void predicted_tests(void)
{
    sharp_limits();
    uncertain_limits();
    biases();
    undecided();
}

int main(void)
{
    gate_tests();
    predicted_tests();
    overview_tests();
    return gsl_test_summary();
}
