/* A JUnit file must be well-formed XML whose header contains the numbers of its tests, failures and
 * skipped tests. */
#include <fcntl.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "elements/test/kit.h"
#include "harness/records/records_impl.h"
#include "harness/records/test/folder.h"

enum { DEEPEST = 8, NAME = 32, HEADER = 3 };

typedef struct tree {
    int bad;                                     /* 1 if the document is not well-formed */
    int tests, failures, skipped, both, outside; /* `both`: tests that failed and were skipped;
                                                    `outside`: failures outside a test */
    int header[HEADER]; /* numbers of tests, failures and skipped tests in the header of the suite
                         */
    int depth;
    char open[DEEPEST][NAME];
    int marks;
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

/* Reads the attributes of a start tag: name="value" without raw < or &, and no name twice. Returns
 * the position after them. */
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

typedef struct junit_bench {
    sweep s;
    sweep_point p;
    series one;
    cell_result cell;
    truth row;
    verdict v[64];
    agreement a[8];
    evaluation j;
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
    b->j.evaluated += v->truth != NULL && kind != VERDICT_OTHER_MODEL;
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
                                  (evaluation_exit(&b->j) == EVALUATION_NOTHING);
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
            gsl_test_int(t.failures, !matches + (b.j.evaluated == 0), "%s: it alone", what);
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

static void junit_tests(void)
{
    reader();
    single_verdicts();
    mixtures();
}

enum { MOST_FIELDS = 8, ROOM = 256, LINES = 2 };

typedef struct thing {
    char first[ROOM], last[ROOM];
    int count;
    double size;
} thing;

static const schema_field fields[] = {{"first", "", FIELD_TEXT, "a text", AT(thing, first)},
                                      {"count", "1", FIELD_INT, "a number", AT(thing, count)},
                                      {"size", "m", FIELD_DOUBLE, "a length", AT(thing, size)},
                                      {"last", "", FIELD_TEXT, "another text", AT(thing, last)},
                                      {NULL}};
static const record_type type = {.name = "thing", .table = "things", .part = {fields}};

static int read_line(const char **at, char field[MOST_FIELDS][ROOM])
{
    int count = 0;
    for (int more = 1; more && count < MOST_FIELDS; count++) {
        int used = 0, quoted = **at == '"';
        *at += quoted;
        while (**at != '\0' && (quoted || (**at != ',' && **at != '\n'))) {
            if (quoted && **at == '"' && *++*at != '"')
                break;
            if (used + 1 < ROOM)
                field[count][used++] = **at;
            ++*at;
        }
        field[count][used] = '\0';
        more = **at == ',';
        if (**at != '\0')
            ++*at;
    }
    return count;
}

static void compare(const char *first, const char *last)
{
    char *text = NULL, field[MOST_FIELDS][ROOM];
    size_t length = 0;
    thing it = {.count = -3, .size = 0.1};
    const csv_part part = {&type, {.record = &it}};
    snprintf(it.first, sizeof it.first, "%s", first);
    snprintf(it.last, sizeof it.last, "%s", last);
    FILE *to = open_memstream(&text, &length);
    csv_record_head(to, 1, &part);
    for (int i = 0; i < LINES; i++)
        csv_record_line(to, 1, &part);
    fclose(to);
    const char *at = text;
    gsl_test_int(read_line(&at, field), 4, "'%s', '%s': columns", first, last);
    for (int k = 0; k < 4; k++)
        gsl_test(strcmp(field[k], fields[k].name) != 0, "column %d is %s", k, field[k]);
    for (int i = 0; i < LINES; i++) {
        gsl_test_int(read_line(&at, field), 4, "'%s', '%s': fields", first, last);
        gsl_test(strcmp(field[0], first) != 0 || strcmp(field[3], last) != 0,
                 "'%s', '%s': read as '%s', '%s'", first, last, field[0], field[3]);
        gsl_test(strcmp(field[1], "-3") != 0 || strtod(field[2], NULL) != 0.1,
                 "'%s', '%s': numbers %s, %s", first, last, field[1], field[2]);
    }
    gsl_test(*at != '\0', "'%s', '%s': nothing behind the last line", first, last);
    free(text);
}

static void no_number(void)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        char *text = NULL, field[MOST_FIELDS][ROOM];
        size_t length = 0;
        thing it = {.size = none[i]};
        const csv_part part = {&type, {.record = &it}};
        FILE *to = open_memstream(&text, &length);
        csv_record_line(to, 1, &part);
        fclose(to);
        const char *at = text;
        gsl_test_int(read_line(&at, field), 4, "%g: fields", none[i]);
        gsl_test(field[2][0] != '\0', "%g: its field holds '%s'", none[i], field[2]);
        free(text);
    }
}

