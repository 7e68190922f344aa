#include "harness/record/table.h"

#include <math.h>
#include <string.h>

#include "harness/judge/sentence.h"
#include "harness/record/table_path.h"
#include "harness/study/noise.h"
#include "harness/truth/truth.h"

static void row_of_series(FILE *to, const sweep *s, int index)
{
    const series *one = &s->series[index];
    const point *p = &s->point[one->point];
    fprintf(to, "%s%s%s%s, %s\n", p->type->name, p->text[0] != '\0' ? " (" : "", p->text,
            p->text[0] != '\0' ? ")" : "", one->formulation.key);
}

static void percent(FILE *to, double error)
{
    if (!isfinite(error))
        fprintf(to, "%11s", "-");
    else if (fabs(error) >= 1e-4)
        fprintf(to, " %+9.4f%%", 100 * error);
    else
        fprintf(to, " %+10.1e", error);
}

/* printf's conversion 'g', 'e' or 'f' in a field of `width`. */
static void value_or_dash(FILE *to, int width, int digits, char conversion, double value)
{
    if (!isfinite(value))
        fprintf(to, "%*s", width, "-");
    else if (conversion == 'g')
        fprintf(to, "%*.*g", width, digits, value);
    else if (conversion == 'e')
        fprintf(to, "%*.*e", width, digits, value);
    else
        fprintf(to, "%*.*f", width, digits, value);
}

/* Analytic models beside the elements; they judge nothing. */
static void table_predictions(FILE *to, const point *p, const truths *t)
{
    for (int i = 0; i < p->scene.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        char name[SCENE_NAME + 16];
        if (q->prediction.source == NULL)
            continue;
        snprintf(name, sizeof name, "prediction %s", q->name);
        fprintf(to, "%-28s %24.15g %-10s", name, q->prediction.value, q->unit);
        percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
        fprintf(to, " %s, analytic\n", q->prediction.source);
    }
}

void table_solution(FILE *to, const sweep *s, const truths *t)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    row_of_series(to, s, 0);
    fprintf(to,
            "%s%s%s; %d elements, %d free coordinates, %ld iterations, %ld factorisations, %.3g s "
            "set-up, %.3g s solution\n",
            status_name(c->solve.status), c->solve.reason[0] != '\0' ? ": " : "", c->solve.reason,
            c->size.elements, c->size.free, c->counters.iterations, c->counters.factorisations,
            c->solve.seconds_setup, c->solve.seconds_solve);
    if (c->counters.negative_pivots > 0)
        fprintf(to,
                "unstable: up to %ld negative pivots of the tangent at a state that was reached\n",
                c->counters.negative_pivots);
    for (int i = 0; i < c->left_out_lines; i++)
        fprintf(to, "left out: %s\n", c->left_out[i]);
    table_events(to, &c->solve);
    fprintf(to, "%-28s %24s %-10s %11s\n", "quantity", "value", "unit", "error");
    for (int i = 0; i < c->solve.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const quantity_result *v = &c->solve.quantity[i];
        const truth *row = t != NULL ? verdict_truth(t, p, &one->formulation, i) : NULL;
        if (q->reduction == SCENE_CURVE)
            continue;
        if (v->status != STATUS_OK) {
            fprintf(to, "%-28s %24s %s\n", q->name, "-", v->reason);
            continue;
        }
        fprintf(to, "%-28s %24.15g %-10s", q->name, v->value, q->unit);
        percent(to, row != NULL ? verdict_error(q, v->value, row->value) : NAN);
        fprintf(to, "%s%s", row != NULL ? " against " : "", row != NULL ? row->kind : "");
        if (v->rounding > 1e-9)
            fprintf(to, ", round-off %.1e", v->rounding);
        fputc('\n', to);
    }
    table_predictions(to, p, t);
    table_matrices(to, &c->solve);
    table_steps(to, &c->solve);
}

void table_convergence(FILE *to, const sweep *s, const truths *t)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const point *p = &s->point[one->point];
        row_of_series(to, s, i);
        if (one->missing[0] != '\0') {
            fprintf(to, "  skip: does not offer %s\n", one->missing);
            continue;
        }
        for (int q = 0; q < p->scene.quantities; q++) {
            const truth *row = verdict_reference(t, p, &one->formulation, q);
            verdict v = {.series = i, .quantity = q};
            if (p->scene.quantity[q].reduction == SCENE_CURVE)
                continue;
            fprintf(to, "  %s [%s]\n", p->scene.quantity[q].name, p->scene.quantity[q].unit);
            for (int k = 0; k < one->meshes; k++) {
                const solve_result *r = &one->cell[k].solve;
                const double x = q < r->quantities ? r->quantity[q].value : NAN;
                fprintf(to, "  %6d", one->mesh[k]);
                value_or_dash(to, 23, 14, 'g', x);
                percent(to,
                        row != NULL ? verdict_error(&p->scene.quantity[q], x, row->value) : NAN);
                fprintf(to, " %10.3g s", r->seconds_setup + r->seconds_solve);
                if (!isfinite(x))
                    fprintf(to, "  %s", q < r->quantities ? r->quantity[q].reason : r->reason);
                fputc('\n', to);
            }
            char sentence[2 * FAULT_TEXT];
            verdict_reach(s, t, &v);
            fprintf(to, "  limit ");
            value_or_dash(to, 22, 14, 'g', v.fit.limit);
            fprintf(to, " +- ");
            value_or_dash(to, 1, 1, 'e', v.fit.limit_uncertainty);
            fprintf(to, ", order ");
            value_or_dash(to, 1, 3, 'f', v.fit.order);
            sentence_of_verdict(&v, p->scene.quantity[q].least_order, sentence, sizeof sentence);
            if (row != NULL)
                fprintf(to, ", %s %.14g: %s", row->kind, row->value, sentence);
            fputc('\n', to);
            if (p->scene.quantity[q].prediction.source != NULL) {
                fprintf(to, "  prediction%21.14g", p->scene.quantity[q].prediction.value);
                percent(to, row != NULL
                                ? verdict_error(&p->scene.quantity[q],
                                                p->scene.quantity[q].prediction.value, row->value)
                                : NAN);
                fprintf(to, " %s, analytic\n", p->scene.quantity[q].prediction.source);
            }
        }
    }
}

