/* Two meshes of whole runs side by side, every quantity by itself. */
#include <math.h>
#include <string.h>

#include "harness/records/comparison_lines.h"

static const result_value *value_named(const result_cell *c, int near, const char *quantity)
{
    if (near < c->values && strcmp(c->value[near].quantity, quantity) == 0)
        return &c->value[near];
    for (int i = 0; i < c->values; i++)
        if (strcmp(c->value[i].quantity, quantity) == 0)
            return &c->value[i];
    return NULL;
}

/* Errors are judged by their size; a value without a truth can only have changed. */
static void compare_value(const listing *l, const result_value *a, const result_value *b)
{
    const comparison_limits *m = l->limits;
    if (isfinite(a->value) != isfinite(b->value)) {
        comparison_lines_heading(l, isfinite(a->value) ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %s\n", a->quantity,
                isfinite(a->value) ? "has no value any more" : "has a value now");
    } else if (isfinite(a->error) && isfinite(b->error)) {
        const double change = fabs(b->error) - fabs(a->error);
        if (fabs(b->error - a->error) <= m->floor + m->error * fabs(a->error))
            return;
        comparison_kind kind = CHANGE_OTHER;
        if (change != 0)
            kind = change > 0 ? CHANGE_WORSE : CHANGE_BETTER;
        comparison_lines_heading(l, kind);
        fprintf(l->to, ": error of %s %+.4g %% -> %+.4g %%\n", a->quantity, 100 * a->error,
                100 * b->error);
    } else if (isfinite(a->value) &&
               fabs(b->value - a->value) > m->floor * fmax(fabs(a->value), a->near_zero)) {
        comparison_lines_heading(l, CHANGE_OTHER);
        fprintf(l->to, ": %s %.12g -> %.12g\n", a->quantity, a->value, b->value);
    }
}

static void compare_values(const listing *l, const result_cell *a, const result_cell *b)
{
    for (int i = 0; i < a->values; i++) {
        const result_value *other = value_named(b, i, a->value[i].quantity);
        if (other != NULL) {
            compare_value(l, &a->value[i], other);
            continue;
        }
        if (!results_part_selects(&l->after->part, l->name, a->value[i].quantity))
            continue;
        comparison_lines_heading(l, CHANGE_GONE);
        fprintf(l->to, ": %s\n", a->value[i].quantity);
    }
    for (int i = 0; i < b->values; i++)
        if (value_named(a, i, b->value[i].quantity) == NULL &&
            results_part_selects(&l->before->part, l->name, b->value[i].quantity)) {
            comparison_lines_heading(l, CHANGE_NEW);
            fprintf(l->to, ": %s\n", b->value[i].quantity);
        }
}

void comparison_cells(const listing *l, const result_cell *a, const result_cell *b)
{
    comparison_lines_status(l, a->status, b->status);
    if (l->before->swept)
        comparison_lines_cost(l, a->cost, b->cost);
    else if (!results_part_differ(l->before, l->after,
                                  l->name)) /* work is that of what is asked for */
        comparison_lines_work(l, a->work, b->work, 1);
    compare_values(l, a, b);
}
