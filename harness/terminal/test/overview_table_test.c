/* The matrix of verdicts on a terminal. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/terminal/terminal_impl.h"

enum { MOST = 64, NAME = 40 };

typedef struct table_bench {
    overview o;
    case_type type[MOST];
    const case_type *row[MOST];
    const char *column[MOST];
    char case_name[MOST][NAME], name[MOST][NAME];
    overview_cell cell[MOST * MOST];
} table_bench;

static const screen plain = {0, 0};

static void make(table_bench *b, int rows, int columns, const char *name)
{
    memset(b, 0, sizeof *b);
    b->o = (overview){.rows = rows,
                      .columns = columns,
                      .accepted = columns,
                      .row = b->row,
                      .column = b->column,
                      .cell = b->cell};
    for (int i = 0; i < MOST; i++) {
        snprintf(b->case_name[i], NAME, "case_%d", i);
        snprintf(b->name[i], NAME, "%s_%d", name, i);
        b->type[i].name = b->case_name[i];
        b->row[i] = &b->type[i];
        b->column[i] = b->name[i];
    }
    for (int i = 0; i < rows * columns; i++)
        b->cell[i].mark = OVERVIEW_PASS;
}

static char *shown(const table_bench *b, screen look)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    table_overview(to, look, &b->o);
    fclose(to);
    return text;
}

static int widest(const char *text)
{
    int most = 0, here = 0;
    for (; *text != '\0'; text++) {
        here = *text == '\n' ? 0 : here + (((unsigned char)*text & 0xc0) != 0x80);
        most = here > most ? here : most;
    }
    return most;
}

static int count(const char *text, const char *word)
{
    int n = 0;
    for (size_t i = 0; text[i] != '\0'; i++)
        n += strncmp(text + i, word, strlen(word)) == 0;
    return n;
}

static void widths(void)
{
    static const char *const names[] = {"a", "geometrically_exact",
                                        "beamw_consistent:torsion=hyperbolic",
                                        "nameofoneverylongwordwithout"};
    static table_bench b;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
        for (int columns = 1; columns <= 40; columns++) {
            make(&b, 3, columns, names[k]);
            for (int c = 0; c < columns; c++)
                b.cell[c] = (overview_cell){OVERVIEW_WRONG, 1, 100 + c};
            char *text = shown(&b, plain);
            for (int c = 0; c < columns; c++) {
                char mark[16];
                snprintf(mark, sizeof mark, "!#%d", 100 + c);
                gsl_test(count(text, mark) != 1, "%d x %s: %s is there", columns, names[k], mark);
            }
            const int width = widest(text);
            gsl_test(width > PARAGRAPH_WIDTH, "%d x %s: %d columns", columns, names[k], width);
            free(text);
        }
}

static void heads(void)
{
    static table_bench b;
    make(&b, 1, 3, "sheet_second");
    char *text = shown(&b, plain);
    for (int c = 0; c < 3; c++)
        gsl_test(count(text, b.name[c]) != 1, "%s is there", b.name[c]);
    free(text);
}

static void new_ones(void)
{
    static table_bench b;
    make(&b, 1, 3, "beam");
    char *text = shown(&b, plain);
    gsl_test_int(count(text, "(new)"), 0, "none is new");
    free(text);
    b.o.accepted = 1;
    text = shown(&b, plain);
    gsl_test_int(count(text, "(new)"), 3, "two are new, and what that means");
    gsl_test_int(count(text, "do not affect the exit"), 1, "they do not gate");
    free(text);
}

static void passing(void)
{
    static table_bench b;
    make(&b, MOST, 4, "beam");
    b.cell[4 * 7 + 2] = (overview_cell){OVERVIEW_UNDECIDED, 0, 3};
    b.cell[4 * 9 + 1] = (overview_cell){OVERVIEW_BIASED, 1, 2};
    for (int c = 0; c < 4; c++)
        b.cell[4 * 11 + c] =
            (overview_cell){c == 2 ? OVERVIEW_OTHER_MODEL : OVERVIEW_NOTHING, 0, 1};
    char *text = shown(&b, plain);
    gsl_test(strstr(text, "\ncase_7 ") == NULL || strstr(text, "\ncase_9 ") == NULL, "rows");
    gsl_test(count(text, "61 more pass in all verdicts: case_0, case_1,") != 1, "the others");
    gsl_test(count(text, "\n1 more have no verdict: case_11\n") != 1, "not judged");
    gsl_test(count(text, "ok") != 6 + 1, "%d marks, and the words of one", count(text, "ok"));
    int lines = 0;
    for (const char *c = text; *c != '\0'; c++)
        lines += *c == '\n';
    gsl_test(lines > 20, "%d lines", lines);
    free(text);
    make(&b, 5, 4, "beam");
    text = shown(&b, plain);
    gsl_test(count(text, "\ncase_") != 5, "few cases have a line each");
    free(text);
}

static void legend(void)
{
    static table_bench b;
    make(&b, 2, 2, "beam");
    b.cell[1].mark = OVERVIEW_NOTHING;
    char *text = shown(&b, plain);
    gsl_test(strstr(text, "ok all pass") == NULL || strstr(text, ". no verdict") == NULL,
             "what is used is told");
    gsl_test(strstr(text, "limit outside") != NULL || strstr(text, "!") != NULL, "and no more");
    free(text);
    b.cell[0] = (overview_cell){OVERVIEW_WRONG, 1, 1};
    text = shown(&b, (screen){0, 1});
    gsl_test(strstr(text, "! not as expected") == NULL || strstr(text, "≠ limit outside") == NULL,
             "%s", text);
    free(text);
    text = shown(&b, (screen){1, 1});
    gsl_test(strstr(text, "\033[1;31m!≠1\033[0m") == NULL, "what is unexpected jumps out");
    free(text);
    b.o.rows = 0;
    text = shown(&b, plain);
    gsl_test(text[0] != '\0', "nothing of nothing");
    free(text);
}

static void overview_table_tests(void)
{
    widths();
    heads();
    new_ones();
    passing();
    legend();
}

static const case_type made_up = {.name = "made_up"};
static char words[][300] = {"load",       "N",       "exact", "book, page 3",
                            "",           "element", "rule",  "made_up other_case",
                            "wrong limit"};
enum { LOAD, NEWTON, EXACT, BOOK, NOTHING, ELEMENT, RULE, CASES, WRONG };

typedef struct unexpected_bench {
    sweep s;
    sweep_point p;
    series one;
    scene_quantity q;
    evaluation j;
    verdict v;
    agreement a;
    flaw c;
    truths t;
    truth row[2];
    rule known[2];
} unexpected_bench;

static void unexpected_make(unexpected_bench *b)
{
    static char cause[300];
    memset(cause, 'c', 40);
    memset(cause + 40, ' ', 1);
    memset(cause + 41, 'd', 90);
    memset(b, 0, sizeof *b);
    b->q = (scene_quantity){.name = "load", .unit = "N"};
    b->p = (sweep_point){.type = &made_up,
                         .text = "length=2;width=3",
                         .scene = {.quantities = 1, .quantity = &b->q}};
    b->one = (series){.formulation.key = "element:order=3", .meshes = 2, .mesh = {2, 4}};
    b->s = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->one};
    b->row[0] = (truth){.type = &made_up,
                        .formulation = words[NOTHING],
                        .quantity = words[LOAD],
                        .kind = words[EXACT],
                        .source = words[BOOK],
                        .value = 3,
                        .uncertainty = 1e-9,
                        .met = 1};
    b->row[1] = b->row[0];
    b->row[1].met = 0;
    b->v = (verdict){.kind = VERDICT_WRONG_LIMIT,
                     .truth = &b->row[0],
                     .fit = {.limit = 3.3, .limit_uncertainty = 0.012, .order = 2},
                     .finest = 3.31,
                     .error = 0.1};
    b->a = (agreement){.truth = &b->row[0], .value = 3.5};
    b->c = (flaw){.mesh = 1, .why = "more steps than iterations"};
    b->known[0] = (rule){.name = words[RULE],
                         .formulations = words[ELEMENT],
                         .cases = words[CASES],
                         .quantities = words[LOAD],
                         .verdicts = words[WRONG],
                         .predicted = words[NOTHING],
                         .cause = cause};
    b->t = (truths){.rows = 2, .row = b->row, .rules = 1, .rule = b->known};
    b->j = (evaluation){.verdicts = 1, .verdict = &b->v};
}

static char *unexpected_shown(const unexpected_bench *b)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    table_unexpected(to, (screen){0, 0}, &b->s, &b->j, &b->t);
    fclose(to);
    return text;
}

static void holds(const unexpected_bench *b, const char *part)
{
    char *text = unexpected_shown(b);
    gsl_test(strstr(text, part) == NULL, "'%s' stands in: %s", part, text);
    for (char *rest = text, *line; (line = strsep(&rest, "\n")) != NULL;)
        gsl_test(paragraph_columns(line) > PARAGRAPH_WIDTH, "%s", line);
    free(text);
}

static void unexpected_tests(void)
{
    unexpected_bench b;
    unexpected_make(&b);
    b.v.matches = 1;
    char *text = unexpected_shown(&b);
    gsl_test(text[0] != '\0', "nothing where all is as expected: %s", text);
    free(text);

    b.v.matches = 0;
    b.j.unexpected = 1;
    holds(&b,
          "\n 1. made_up (length=2;width=3), element:order=3, load [N]\n"
          "    wrong limit, expected pass\n    converges to a wrong limit: +10 %\n"
          "    limit 3.300 +- 0.012, error +10.0000 %; reference value 3.0000000000 +- 1.0e-9 "
          "(exact, "
          "book,\n    page 3); finest mesh, n = 4: 3.310\n"
          "    beamwork converge made_up --set length=2 --set width=3 -f element:order=3 -n 2,4 "
          "-k load\n");

    b.j.agreements = b.j.disagreements = 1;
    b.j.agreement = &b.a;
    holds(&b, "\n 2. made_up (length=2;width=3), element:order=3, load\n"
              "    n = 2: 3.5 differs from the stored value 3 (book, page 3)\n");

    b.j.flaws = 1;
    b.j.flaw = &b.c;
    holds(&b, "\n 3. made_up (length=2;width=3), element:order=3, n = 4\n"
              "    inconsistent run record: more steps than iterations\n");

    b.j.unobserved = 1;
    b.known[0].missed = 1;
    holds(&b, "\n 4. known deviation rule was not observed\n    formulations: element\n"
              "    cases: made_up other_case\n    quantities: load\n    cause: cccc");

    b.j.unmet = 1;
    holds(&b, "\n 5. reference value with an unknown name: made_up, load (book, page 3)\n");
    b.t.unknown_cases = 2;
    strcpy(b.t.unknown_case, "gone");
    holds(&b, "\n 6. unknown cases in the reference values: 2; the first is gone\n");
}

enum { STABILITY_MOST = 16 };

/* Checks the text for a path. There is one letter for each step: o open, d no divergence, s stable,
 * u unstable, g growing, h held. The steps end at 0.5, 1, ... */
