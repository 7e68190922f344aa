/* Two series side by side where one of them is known by its row of the short table only. */
#include <math.h>
#include <string.h>

#include "harness/records/comparison_lines.h"
#include "harness/records/results_table.h"

/* Relative to a number written with so many digits: how far it may be from what it was. */
static double last_digit(int digits)
{
    return 0.5 * pow(10, 1 - digits);
}

/* A line for each mesh whose status has changed or that is in one of them only; 1: they have the
 * same meshes. */
static int compare_meshes(const listing *l, const result_series *a, const result_series *b)
{
    int same = 1;
    for (int i = 0, k = 0; i < a->meshes || k < b->meshes;) {
        const result_mesh *old = i < a->meshes ? &a->mesh[i] : NULL;
        const result_mesh *new = k < b->meshes ? &b->mesh[k] : NULL;
        if (old != NULL && new != NULL && old->elements != new->elements)
            *(old->elements < new->elements ? &new : &old) = NULL;
        listing here = *l;
        here.elements = old != NULL ? old->elements : new->elements;
        if (old != NULL && new != NULL)
            comparison_lines_status(&here, old->status, new->status);
        else
            comparison_lines_lone(&here, old != NULL ? CHANGE_GONE : CHANGE_NEW);
        same = same && old != NULL && new != NULL;
        i += old != NULL;
        k += new != NULL;
    }
    return same;
}

/* 1: it has moved. */
static int compare_error(const listing *l, const char *which, const result_error *a,
                         const result_error *b)
{
    const comparison_limits *m = l->limits;
    if (fabs(b->size - a->size) <=
        m->floor + (m->error + last_digit(RESULTS_ERROR_DIGITS)) * a->size)
        return 0;
    comparison_lines_heading(l, b->size > a->size ? CHANGE_WORSE : CHANGE_BETTER);
    fprintf(l->to, ": %s error %.4g %% (%s n=%d) -> %.4g %% (%s n=%d)\n", which, 100 * a->size,
            a->quantity, a->elements, 100 * b->size, b->quantity, b->elements);
    return 1;
}

static void compare_errors(const listing *l, const result_series *a, const result_series *b)
{
    const double change = b->decades - a->decades;
    const double slack = log10(1 + l->limits->error) + pow(10, -RESULTS_DECADES_DECIMALS);
    if (a->errors != b->errors) {
        comparison_lines_heading(l, b->errors < a->errors ? CHANGE_WORSE : CHANGE_OTHER);
        fprintf(l->to, ": %d values have an error, %d had\n", b->errors, a->errors);
        return;
    }
    const int largest = compare_error(l, "largest", &a->largest, &b->largest);
    const int least = compare_error(l, "least", &a->least, &b->least);
    if (largest || least || fabs(change) <= slack)
        return;
    comparison_lines_heading(l, change > 0 ? CHANGE_WORSE : CHANGE_BETTER);
    fprintf(l->to, ": errors between the least and the largest moved by %+.4f decades in all\n",
            change);
}

static const result_limit *limit_named(const result_series *s, const char *quantity)
{
    for (int i = 0; i < s->limits; i++)
        if (strcmp(s->limit[i].quantity, quantity) == 0)
            return &s->limit[i];
    return NULL;
}

static void compare_limits(const listing *l, const result_series *a, const result_series *b)
{
    for (int i = 0; i < a->limits; i++) {
        const result_limit *old = &a->limit[i], *new = limit_named(b, old->quantity);
        if (new == NULL && !results_part_selects(&l->after->part, l->name, old->quantity))
            continue;
        if (new == NULL) {
            comparison_lines_heading(l, CHANGE_WORSE);
            fprintf(l->to, ": %s has no limit any more\n", old->quantity);
            continue;
        }
        const double scale = fmax(fabs(old->value), fmax(old->near_zero, new->near_zero));
        const double slack =
            l->limits->floor * scale + last_digit(RESULTS_LIMIT_DIGITS) * fabs(old->value);
        if (fabs(new->value - old->value) <= slack)
            continue;
        comparison_lines_heading(l, CHANGE_OTHER);
        fprintf(l->to, ": limit of %s %.10g -> %.10g\n", old->quantity, old->value, new->value);
    }
    for (int i = 0; i < b->limits; i++)
        if (limit_named(a, b->limit[i].quantity) == NULL &&
            results_part_selects(&l->before->part, l->name, b->limit[i].quantity)) {
            comparison_lines_heading(l, CHANGE_BETTER);
            fprintf(l->to, ": %s has a limit now\n", b->limit[i].quantity);
        }
}

void comparison_series(const listing *l, const result_series *a, const result_series *b)
{
    if (compare_meshes(l, a, b)) { /* sums over other meshes say nothing */
        if (results_part_differ(l->before, l->after, l->name)) {
            l->out->partial++; /* errors and work are those of what is selected only */
        } else {
            comparison_lines_work(l, a->work, b->work, a->meshes);
            compare_errors(l, a, b);
        }
    }
    if (l->out->judged)
        compare_limits(l, a, b);
}