/* Widths of the first two columns of one point's block. */
typedef struct widths {
    int formulation, quantity;
} widths;

static int longer(int width, const char *text)
{
    return (int)strlen(text) > width ? (int)strlen(text) : width;
}

static widths widths_of(const sweep *s, const judgement *j, int first)
{
    widths w = {12, 12};
    const int here = s->series[j->verdict[first].series].point;
    for (int i = first; i < j->verdicts && s->series[j->verdict[i].series].point == here; i++) {
        w.formulation = longer(w.formulation, s->series[j->verdict[i].series].formulation.key);
        w.quantity = longer(w.quantity, s->point[here].scene.quantity[j->verdict[i].quantity].name);
    }
    return w;
}

static void point_heading(FILE *to, const point *p, widths w)
{
    fprintf(to, "\n%s%s%s\n", p->type->name, p->text[0] != '\0' ? ": " : "", p->text);
    fprintf(to, "  %-*s %-*s %15s %15s %5s %15s %10s  %s\n", w.formulation, "formulation",
            w.quantity, "quantity", "finest mesh", "limit", "order", "truth", "error", "verdict");
}

static void verdict_line(FILE *to, const sweep *s, const verdict *v, widths w)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    fprintf(to, "  %-*s %-*s ", w.formulation, one->formulation.key, w.quantity, q->name);
    value_or_dash(to, 15, 9, 'g', v->finest);
    fputc(' ', to);
    value_or_dash(to, 15, 9, 'g', v->fit.limit);
    value_or_dash(to, 6, 2, 'f', v->fit.order);
    fputc(' ', to);
    value_or_dash(to, 15, 9, 'g', v->truth != NULL ? v->truth->value : NAN);
    percent(to, v->error);
    fprintf(to, "  %s", verdict_name(v->kind));
    if (!v->matches)
        fprintf(to, "  << expected %s",
                v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    else if (v->rule != NULL)
        fprintf(to, ", %s", v->rule->name);
    if (isfinite(v->model_error))
        fprintf(to, "; %+.3g %% from %s (%s)", 100 * v->model_error,
                strcmp(v->model_truth->kind, "agreement") == 0 ? "where families agree"
                                                               : "another model",
                v->model_truth->kind);
    fputc('\n', to);
    if (v->reason[0] != '\0')
        fprintf(to, "  %*s %.200s\n", w.formulation, "", v->reason);
}

static void disagreements(FILE *to, const sweep *s, const judgement *j)
{
    for (int i = 0; i < j->agreements; i++) {
        const agreement *a = &j->agreement[i];
        const series *one = &s->series[a->series];
        const point *p = &s->point[one->point];
        if (!a->good)
            fprintf(to, "\n%s%s%s, %s, n = %d, %s: %.12g differs from the stored %.12g\n",
                    p->type->name, p->text[0] != '\0' ? ": " : "", p->text, one->formulation.key,
                    one->mesh[a->mesh], p->scene.quantity[a->quantity].name, a->value,
                    a->truth->value);
    }
}

static void cells_that_contradict_themselves(FILE *to, const sweep *s, const judgement *j)
{
    for (int i = 0; i < j->flaws; i++) {
        const flaw *c = &j->flaw[i];
        const series *one = &s->series[c->series];
        const point *p = &s->point[one->point];
        fprintf(to, "\n%s%s%s, %s, n = %d contradicts itself: %s\n", p->type->name,
                p->text[0] != '\0' ? ": " : "", p->text, one->formulation.key, one->mesh[c->mesh],
                c->why);
    }
}

/* What a whole run should have met and did not. */
static void not_met(FILE *to, const judgement *j, const truths *t)
{
    if (j->unobserved > 0)
        for (int i = 0; i < t->rules; i++)
            if (!rule_is_observed(&t->rule[i]))
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
        const point *p = &s->point[s->series[v->series].point];
        int count = 0, before = 0;
        if (v->contradicted != NULL)
            for (int k = 0; k < j->verdicts; k++) {
                count += j->verdict[k].contradicted == v->contradicted;
                before |= k < i && j->verdict[k].contradicted == v->contradicted;
            }
        if (count > 0 && !before)
            fprintf(to,
                    "\n%s%s%s, %s: the published %.10g +- %.1g is contradicted by %d limits, the "
                    "first %.10g (%s)\n",
                    p->type->name, p->text[0] != '\0' ? ": " : "", p->text,
                    v->contradicted->quantity, v->contradicted->value, v->contradicted->uncertainty,
                    count, v->fit.limit, s->series[v->series].formulation.key);
    }
}

void table_verdicts(FILE *to, const sweep *s, const judgement *j, const truths *t)
{
    int last_point = -1, last_series = -1;
    widths w = {0, 0};
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const series *one = &s->series[v->series];
        if (one->point != last_point) {
            w = widths_of(s, j, i);
            point_heading(to, &s->point[one->point], w);
        }
        if (v->kind != VERDICT_SKIP)
            verdict_line(to, s, v, w);
        else if (v->series != last_series)
            fprintf(to, "  %-*s skip: %s\n", w.formulation, one->formulation.key, v->reason);
        last_point = one->point;
        last_series = v->series;
    }
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
