#include "harness/tables/table_convergence.h"

#include <math.h>

#include "harness/judge/sentence.h"
#include "harness/tables/table.h"

/* Analytic model beside the elements. */
static void prediction_line(FILE *to, const scene_quantity *q, const truth *row)
{
    fprintf(to, "  prediction%21.14g", q->prediction.value);
    table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
    fprintf(to, " %s, analytic\n", q->prediction.source);
}

static void mesh_line(FILE *to, const series *one, int mesh, int quantity, const scene_quantity *q,
                      const truth *row)
{
    const solve_result *r = &one->cell[mesh].solve;
    const int known = quantity < r->quantities;
    const double x = known ? r->quantity[quantity].value : NAN;
    fprintf(to, "  %6d", one->mesh[mesh]);
    table_value(to, 23, 14, 'g', x);
    table_percent(to, row != NULL ? verdict_error(q, x, row->value) : NAN);
    fprintf(to, " %10.3g s", r->seconds_setup + r->seconds_solve);
    if (!isfinite(x))
        fprintf(to, "  %s", known ? r->quantity[quantity].reason : r->reason);
    fputc('\n', to);
}

static void limit_line(FILE *to, const verdict *v, const scene_quantity *q, const truth *row)
{
    char sentence[2 * FAULT_TEXT];
    fprintf(to, "  limit ");
    table_value(to, 22, 14, 'g', v->fit.limit);
    fprintf(to, " +- ");
    table_value(to, 1, 1, 'e', v->fit.limit_uncertainty);
    fprintf(to, ", order ");
    table_value(to, 1, 3, 'f', v->fit.order);
    sentence_of_verdict(v, q->least_order, sentence, sizeof sentence);
    if (row != NULL)
        fprintf(to, ", %s %.14g: %s", row->kind, row->value, sentence);
    fputc('\n', to);
}

static void quantity_block(FILE *to, const sweep *s, const truths *t, int index, int quantity)
{
    const series *one = &s->series[index];
    const point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[quantity];
    const truth *row = verdict_reference(t, p, &one->formulation, quantity);
    verdict v = {.series = index, .quantity = quantity};
    fprintf(to, "  %s [%s]\n", q->name, q->unit);
    for (int k = 0; k < one->meshes; k++)
        mesh_line(to, one, k, quantity, q, row);
    verdict_reach(s, t, &v);
    limit_line(to, &v, q, row);
    if (q->prediction.source != NULL)
        prediction_line(to, q, row);
}

void table_convergence(FILE *to, const sweep *s, const truths *t)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const scene *wanted = &s->point[one->point].scene;
        table_series(to, s, i);
        if (one->missing[0] != '\0') {
            fprintf(to, "  skip: does not offer %s\n", one->missing);
            continue;
        }
        for (int q = 0; q < wanted->quantities; q++)
            if (wanted->quantity[q].reduction != SCENE_CURVE)
                quantity_block(to, s, t, i, q);
    }
}
