#include "harness/tables/table_solution.h"

#include <math.h>

#include "harness/tables/table.h"
#include "harness/tables/table_path.h"
#include "harness/truth/truth.h"

/* Analytic models beside the elements; they judge nothing. */
static void predictions(FILE *to, const point *p, const truths *t)
{
    for (int i = 0; i < p->scene.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        char name[SCENE_NAME + 16];
        if (q->prediction.source == NULL)
            continue;
        snprintf(name, sizeof name, "prediction %s", q->name);
        fprintf(to, "%-28s %24.15g %-10s", name, q->prediction.value, q->unit);
        table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
        fprintf(to, " %s, analytic\n", q->prediction.source);
    }
}

void table_solution(FILE *to, const sweep *s, const truths *t)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    table_series(to, s, 0);
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
    table_path_events(to, &c->solve);
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
        table_percent(to, row != NULL ? verdict_error(q, v->value, row->value) : NAN);
        fprintf(to, "%s%s", row != NULL ? " against " : "", row != NULL ? row->kind : "");
        if (v->rounding > 1e-9)
            fprintf(to, ", round-off %.1e", v->rounding);
        fputc('\n', to);
    }
    predictions(to, p, t);
    table_path_matrices(to, &c->solve);
    table_path_steps(to, &c->solve);
}