static void csv_tests(void)
{
    static const char *const text[] = {"",           "plain",    "a,b",
                                       "\"",         "\"\"",     "'newton=\"dense\"'",
                                       "two\nlines", ",\",\n\"", "\xc3\xa4"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        for (size_t k = 0; k < sizeof text / sizeof text[0]; k++)
            compare(text[i], text[k]);
    no_number();
}

static void rectangles(void)
{
    const section_spec high = section_spec_rectangle(2e11, 8e10, 0.1, 0.2),
                       wide = section_spec_rectangle(2e11, 8e10, 0.3, 0.1);
    const section c[2] = {sections_computed(&high), sections_computed(&wide)};
    outline near, far, half;
    outline_of(&high, &c[0], &near);
    outline_of_far_end(&wide, &c[1], &c[0], &far);
    gsl_test_int(near.walls, far.walls, "walls of a rectangle");
    outline_between(&near, &far, 0.5, &half);
    for (int k = 0; k < 4; k++) {
        const double *a = near.corner[0][k], *b = far.corner[0][k], *h = half.corner[0][k];
        gsl_test(!(a[0] * b[0] > 0 && a[1] * b[1] > 0), "corner %d stays in its quadrant", k);
        gsl_test_rel(fabs(a[0]), 0.1, 1e-14, "corner %d, near: y", k);
        gsl_test_rel(fabs(b[0]), 0.05, 1e-14, "corner %d, far: y", k);
        gsl_test_rel(fabs(h[0]), 0.075, 1e-14, "corner %d, between: y", k);
        gsl_test_rel(fabs(h[1]), 0.1, 1e-14, "corner %d, between: z", k);
    }
}

static void matrices(void)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness;
    const double EA = 3e7, b = 0.05, h = 0.02;
    C[0] = C[7] = C[14] = EA;
    C[21] = 100;
    C[28] = EA * b * b / 12;
    C[35] = EA * h * h / 12;
    const section c = sections_computed(&spec);
    outline o;
    outline_of(&spec, &c, &o);
    gsl_test_int(o.equivalent, 1, "it stands for the section");
    for (int k = 0; k < 4; k++) {
        gsl_test_rel(fabs(o.corner[0][k][0]), h / 2, 1e-14, "corner %d of matrices: y", k);
        gsl_test_rel(fabs(o.corner[0][k][1]), b / 2, 1e-14, "corner %d of matrices: z", k);
    }
}

static void outline_tests(void)
{
    rectangles();
    matrices();
}

static void links(void)
{
    const test_folder of = folder_make();
    const folder_entry target = folder_path(&of, "target"), far = folder_path(&of, "far"),
                       near = folder_path(&of, "near"), chain = folder_path(&of, "chain"),
                       new_one = folder_path(&of, "new"), dangling = folder_path(&of, "dangling"),
                       circle = folder_path(&of, "circle");
    fault f = {""};
    gsl_test(folder_write_text(target.text, "before", &f) != STATUS_OK, "a file %s", f.text);
    gsl_test(symlink(target.text, far.text) | symlink("target", near.text) |
                 symlink("near", chain.text) | symlink("new", dangling.text) |
                 symlink("circle", circle.text),
             "links");
    const folder_entry link[] = {far, near, chain};
    for (int i = 0; i < 3; i++) {
        gsl_test(folder_write_text(link[i].text, link[i].text, &f) != STATUS_OK,
                 "written through %s %s", link[i].text, f.text);
        gsl_test(!S_ISLNK(folder_mode_of(link[i].text)) || !S_ISREG(folder_mode_of(target.text)) ||
                     !folder_holds(target.text, link[i].text),
                 "it is the link that stays and its target that is new");
    }
    gsl_test(folder_write_text(dangling.text, "made", &f) != STATUS_OK ||
                 !folder_holds(new_one.text, "made"),
             "where the link leads to");
    gsl_test(!S_ISLNK(folder_mode_of(dangling.text)), "and it stays a link");
    gsl_test(folder_write_text(circle.text, "never", &f) != STATUS_FAULT, "links in a circle: %s",
             f.text);
    gsl_test_int(folder_entries(of.path), 7, "nothing else is left");
    folder_remove(&of);
}

