#include "harness/terminal/table_convergence.h"

#include <math.h>

#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table.h"
#include "harness/terminal/table_curves.h"
#include "harness/terminal/table_stability.h"

enum { CONVERGENCE_DIGITS = 10, VALUE = 20 };

/* Analytic model beside the elements. */
static void prediction_line(FILE *to, const scene_quantity *q, const truth *row)
{
    char source[FAULT_TEXT];
    int column = fprintf(to, "  prediction");
    table_digits(to, VALUE - 4, q->prediction.value, CONVERGENCE_DIGITS);
    table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
    snprintf(source, sizeof source, "%s, analytic", q->prediction.source);
    column += VALUE - 4 + 12 + fprintf(to, "  ");
    paragraph_write(to, column, 4, source);
}

static void mesh_line(FILE *to, const series *one, int mesh, int quantity, const scene_quantity *q,
                      const truth *row)
{
    const solve_result *r = &one->cell[mesh].solve;
    const int known = quantity < r->quantities;
    const double x = known ? r->quantity[quantity].value : NAN;
    char seconds[ROUNDING_TEXT];
    int column = fprintf(to, "  %6d", one->mesh[mesh]) + VALUE + 12;
    table_digits(to, VALUE, x, CONVERGENCE_DIGITS);
    table_percent(to, row != NULL ? verdict_error(q, x, row->value) : NAN);
    rounding_digits(r->seconds_setup + r->seconds_solve, 3, seconds);
    column += fprintf(to, " %9s s", seconds);
    if (!isfinite(x))
        paragraph_say(to, column, column + 2, "%s",
                      known ? r->quantity[quantity].reason : r->reason);
    else
        fputc('\n', to);
}

static void limit_line(FILE *to, const verdict *v, const scene_quantity *q, const truth *row)
{
    char sentence[2 * FAULT_TEXT], limit[ROUNDING_TEXT], doubt[ROUNDING_TEXT],
        known[ROUNDING_TEXT] = "", order[ROUNDING_TEXT];
    sentence_of_verdict(v, q->least_order, sentence, sizeof sentence);
    rounding_known(v->fit.limit, v->fit.limit_uncertainty, limit);
    rounding_digits(v->fit.limit_uncertainty, 2, doubt);
    rounding_digits(v->fit.order, 3, order);
    if (row != NULL)
        rounding_known(row->value, row->uncertainty, known);
    const int at = fprintf(to, "  limit ");
    if (row != NULL)
        paragraph_say(to, at, 4, "%s +- %s, order %s; %s %s: %s", limit, doubt, order, row->kind,
                      known, sentence);
    else
        paragraph_say(to, at, 4, "%s +- %s, order %s", limit, doubt, order);
}

static void quantity_block(FILE *to, const sweep *s, const truths *t, int index, int quantity)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
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
    for (int i = 0; i < s->points; i++)
        table_omitted(to, &s->point[i]);
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const scene *wanted = &s->point[one->point].scene;
        table_series(to, s, i);
        if (one->missing[0] != '\0') {
            paragraph_say(to, 0, 2, "skip: does not offer %s", one->missing);
            continue;
        }
        table_theory(to, wanted, one->formulation.type);
        for (int q = 0; q < wanted->quantities; q++)
            if (wanted->quantity[q].reduction != SCENE_CURVE)
                quantity_block(to, s, t, i, q);
    }
    if (s->points > 0)
        table_curves_errors(to, s);
    table_stability_meshes(to, s);
}