static void is(const char *letters, scene_analysis_kind kind, const char *expected)
{
    static const char letter[] = "odsugh";
    step_record step[STABILITY_MOST];
    scene_analysis analysis[2] = {{.kind = SCENE_LINEAR}, {.kind = kind}};
    const scene s = {.analyses = 2, .analysis = analysis};
    const int steps = (int)strlen(letters);
    char *text = NULL;
    size_t size = 0;
    memset(step, 0, sizeof step);
    for (int i = 0; i < steps; i++) {
        step[i].analysis = 1;
        step[i].path = 0.5 * (i + 1);
        step[i].stability = (step_stability)(strchr(letter, letters[i]) - letter);
        step[i].negative_pivots = letters[i] == 'u';
    }
    const solve_result r = {.steps = steps, .step = step};
    FILE *to = open_memstream(&text, &size);
    const int lines = table_stability_paths(to, &s, &r);
    fclose(to);
    gsl_test_int(lines, expected[0] != '\0', "%s: lines", letters);
    gsl_test_str(text, expected, "%s", letters);
    free(text);
}

static void stability_tests(void)
{
    is("", SCENE_STATIC, "");
    is("ssss", SCENE_STATIC, "");
    is("oooo", SCENE_STATIC, "");
    is("uuu", SCENE_STATIC, "analysis 1: unstable all along (path)\n");
    is("dd", SCENE_STATIC, "analysis 1: no divergence all along (path)\n");
    is("ssus", SCENE_STATIC, "analysis 1: stable up to 1, unstable at 1.5, stable from 2 (path)\n");
    is("suuso", SCENE_CONTINUATION,
       "analysis 1: stable up to 0.5, unstable 1 to 1.5, stable at 2, not determined by pivots "
       "from 2.5\n  (load factor)\n");
    is("hg", SCENE_STATIC,
       "analysis 1: stable without damping up to 0.5, unstable from 1 (path)\n");
    is("sususus", SCENE_STATIC,
       "analysis 1: stable up to 0.5, unstable at 1, stable at 1.5, unstable at 2, stable at 2.5, "
       "unstable\n  at 3, and so on (path)\n");
}

int main(void)
{
    overview_table_tests();
    unexpected_tests();
    stability_tests();
    return gsl_test_summary();
}
