/* What is unexpected is told in full, whatever it is: verdicts, stored values, contradictions,
 * findings and truths that nothing answers to. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/terminal/terminal.h"

static const case_type made_up = {.name = "made_up"};
static char words[][300] = {"load",       "N",       "exact", "book, page 3",
                            "",           "element", "rule",  "made_up other_case",
                            "wrong limit"};
enum { LOAD, NEWTON, EXACT, BOOK, NOTHING, ELEMENT, RULE, CASES, WRONG };

/* One of each. */
typedef struct unexpected_bench {
    sweep s;
    sweep_point p;
    series one;
    scene_quantity q;
    judgement j;
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
    b->j = (judgement){.verdicts = 1, .verdict = &b->v};
}

/* What is shown; the caller frees it. */
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

int main(void)
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
          "    limit 3.300 +- 0.012, off by +10.0000 %; truth 3.0000000000 +- 1.0e-9 (exact, "
          "book, page 3);\n    finest mesh, n = 4: 3.310\n"
          "    beamwork converge made_up --set length=2 --set width=3 -f element:order=3 -n 2,4 "
          "-k load\n");

    b.j.agreements = b.j.disagreements = 1;
    b.j.agreement = &b.a;
    holds(&b, "\n 2. made_up (length=2;width=3), element:order=3, load\n"
              "    n = 2: 3.5 differs from the stored 3 (book, page 3)\n");

    b.j.flaws = 1;
    b.j.flaw = &b.c;
    holds(&b, "\n 3. made_up (length=2;width=3), element:order=3, n = 4\n"
              "    inconsistent run record: more steps than iterations\n");

    b.j.unobserved = 1;
    b.known[0].missed = 1;
    holds(&b, "\n 4. finding rule was not observed\n    formulations: element\n"
              "    cases: made_up other_case\n    quantities: load\n    cause: cccc");

    b.j.unmet = 1;
    holds(&b, "\n 5. truth of nothing that exists: made_up, load (book, page 3)\n");
    b.t.strangers = 2;
    strcpy(b.t.stranger, "gone");
    holds(&b, "\n 6. truths of 2 unknown cases, the first: gone\n");
    return gsl_test_summary();
}
