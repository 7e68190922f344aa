#include "harness/terminal/table_solution.h"

#include <math.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table.h"
#include "harness/terminal/table_curves.h"
#include "harness/terminal/table_motion.h"
#include "harness/terminal/table_path.h"
#include "harness/terminal/table_stability.h"

enum { NAME = 28, VALUE = 20, UNIT = 9, DIGITS = 10, INDENT = 2 };
static const double least_rounding = 1e-11, /* of any value that is computed */
    noise = 1e-4;                           /* of round-off in the scale of values that are zero */

/* Analytic models beside the elements; they judge nothing. */
static void predictions(FILE *to, const sweep_point *p, const truths *t)
{
    for (int i = 0; i < p->scene.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        char name[SCENE_NAME + 16];
        if (q->prediction.source == NULL)
            continue;
        snprintf(name, sizeof name, "prediction %s", q->name);
        const int column = fprintf(to, "%-*s ", NAME, name) + VALUE + UNIT + 1 + 12 + 2;
        table_digits(to, VALUE, q->prediction.value, DIGITS);
        fprintf(to, " %-*s", UNIT, q->unit);
        table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
        fputs("  ", to);
        paragraph_say(to, column, INDENT, "%s, analytic", q->prediction.source);
    }
}

/* Has the quantity before it no value for the same reason? */
static int is_told(const solve_result *r, int index)
{
    return index > 0 && r->quantity[index - 1].status != STATUS_OK &&
           strcmp(r->quantity[index - 1].reason, r->quantity[index].reason) == 0;
}

/* What round-off and the mesh may change in a value. */
static double uncertainty_of(const scene *s, int index, const solve_result *r)
{
    const quantity_result *v = &r->quantity[index];
    const double scale = change_scale(s, index, r),
                 of_rounding =
                     fmax(fabs(v->value) * fmax(v->rounding, least_rounding), scale * noise),
                 of_mesh = fmax(fabs(v->value), scale) * v->change;
    return isfinite(of_mesh) ? fmax(of_rounding, of_mesh) : of_rounding;
}

/* To the digit that these leave. */
static void quantity_line(FILE *to, const sweep *s, const truths *t, int index)
{
    const series *one = &s->series[0];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[index];
    const quantity_result *v = &one->cell[0].solve.quantity[index];
    const truth *row = t != NULL ? verdict_truth(t, p, &one->formulation, index) : NULL;
    const int column = fprintf(to, "%-*s ", NAME, q->name) + VALUE + 1;
    if (v->status != STATUS_OK) {
        fprintf(to, "%*s ", VALUE, "-");
        paragraph_write(to, column, INDENT,
                        is_told(&one->cell[0].solve, index) ? "likewise" : v->reason);
        return;
    }
    table_known(to, VALUE, v->value, uncertainty_of(&p->scene, index, &one->cell[0].solve));
    fprintf(to, " %-*s", UNIT, q->unit);
    table_percent(to, row != NULL ? verdict_error(q, v->value, row->value) : NAN);
    fprintf(to, "%s%s", row != NULL ? " against " : "", row != NULL ? row->kind : "");
    fprintf(to, "%s%s", v->meaning[0] != '\0' ? ", " : "", v->meaning);
    const int passed = scene_is_passed(q, p->scene.analysis[q->analysis].kind);
    if (passed && (q->reduction == SCENE_MAX || q->reduction == SCENE_MIN))
        fprintf(to, ", at %.6g s", v->x);
    if (v->rounding > 1e-9)
        fprintf(to, ", %s %.1e", passed ? "between steps" : "round-off", v->rounding);
    fputc('\n', to);
}

/* Load steps that were chosen, and tries of longer ones. */
static void count_steps(const counters *c, char text[FAULT_TEXT])
{
    const char *plural = c->steps == 1 ? "" : "s";
    text[0] = '\0';
    if (c->rejected_steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld load step%s (%ld longer rejected)", c->steps, plural,
                 c->rejected_steps);
    else if (c->steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld load step%s", c->steps, plural);
}

/* Why curves end early. */
static void unfinished_curves(FILE *to, const sweep_point *p, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++) {
        const quantity_result *v = &r->quantity[i];
        if (p->scene.quantity[i].reduction != SCENE_CURVE || v->status == STATUS_OK)
            continue;
        const int column = fprintf(to, "%-*s %*s ", NAME, p->scene.quantity[i].name, VALUE, "-");
        paragraph_say(to, column, INDENT, "%s%s", is_told(r, i) ? "likewise" : v->reason,
                      v->curve.points > 0 ? "; the curve ends there" : "");
    }
}

void table_solution(FILE *to, const sweep *s, const truths *t)
{
    const series *one = &s->series[0];
    const sweep_point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    char steps[FAULT_TEXT], ends[FAULT_TEXT];
    table_series(to, s, 0);
    count_steps(&c->counters, steps);
    const int at = fprintf(to, "%s", status_name(c->solve.status));
    paragraph_say(to, at, INDENT,
                  "%s%s; %d elements, %d free coordinates, %ld iterations%s, "
                  "%ld factorisations, %.3g s set-up, %.3g s solution",
                  c->solve.reason[0] != '\0' ? ": " : "", c->solve.reason, c->size.elements,
                  c->size.free, c->counters.iterations, steps, c->counters.factorisations,
                  c->solve.seconds_setup, c->solve.seconds_solve);
    table_stability_paths(to, &p->scene, &c->solve);
    for (int i = 0; i < c->left_out_lines; i++)
        paragraph_write(to, fprintf(to, "eliminated: "), INDENT, c->left_out[i]);
    warping_ends(&p->scene, ends, sizeof ends);
    if (ends[0] != '\0')
        paragraph_write(to, fprintf(to, "warping: "), INDENT, ends);
    on_nodes(&p->scene, one->formulation.type, one->formulation.option, ends, sizeof ends);
    if (ends[0] != '\0')
        paragraph_write(to, fprintf(to, "lumped: "), INDENT, ends);
    table_omitted(to, p);
    table_theory(to, &p->scene, one->formulation.type);
    table_path_events(to, &c->solve);
    fprintf(to, "%-*s %*s %-*s %11s\n", NAME, "quantity", VALUE, "value", UNIT, "unit", "error");
    for (int i = 0; i < c->solve.quantities; i++)
        if (p->scene.quantity[i].reduction != SCENE_CURVE)
            quantity_line(to, s, t, i);
    predictions(to, p, t);
    unfinished_curves(to, p, &c->solve);
    table_curves_values(to, &p->scene, &c->solve);
    table_path_matrices(to, &p->scene, &c->solve);
    table_motion(to, &p->scene, &c->solve);
    table_path_steps(to, &c->solve);
}
