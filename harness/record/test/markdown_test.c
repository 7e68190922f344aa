/* The summary for a pull request: what differs stands in a table, and texts cannot break it. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/markdown.h"

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

int main(void)
{
    scene_quantity quantity = {.name = "load"};
    point p = {.type = &type, .text = "a=1", .scene = {.quantities = 1, .quantity = &quantity}};
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
    holds(text, "2 cells contradict themselves");
    holds(text, "| case_of_test | **!c2** |\n");
    free(text);

    breach broken = {"mine", "energy: it is none"};
    j = (judgement){.judged = 1, .breaches = 1, .breach = &broken};
    text = written(&s, &j);
    holds(text,
          "## beamwork: fail\n\n**mine breaks the contract of the interface**: energy: it is none");
    free(text);

    j = (judgement){.verdicts = 0};
    text = written(&s, &j);
    holds(text, "## beamwork: nothing was judged");
    free(text);
    return gsl_test_summary();
}