static void no_places(void)
{
    const test_folder of = folder_make();
    const folder_entry none = folder_path(&of, "none/file"), slash = folder_path(&of, "none/");
    char longest[PATH_MAX + 100];
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    const struct {
        const char *path;
        status outcome;
    } bad[] = {{"", STATUS_REFUSED},       {of.path, STATUS_FAULT}, {none.text, STATUS_FAULT},
               {slash.text, STATUS_FAULT}, {longest, STATUS_FAULT}, {"/nowhere/x", STATUS_FAULT}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fault f = {""};
        file_place where;
        gsl_test(output_try(bad[i].path, OUTPUT_TEXT, &where, &f) != bad[i].outcome ||
                     strchr(f.text, '\n') != NULL || f.text[0] == '\0',
                 "'%.60s': %s", bad[i].path, f.text);
    }
    gsl_test_int(folder_entries(of.path), 0, "nothing is left");
    folder_remove(&of);
}

static void same_places(void)
{
    const test_folder of = folder_make();
    const folder_entry a = folder_path(&of, "a"), dotted = folder_path(&of, "./a"),
                       link = folder_path(&of, "link"), hard = folder_path(&of, "hard"),
                       b = folder_path(&of, "b"), free_a = folder_path(&of, "free"),
                       free_dotted = folder_path(&of, ".//free"),
                       free_link = folder_path(&of, "free_link"),
                       free_b = folder_path(&of, "freed");
    const char *const one[] = {a.text, dotted.text, link.text, hard.text};
    const char *const other[] = {free_a.text, free_dotted.text, free_link.text};
    fault f = {""};
    file_place x, y;
    gsl_test(folder_write_text(a.text, "x", &f) != STATUS_OK ||
                 folder_write_text(b.text, "x", &f) != STATUS_OK,
             "two files %s", f.text);
    gsl_test(symlink(a.text, link.text) != 0 ||
                 linkat(AT_FDCWD, a.text, AT_FDCWD, hard.text, 0) != 0 ||
                 symlink("free", free_link.text) != 0,
             "links");
    for (int i = 0; i < 4; i++)
        gsl_test(place_find(a.text, &x, &f) | place_find(one[i], &y, &f) || !place_same(&x, &y),
                 "the same: %s", one[i]);
    for (int i = 0; i < 3; i++)
        gsl_test(place_find(free_a.text, &x, &f) | place_find(other[i], &y, &f) ||
                     !place_same(&x, &y),
                 "the same: %s", other[i]);
    gsl_test(place_find(a.text, &x, &f) | place_find(b.text, &y, &f) || place_same(&x, &y),
             "two files are two");
    gsl_test(place_find(free_a.text, &x, &f) | place_find(free_b.text, &y, &f) ||
                 place_same(&x, &y),
             "two new ones are two");
    gsl_test(place_find(a.text, &x, &f) | place_find(free_a.text, &y, &f) || place_same(&x, &y),
             "one and a new one are two");
    folder_remove(&of);
}

static void place_tests(void)
{
    links();
    no_places();
    same_places();
}

int main(void)
{
    junit_tests();
    csv_tests();
    outline_tests();
    place_tests();
    return gsl_test_summary();
}
