/* The summary for a pull request: what differs stands in a table, and texts cannot break it. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/records.h"

static const case_type type = {.name = "case_of_test"};

/* The caller frees it. */
static char *written(const sweep *s, const judgement *j)
{
    const environment e = {.commit = "c0ffee", .compiler = "cc"};
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    overview o;
    fault f = {""};
    gsl_test(overview_make(s, j, &o, &f) != STATUS_OK, "overview: %s", f.text);
    markdown_write(to, s, j, &o, &e);
    overview_free(&o);
    fclose(to);
    return text;
}

static void holds(const char *text, const char *part)
{
    gsl_test(strstr(text, part) == NULL, "written: %s", part);
}

static int lines_with(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; at += strlen(part))
        count++;
    return count;
}

/* Fifty rows of a list are written, and how many are left; of more cases than rows those that pass
 * are named, and those without a verdict apart from them. */
static void long_lists(void)
{
    enum { MANY = 60, JUDGED = 40, WORSE = 53 };
    scene_quantity quantity = {.name = "load"};
    static char name[MANY][16];
    static case_type types[MANY];
    static sweep_point p[MANY];
    static series one[MANY];
    static verdict v[MANY];
    static regression worse[WORSE];
    truth row = {.value = 2};
    for (int i = 0; i < MANY; i++) {
        snprintf(name[i], sizeof name[i], "case_%d", i);
        types[i].name = name[i];
        p[i] = (sweep_point){
            .type = &types[i], .text = "", .scene = {.quantities = 1, .quantity = &quantity}};
        one[i] = (series){.point = i, .formulation.key = "beam"};
        v[i] = (verdict){.series = i, .kind = VERDICT_WRONG_LIMIT, .truth = &row, .reason = ""};
    }
    for (int i = 0; i < WORSE; i++) {
        snprintf(worse[i].of, sizeof worse[i].of, "mesh %d", i);
        snprintf(worse[i].why, sizeof worse[i].why, "twice as far off");
    }
    const sweep s = {.points = MANY, .seriess = MANY, .point = p, .series = one};
    judgement j = {.verdicts = MANY,
                   .verdict = v,
                   .judged = MANY,
                   .unexpected = MANY,
                   .regressions = WORSE,
                   .regression = worse};
    char *text = written(&s, &j);
    gsl_test_int(lines_with(text, " | twice as far off |"), 50, "rows of what is worse");
    gsl_test_int(lines_with(text, " | **wrong limit** | "), 50, "rows of what differs");
    holds(text, "| mesh 49 | twice as far off |\n\n… and 3 more.\n");
    holds(text, "\n\n… and 10 more.\n");
    free(text);

    for (int i = 0; i < MANY; i++) {
        v[i].kind = v[i].expected = VERDICT_PASS;
        v[i].matches = 1;
    }
    j = (judgement){.verdicts = JUDGED, .verdict = v, .judged = JUDGED};
    text = written(&s, &j);
    holds(text, "\nAll pass in what is judged: case_0, case_1, ");
    holds(text, ", case_39.\n");
    holds(text, "\nNothing is judged: case_40, case_41, ");
    holds(text, ", case_59.\n");
    free(text);
}

int main(void)
{
    scene_quantity quantity = {.name = "load"};
    sweep_point p = {
        .type = &type, .text = "a=1", .scene = {.quantities = 1, .quantity = &quantity}};
    series one = {.formulation.key = "beam:option=2"};
    sweep s = {.points = 1, .seriess = 1, .point = &p, .series = &one};
    truth row = {.value = 2};
    verdict v = {.kind = VERDICT_WRONG_LIMIT,
                 .expected = VERDICT_PASS,
                 .truth = &row,
                 .fit.limit = 2.5,
                 .error = 0.25,
                 .reason = "left | right\nbelow"};
    judgement j = {.verdicts = 1, .verdict = &v, .judged = 1, .unexpected = 1};
    flaw flaws[2] = {{.series = 0}};
    char *text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text, "1 verdicts against truths in 0 cells: 1 differ");
    holds(text, "| case_of_test | a=1 | `beam:option=2` | load | **wrong limit** | pass | 2.5 | 2 "
                "| +25 % | left \\| right below |");
    holds(text, "FAIL: 1 verdict differs from the expected one.");
    holds(text, "| case | beam:option=2 |\n|---|---|\n| case_of_test | **!≠1** |\n");
    holds(text, "\n≠ limit off, beyond the tolerance; **!** not as expected.");
    free(text);

    v.matches = 1;
    j.unexpected = 0;
    text = written(&s, &j);
    holds(text, "## beamwork: pass");
    gsl_test(strstr(text, "**wrong limit**") != NULL, "nothing differs: no table of differences");
    holds(text, "| `beam:option=2` |  |  | 1 |");
    holds(text, "PASS: every verdict is as expected");
    holds(text, "| case_of_test | ≠1 |\n");
    free(text);

    j.unobserved = 3;
    text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text, "3 findings were not observed");
    free(text);

    j.unobserved = 0;
    j.flaws = 2;
    j.flaw = flaws;
    text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text, "2 inconsistent run records");
    holds(text, "| case_of_test | **!c2** |\n");
    free(text);

    breach broken = {"mine", "energy: it is none"};
    j = (judgement){.judged = 1, .breaches = 1, .breach = &broken};
    text = written(&s, &j);
    holds(text,
          "## beamwork: fail\n\n**mine violates the interface requirements**: energy: it is none");
    free(text);

    j = (judgement){.verdicts = 0};
    text = written(&s, &j);
    holds(text, "## beamwork: nothing was judged");
    free(text);
    long_lists();
    return gsl_test_summary();
}
