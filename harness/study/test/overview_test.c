/* The overview: of each case and formulation the worst, what is unexpected before all; the sentence
 * that closes a run. */
#include "harness/study/study.h"

#include "harness/formulations/formulations.h"

#include "harness/study/test/bench.h"

enum { VERDICTS = 40 };

/* Two cases, three formulations; the verdicts are made up. */
typedef struct run {
    sweep s;
    sweep_point point[2];
    series one[6];
    judgement j;
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
    r->j = (judgement){.verdict = r->verdict, .judged = 1};
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

/* Each kind alone, and each before those that are calmer, in any order. */
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

/* One that nobody expected comes before ten that are worse. */
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

static void says(const run *r, const char *expected)
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
    says(&r, "PASS: every verdict is as expected.");
    add(&r, 0, VERDICT_WRONG_AS_PREDICTED, 1, 2);
    add(&r, 0, VERDICT_BIASED_AS_PREDICTED, 1, 1);
    add(&r, 0, VERDICT_UNDECIDED, 1, 4);
    for (int i = 3; i < r.j.verdicts; i++)
        r.verdict[i].rule = &known;
    says(&r, "PASS: every verdict is as expected; 3 of them are limits off the truth (1 within the "
             "tolerance, 2 beyond it) just as derived for these formulations (beamwork explain "
             "\"wrong limit, as predicted\"), 4 more are explained by a known deviation.");
    r.s.unfinished = 7;
    says(&r, "INTERRUPTED: until then every verdict is as expected; 3 of them are limits off the "
             "truth (1 within the tolerance, 2 beyond it) just as derived for these formulations "
             "(beamwork "
             "explain \"wrong limit, as predicted\"), 4 more are explained by a known deviation.");
    r.s.unfinished = 0;
    add(&r, 0, VERDICT_BIASED, 0, 1);
    says(&r, "FAIL: 1 verdict differs from the expected one.");
    r.j.disagreements = 2;
    r.j.flaws = 1;
    r.j.unobserved = 2;
    r.j.unmet = 1;
    says(&r, "FAIL: 1 verdict differs from the expected one, 2 values differ from their stored "
             "ones, 1 inconsistent run record, 2 findings were not observed, 1 reference value "
             "refers to "
             "nothing that exists.");
    r.j.judged = 0;
    says(&r, "");
}

/* One is told as one. */
static void single_ones(void)
{
    run r;
    rule known = {.name = words[WHY]};
    make(&r);
    add(&r, 0, VERDICT_WRONG_AS_PREDICTED, 1, 1);
    add(&r, 0, VERDICT_UNDECIDED, 1, 1);
    for (int i = 0; i < r.j.verdicts; i++)
        r.verdict[i].rule = &known;
    says(&r, "PASS: every verdict is as expected; 1 of them is a limit off the truth (0 within the "
             "tolerance, 1 beyond it) just as derived for its formulation (beamwork explain "
             "\"wrong limit, as predicted\"), 1 more is explained by a known deviation.");
    make(&r);
    add(&r, 0, VERDICT_PASS, 1, 3);
    r.j.is_new = 2;
    says(&r, "PASS: every verdict is as expected; 2 are of new formulations, which do not affect "
             "the exit status: "
             "none needs a known deviation.");
    r.j.proposed = 1;
    says(&r, "PASS: nothing that affects the exit status differs from what is expected; without "
             "effect on the exit status: "
             "1 of 2 verdicts "
             "of new formulations is not a pass and would need a known deviation (--propose FILE "
             "writes it "
             "down).");
    r.j.proposed = 2;
    says(&r, "PASS: nothing that affects the exit status differs from what is expected; without "
             "effect on the exit status: "
             "2 of 2 verdicts "
             "of new formulations are not a pass and would need a known deviation (--propose FILE "
             "writes them "
             "down).");
    r.j.is_new = r.j.proposed = 1;
    says(&r, "PASS: nothing that affects the exit status differs from what is expected; without "
             "effect on the exit status: "
             "1 of 1 verdict of "
             "a new formulation is not a pass and would need a known deviation (--propose FILE "
             "writes it "
             "down).");
    r.j.proposed = 0;
    says(&r, "PASS: every verdict is as expected; 1 is of a new formulation, which does not affect "
             "the exit status: "
             "none needs a known deviation.");
}

/* Formulations with options share columns where they are many. */
static void columns(void)
{
    enum { MANY = 30 };
    static series many[MANY];
    sweep_point here = {.type = &made_up};
    sweep s = {.points = 1, .seriess = 3, .point = &here, .series = many};
    judgement j = {0};
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

/* They stand behind the others, whatever their order in the run. */
static void new_ones(void)
{
    static const element_type mine = {.name = "mine"};
    run r;
    overview o;
    fault f = {""};
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

int main(void)
{
    the_worst();
    the_unexpected();
    sentences();
    single_ones();
    columns();
    new_ones();
    return gsl_test_summary();
}
