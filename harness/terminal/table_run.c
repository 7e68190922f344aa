#include "harness/terminal/table_run.h"

#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/screen.h"
#include "harness/terminal/table.h"

/* "case (parameters), formulation, n = 1, 2: WHY" of the meshes of a series without a solution; the
 * reason of the finest of them. */
static void failed_series(FILE *to, const sweep *s, int index, int *lines)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const solve_result *last = NULL;
    char meshes[16 * SERIES_MAX_MESHES] = "";
    for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++) {
        const size_t used = strlen(meshes);
        if (one->cell[k].solve.status == STATUS_OK)
            continue;
        snprintf(meshes + used, sizeof meshes - used, "%s%d", last != NULL ? ", " : "",
                 one->mesh[k]);
        last = &one->cell[k].solve;
    }
    if (last == NULL)
        return;
    if ((*lines)++ == 0)
        fprintf(to, "\ncells without a solution\n");
    const int at = fprintf(to, "  %s", p->type->name);
    paragraph_say(to, at, 4, "%s%s%s, %s, n = %s: %s: %s", p->text[0] != '\0' ? " (" : "", p->text,
                  p->text[0] != '\0' ? ")" : "", one->formulation.key, meshes,
                  status_name(last->status), last->reason);
}

/* Cells that have no solution, also where finer meshes have one and decide the verdict. */
static void failed_cells(FILE *to, const sweep *s)
{
    int lines = 0;
    for (int i = 0; i < s->seriess; i++)
        failed_series(to, s, i, &lines);
}

/* How often the limits of each formulation hold what they promise, over all cases. */
static void coverage_lines(FILE *to, const judgement *j)
{
    if (j->coverages > 0)
        fprintf(to, "\nlimits within their uncertainty of exact truths, also without the 1, 2, 3 "
                    "finest meshes\n");
    for (int i = 0; i < j->coverages; i++) {
        coverage sum = {.type = j->coverage[i].type};
        int before = 0;
        for (int k = 0; k < j->coverages; k++) {
            before |= k < i && j->coverage[k].type == sum.type;
            if (j->coverage[k].type == sum.type)
                for (int m = 0; m < COVERAGE_MESHES; m++) {
                    sum.series[m] += j->coverage[k].series[m];
                    sum.covered[m] += j->coverage[k].covered[m];
                }
        }
        if (before)
            continue;
        fprintf(to, "  %-24s", sum.type->name);
        for (int m = 0; m < COVERAGE_MESHES; m++)
            fprintf(to, "  %4d of %4d", sum.covered[m], sum.series[m]);
        fputc('\n', to);
    }
}

/* Published values that limits cannot be which agree with the truth; each is said once. */
static void contradictions(FILE *to, const sweep *s, const judgement *j)
{
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        int count = 0, before = 0;
        if (v->contradicted != NULL)
            for (int k = 0; k < j->verdicts; k++) {
                count += j->verdict[k].contradicted == v->contradicted;
                before |= k < i && j->verdict[k].contradicted == v->contradicted;
            }
        if (count == 0 || before)
            continue;
        const sweep_point *p = &s->point[s->series[v->series].point];
        fprintf(to, "\n%s", p->type->name);
        paragraph_say(
            to, (int)strlen(p->type->name), 2,
            "%s%s, %s: the published %.10g +- %.1g is contradicted by %d limits, the first "
            "%.10g (%s)",
            p->text[0] != '\0' ? ": " : "", p->text, v->contradicted->quantity,
            v->contradicted->value, v->contradicted->uncertainty, count, v->fit.limit,
            s->series[v->series].formulation.key);
    }
}

static int count_contradicted(const judgement *j)
{
    int count = 0;
    for (int i = 0; i < j->verdicts; i++) {
        int before = 0;
        for (int k = 0; k < i && j->verdict[i].contradicted != NULL; k++)
            before |= j->verdict[k].contradicted == j->verdict[i].contradicted;
        count += j->verdict[i].contradicted != NULL && !before;
    }
    return count;
}

void table_run_details(FILE *to, const sweep *s, const judgement *j)
{
    contradictions(to, s, j);
    failed_cells(to, s);
    coverage_lines(to, j);
}

/* "9705 pass; 75 undecided". */
static void print_kinds(FILE *to, const judgement *j)
{
    int parts = 0;
    for (int k = 0; k < VERDICT_KINDS; k++)
        if (j->by_kind[k] > 0 && k != VERDICT_SKIP && k != VERDICT_NO_TRUTH &&
            k != VERDICT_OTHER_MODEL)
            fprintf(to, "%s%d %s", parts++ > 0 ? "; " : " ", j->by_kind[k],
                    verdict_name((verdict_kind)k));
}

static void print_verdicts(FILE *to, const judgement *j)
{
    const struct {
        int count;
        const char *words;
    } more[] = {{j->by_kind[VERDICT_SKIP], "not offered (skip)"},
                {j->by_kind[VERDICT_OTHER_MODEL], "of another model"},
                {j->by_kind[VERDICT_NO_TRUTH], "without a truth"}};
    int parts = 0, left = 0;
    paragraph words;
    FILE *line = paragraph_begin(&words, to);
    fprintf(line, "%d verdict%s against truths%s", j->judged, j->judged == 1 ? "" : "s",
            j->judged > 0 ? ":" : "");
    print_kinds(line, j);
    for (int i = 0; i < 3; i++)
        left += more[i].count > 0;
    for (int i = 0; i < 3; i++) {
        if (more[i].count == 0)
            continue;
        fprintf(line, "%s %d %s",
                parts == 0          ? "; besides"
                : parts + 1 == left ? " and"
                                    : ",",
                more[i].count, more[i].words);
        parts++;
    }
    paragraph_end(&words, 0, 0);
}

void table_run(FILE *to, const sweep *s, const judgement *j, double seconds)
{
    const int contradicted = count_contradicted(j);
    fprintf(to, "%d cells, %d more for their noise, in %.3g s", sweep_cells(s), noise_cells(s),
            seconds);
    if (s->unfinished > 0)
        fprintf(to, s->partial ? "; %d more are missing" : "; interrupted, %d more were not done",
                s->unfinished);
    fputc('\n', to);
    print_verdicts(to, j);
    if (j->agreements > 0)
        fprintf(to, "%d of %d stored discrete values agree\n", j->agreements - j->disagreements,
                j->agreements);
    if (j->waiting > 0)
        fprintf(to, "%d truths wait for a formulation that offers what they need\n", j->waiting);
    if (j->unread > 0)
        fprintf(to,
                "%d truths of motions, at times and of structures that are not run here, are "
                "checked by "
                "make lab L=motions\n",
                j->unread);
    if (contradicted > 0)
        fprintf(
            to,
            "%d published values are contradicted by limits that agree with a better truth (-v)\n",
            contradicted);
}

void table_run_end(FILE *to, screen look, const char *sentence)
{
    const size_t word = strcspn(sentence, ":");
    char begin[32];
    if (sentence[0] == '\0')
        return;
    snprintf(begin, sizeof begin, "%.*s", (int)word, sentence);
    screen_put(to, look, strcmp(begin, "PASS") == 0 ? SCREEN_GOOD : SCREEN_BAD, begin);
    paragraph_write(to, (int)word, 0, sentence + word);
}
