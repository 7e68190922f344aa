#include "harness/tables/table_run.h"

#include "harness/study/noise.h"
#include "harness/tables/table.h"

static void disagreements(FILE *to, const sweep *s, const judgement *j)
{
    for (int i = 0; i < j->agreements; i++) {
        const agreement *a = &j->agreement[i];
        const series *one = &s->series[a->series];
        const point *p = &s->point[one->point];
        if (a->good)
            continue;
        fputc('\n', to);
        table_point(to, p);
        fprintf(to, ", %s, n = %d, %s: %.12g differs from the stored %.12g\n", one->formulation.key,
                one->mesh[a->mesh], p->scene.quantity[a->quantity].name, a->value, a->truth->value);
    }
}

static void cells_that_contradict_themselves(FILE *to, const sweep *s, const judgement *j)
{
    for (int i = 0; i < j->flaws; i++) {
        const flaw *c = &j->flaw[i];
        const series *one = &s->series[c->series];
        fputc('\n', to);
        table_point(to, &s->point[one->point]);
        fprintf(to, ", %s, n = %d contradicts itself: %s\n", one->formulation.key,
                one->mesh[c->mesh], c->why);
    }
}

/* What a whole run should have met and did not. */
static void not_met(FILE *to, const judgement *j, const truths *t)
{
    if (j->unobserved > 0)
        for (int i = 0; i < t->rules; i++)
            if (!rules_is_observed(&t->rule[i]))
                fprintf(to, "\nfinding %s %s (%s; %s; %s)\n", t->rule[i].name,
                        t->rule[i].observed == 0 ? "was not observed"
                                                 : "names a prediction that no verdict met",
                        t->rule[i].formulations, t->rule[i].cases, t->rule[i].quantities);
    if (j->unmet > 0)
        for (int i = 0; i < t->rows; i++) {
            const truth *row = &t->row[i];
            char text[PARAMETERS_TEXT];
            if (row->met ||
                (row->formulation[0] != '\0' && formulation_find(row->formulation) == NULL))
                continue;
            parameters_text(row->type, row->parameter, text, sizeof text);
            fprintf(to, "\ntruth of nothing that exists: %s %s, %s%s%s (%s)\n", row->type->name,
                    text, row->quantity, row->formulation[0] != '\0' ? ", " : "", row->formulation,
                    row->source);
        }
    if (j->unmet > 0 && t->strangers > 0)
        fprintf(to, "\ntruths of %d unknown cases, the first: %s\n", t->strangers, t->stranger);
}

/* Cells that have no solution, also where finer meshes have one and decide the verdict. */
static void failed_cells(FILE *to, const sweep *s)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            for (int k = 0; k < s->series[i].meshes; k++) {
                const series *one = &s->series[i];
                const solve_result *r = &one->cell[k].solve;
                if (r->status == STATUS_OK)
                    continue;
                if (count++ == 0)
                    fprintf(to, "\ncells without a solution\n");
                fprintf(to, "  %s, %s, n = %d: %s: %.110s\n", s->point[one->point].type->name,
                        one->formulation.key, one->mesh[k], status_name(r->status), r->reason);
            }
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
        fputc('\n', to);
        table_point(to, &s->point[s->series[v->series].point]);
        fprintf(to,
                ", %s: the published %.10g +- %.1g is contradicted by %d limits, the first %.10g "
                "(%s)\n",
                v->contradicted->quantity, v->contradicted->value, v->contradicted->uncertainty,
                count, v->fit.limit, s->series[v->series].formulation.key);
    }
}

void table_run(FILE *to, const sweep *s, const judgement *j, const truths *t)
{
    disagreements(to, s, j);
    cells_that_contradict_themselves(to, s, j);
    contradictions(to, s, j);
    failed_cells(to, s);
    not_met(to, j, t);
    coverage_lines(to, j);
    fprintf(to, "\n%d cells, %d more for their noise; ", sweep_cells(s), noise_cells(s));
    if (s->unfinished > 0)
        fprintf(to, "interrupted, %d more were not done; ", s->unfinished);
    fprintf(to, "%d verdicts against truths:", j->judged);
    for (int k = 0; k < VERDICT_KINDS; k++)
        fprintf(to, "%s %d %s", k > 0 ? ";" : "", j->by_kind[k], verdict_name((verdict_kind)k));
    fprintf(to,
            "\n%d of %d stored discrete values agree; %d verdicts differ from the expected one; %d "
            "findings not observed\n",
            j->agreements - j->disagreements, j->agreements, j->unexpected, j->unobserved);
    if (j->flaws > 0)
        fprintf(to, "%d cells contradict themselves\n", j->flaws);
    if (j->unmet + j->waiting > 0)
        fprintf(to,
                "%d truths speak of nothing that exists; %d wait for a formulation that offers "
                "what they need\n",
                j->unmet, j->waiting);
}
