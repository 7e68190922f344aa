#include "harness/tables/table_verdicts.h"

#include <math.h>
#include <string.h>

#include "harness/tables/table.h"

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
    fputc('\n', to);
    table_point(to, p);
    fprintf(to, "\n  %-*s %-*s %15s %15s %5s %15s %10s  %s\n", w.formulation, "formulation",
            w.quantity, "quantity", "finest mesh", "limit", "order", "truth", "error", "verdict");
}

static void verdict_line(FILE *to, const sweep *s, const verdict *v, widths w)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    fprintf(to, "  %-*s %-*s ", w.formulation, one->formulation.key, w.quantity, q->name);
    table_value(to, 15, 9, 'g', v->finest);
    fputc(' ', to);
    table_value(to, 15, 9, 'g', v->fit.limit);
    table_value(to, 6, 2, 'f', v->fit.order);
    fputc(' ', to);
    table_value(to, 15, 9, 'g', v->truth != NULL ? v->truth->value : NAN);
    table_percent(to, v->error);
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

void table_verdicts(FILE *to, const sweep *s, const judgement *j)
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
}
