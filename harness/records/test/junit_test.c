/* JUnit: well-formed XML whose header counts the elements below it, for every kind of verdict,
 * expected or not, and any mixture of what else a run can miss. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/random.h"
#include "harness/records/records.h"

enum { DEEPEST = 8, NAME = 32, HEADER = 3 };

/* What a reader of XML sees. */
typedef struct tree {
    int bad;                                     /* not well-formed */
    int tests, failures, skipped, both, outside; /* both: a test that has failed and was skipped */
    int header[HEADER];                          /* tests, failures, skipped of the suite */
    int depth;
    char open[DEEPEST][NAME];
    int marks; /* of the test that is open */
} tree;

static const char *const header_name[HEADER] = {"tests", "failures", "skipped"};

static void see_start(tree *t, const char *name)
{
    const int failure = strcmp(name, "failure") == 0, skip = strcmp(name, "skipped") == 0;
    const int inside = t->depth > 0 && strcmp(t->open[t->depth - 1], "testcase") == 0;
    t->tests += strcmp(name, "testcase") == 0;
    t->failures += failure;
    t->skipped += skip;
    t->outside += (failure || skip) && !inside;
    t->marks = strcmp(name, "testcase") == 0 ? 0 : t->marks + (failure || skip);
    t->both += (failure || skip) && t->marks > 1;
}

/* Attributes of a start tag: name="value", no raw < or &, no name twice. Returns behind them. */
static const char *read_attributes(tree *t, const char *at, int is_suite)
{
    char names[400] = " ";
    while (*at == ' ' || *at == '\n') {
        char name[NAME] = "", word[NAME + 3];
        int length = 0;
        at += strspn(at, " \n");
        if (sscanf(at, "%31[a-z_]=\"%n", name, &length) < 1 || length == 0)
            return at;
        snprintf(word, sizeof word, " %s ", name);
        t->bad += strstr(names, word) != NULL;
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s ", name);
        at += length;
        for (int k = 0; k < HEADER; k++)
            if (is_suite && strcmp(name, header_name[k]) == 0)
                t->header[k] = atoi(at);
        for (; *at != '"' && *at != '\0'; at++) {
            static const char *const entity[] = {"&lt;", "&gt;", "&amp;", "&quot;"};
            int known = *at != '&';
            for (int k = 0; k < 4; k++)
                known |= strncmp(at, entity[k], strlen(entity[k])) == 0;
            t->bad += *at == '<' || !known;
        }
        t->bad += *at != '"';
        at += *at == '"';
    }
    return at;
}

static const char *read_end_tag(tree *t, const char *at)
{
    char name[NAME] = "";
    int length = 0;
    t->bad += sscanf(at, "</%31[a-z]>%n", name, &length) < 1 || length == 0 || t->depth == 0 ||
              strcmp(t->open[t->depth - 1], name) != 0;
    t->depth -= t->depth > 0;
    return at + (length > 0 ? length : 1);
}

static const char *read_start_tag(tree *t, const char *at)
{
    char name[NAME] = "";
    int length = 0;
    sscanf(at, "<%31[a-z]%n", name, &length);
    see_start(t, name);
    at = read_attributes(t, at + (length > 0 ? length : 1), strcmp(name, "testsuite") == 0);
    const int closed = strncmp(at, "/>", 2) == 0;
    t->bad += length == 0 || (!closed && *at != '>');
    if (!closed && t->depth < DEEPEST)
        snprintf(t->open[t->depth++], NAME, "%s", name);
    return at + (closed ? 2 : *at == '>');
}

static tree read_tree(const char *text)
{
    static const char declaration[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
    tree t = {.bad = strncmp(text, declaration, sizeof declaration - 1) != 0};
    for (const char *at = strchr(text, '\n'); at != NULL && *at != '\0' && t.bad == 0;) {
        if (*at == ' ' || *at == '\n')
            at++;
        else if (strncmp(at, "</", 2) == 0)
            at = read_end_tag(&t, at);
        else
            at = read_start_tag(&t, at);
    }
    t.bad += t.depth != 0 || t.tests == 0;
    return t;
}

/* One point, one series, and any judgement. */
typedef struct junit_bench {
    sweep s;
    sweep_point p;
    series one;
    cell_result cell;
    truth row;
    verdict v[64];
    agreement a[8];
    judgement j;
} junit_bench;

static const case_type made_up = {.name = "made_up"};

static void bench_make(junit_bench *b)
{
    memset(b, 0, sizeof *b);
    b->p.type = &made_up;
    strcpy(b->p.text, "width=1;word=<\"&'>");
    scene_init(&b->p.scene, "made_up");
    scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    strcpy(b->one.formulation.key, "element");
    b->one.meshes = 1;
    b->one.mesh[0] = 4;
    b->one.cell = &b->cell;
    b->s = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->one};
    b->row.value = 3;
    b->j.verdict = b->v;
    b->j.agreement = b->a;
}

/* As the judge counts (harness/study): the sums that the other reports show. */
static void add_verdict(junit_bench *b, verdict_kind kind, int matches)
{
    verdict *v = &b->v[b->j.verdicts++];
    *v = (verdict){.kind = kind,
                   .expected = matches ? kind : (kind + 1) % (VERDICT_KINDS + 1),
                   .matches = matches,
                   .finest = NAN};
    v->truth = kind == VERDICT_NO_TRUTH || kind == VERDICT_SKIP ? NULL : &b->row;
    v->predicted =
        kind == VERDICT_BIASED_AS_PREDICTED || kind == VERDICT_WRONG_AS_PREDICTED ? &b->row : NULL;
    strcpy(v->reason, "a < b & \"c\" > d");
    b->j.by_kind[kind]++;
    b->j.unexpected += !matches;
    b->j.judged += v->truth != NULL && kind != VERDICT_OTHER_MODEL;
}

static void add_agreement(junit_bench *b, int good)
{
    b->a[b->j.agreements++] = (agreement){.truth = &b->row, .value = 3, .good = good};
    b->j.disagreements += !good;
}

static tree written(const junit_bench *b)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    junit_write(to, &b->s, &b->j);
    fclose(to);
    const tree t = read_tree(text);
    if (t.bad)
        fprintf(stderr, "%s\n", text);
    free(text);
    return t;
}

static void check(const junit_bench *b, const char *what)
{
    const tree t = written(b);
    const int expected_failures = b->j.unexpected + b->j.disagreements + (b->j.unobserved > 0) +
                                  (b->j.unmet > 0) + (b->j.flaws > 0) + (b->s.unfinished > 0) +
                                  (judgement_exit(&b->j) == JUDGED_NOTHING);
    gsl_test(t.bad || t.both || t.outside, "%s: well-formed, every mark in a test of its own",
             what);
    gsl_test_int(t.header[0], t.tests, "%s: tests", what);
    gsl_test_int(t.header[1], t.failures, "%s: failures", what);
    gsl_test_int(t.header[2], t.skipped, "%s: skipped", what);
    gsl_test_int(t.failures, expected_failures, "%s: a failure for everything that fails the gate",
                 what);
}

static void single_verdicts(void)
{
    for (int kind = 0; kind < VERDICT_KINDS; kind++)
        for (int matches = 0; matches < 2; matches++) {
            junit_bench b;
            char what[80];
            bench_make(&b);
            add_verdict(&b, (verdict_kind)kind, matches);
            snprintf(what, sizeof what, "%s, %s", verdict_name((verdict_kind)kind),
                     matches ? "expected" : "unexpected");
            check(&b, what);
            const tree t = written(&b);
            gsl_test_int(t.failures, !matches + (b.j.judged == 0), "%s: it alone", what);
            gsl_test_int(t.skipped,
                         (kind == VERDICT_SKIP || kind == VERDICT_OTHER_MODEL) && matches,
                         "%s: it alone", what);
            scene_free(&b.p.scene);
        }
}

static void mixtures(void)
{
    uint64_t seed = 1;
    for (int round = 0; round < 200; round++) {
        junit_bench b;
        bench_make(&b);
        for (int i = 0; i < 20; i++) {
            add_verdict(&b, (verdict_kind)random_below(&seed, VERDICT_KINDS),
                        random_below(&seed, 3) != 0);
        }
        for (int i = 0; i < 4; i++)
            add_agreement(&b, random_below(&seed, 2) != 0);
        b.j.unobserved = random_below(&seed, 3) == 0 ? 5 : 0;
        b.j.unmet = random_below(&seed, 3) == 0 ? 7 : 0;
        b.j.flaws = random_below(&seed, 3) == 0 ? 2 : 0;
        b.s.unfinished = random_below(&seed, 3) == 0 ? 9 : 0;
        check(&b, "a mixture");
        scene_free(&b.p.scene);
    }
}

/* The reader itself: it must see what is wrong. */
static void reader(void)
{
    static const char head[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    static const char *const bad[] = {
        "<a>",          "<a></b>", "<testcase x=\"<\"/>",        "<testcase x=\"&\"/>",
        "<testcase x=", "</a>",    "<testcase x=\"1\" x=\"2\"/>"};
    char text[200];
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        snprintf(text, sizeof text, "%s%s", head, bad[i]);
        gsl_test(read_tree(text).bad == 0, "not well-formed: %s", bad[i]);
    }
    snprintf(text, sizeof text,
             "%s<testsuite tests=\"7\"><testcase><failure m=\"&lt;\"/></testcase></testsuite>\n",
             head);
    const tree t = read_tree(text);
    gsl_test(t.bad || t.tests != 1 || t.failures != 1 || t.header[0] != 7, "well-formed");
}

int main(void)
{
    reader();
    single_verdicts();
    mixtures();
    return gsl_test_summary();
}
