#include "harness/comparison/comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/number.h"
#include "harness/study/sweep.h"

const char *const comparison_kind_names[COMPARISON_KINDS] = {"worse", "better", "changed", "gone", "new"};

status comparison_limits_parse(const char *text, comparison_limits *out, fault *f)
{
    const struct {
        const char *name;
        double *value;
    } known[] = {{"error", &out->error}, {"floor", &out->floor}, {"work", &out->work}};
    int given[sizeof known / sizeof known[0]] = {0}, more = 1;
    for (const char *at = text; more;) {
        const size_t length = strcspn(at, ","), name = strcspn(at, "=");
        double *value = NULL;
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
            if (name < length && strlen(known[i].name) == name && strncmp(known[i].name, at, name) == 0)
                value = given[i]++ == 0 ? known[i].value : NULL;
        const char *end = at;
        double number = -1;
        if (value == NULL || !number_read(at + name + 1, &end, &number) || end != at + length || number < 0)
            return fault_set(f, STATUS_REFUSED,
                             "threshold '%.40s': write error=R,floor=R,work=R, each once, with numbers that are not negative", at);
        *value = number;
        more = at[length] == ',';
        at += length + (size_t)more;
    }
    return STATUS_OK;
}

/* Where the lines go, and what they are counted in. */
typedef struct listing {
    FILE *to;
    const comparison_limits *limits;
    comparison *out;
    const result_cell *cell;
} listing;

static void heading(const listing *l, comparison_kind kind)
{
    l->out->count[kind]++;
    fprintf(l->to, "%-8s %s n=%d", comparison_kind_names[kind], l->cell->name, l->cell->elements);
}

static void compare_work(const listing *l, const result_cell *a, const result_cell *b)
{
    for (int k = 0; k < RESULTS_WORKS; k++) {
        const double before = (double)a->work[k], after = (double)b->work[k];
        l->out->work[0][k] += before;
        l->out->work[1][k] += after;
        if (fabs(after - before) <= l->limits->work * before)
            continue;
        heading(l, after > before ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %ld -> %ld", results_work_names[k], a->work[k], b->work[k]);
        fprintf(l->to, before > 0 ? " (%+.1f %%)\n" : "\n", 100 * (after - before) / before);
    }
}

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
        heading(l, isfinite(a->value) ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %s\n", a->quantity, isfinite(a->value) ? "has no value any more" : "has a value now");
    } else if (isfinite(a->error) && isfinite(b->error)) {
        const double change = fabs(b->error) - fabs(a->error);
        if (fabs(b->error - a->error) <= m->floor + m->error * fabs(a->error))
            return;
        heading(l, change > 0 ? CHANGE_WORSE : change < 0 ? CHANGE_BETTER : CHANGE_OTHER);
        fprintf(l->to, ": error of %s %+.3e -> %+.3e\n", a->quantity, a->error, b->error);
    } else if (isfinite(a->value) && fabs(b->value - a->value) > m->floor * fmax(fabs(a->value), a->near_zero)) {
        heading(l, CHANGE_OTHER);
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
        heading(l, CHANGE_GONE);
        fprintf(l->to, ": %s\n", a->value[i].quantity);
    }
    for (int i = 0; i < b->values; i++)
        if (value_named(a, i, b->value[i].quantity) == NULL) {
            heading(l, CHANGE_NEW);
            fprintf(l->to, ": %s\n", b->value[i].quantity);
        }
}

static void compare_summaries(const listing *l, const result_summary *a, const result_summary *b)
{
    const comparison_limits *m = l->limits;
    const double change = b->decades - a->decades, slack = log10(1 + m->error) + 1e-6 * b->judged;
    if (a->judged != b->judged) {
        heading(l, b->judged < a->judged ? CHANGE_WORSE : CHANGE_OTHER);
        fprintf(l->to, ": %d values have an error, %d had\n", b->judged, a->judged);
    } else if (fabs(b->worst - a->worst) > m->floor + m->error * a->worst) {
        heading(l, b->worst > a->worst ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": largest error %.3e (%s) -> %.3e (%s)\n", a->worst, a->quantity, b->worst, b->quantity);
    } else if (fabs(change) > slack) {
        heading(l, change > 0 ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": errors below the largest moved by %+.4f decades in all\n", change);
    }
}

static void compare_cells(const listing *l, const result_cell *a, const result_cell *b, int whole)
{
    l->out->cells++;
    if (strcmp(a->status, b->status) != 0) {
        heading(l, strcmp(b->status, "ok") == 0 ? CHANGE_BETTER : strcmp(a->status, "ok") == 0 ? CHANGE_WORSE : CHANGE_OTHER);
        fprintf(l->to, ": %s -> %s\n", a->status, b->status);
    }
    compare_work(l, a, b);
    if (whole)
        compare_values(l, a, b);
    else
        compare_summaries(l, &a->summary, &b->summary);
}

void comparison_run(FILE *to, const results *before, const results *after, const comparison_limits *limits, const char *select,
                    comparison *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0, k = 0; i < before->cells || k < after->cells;) {
        const int order = i == before->cells ? 1 : k == after->cells ? -1 : results_order(&before->cell[i], &after->cell[k]);
        const result_cell *a = order <= 0 ? &before->cell[i++] : NULL, *b = order >= 0 ? &after->cell[k++] : NULL;
        const listing l = {to, limits, out, a != NULL ? a : b};
        if (select != NULL && select_matches(select, l.cell->name) <= 0)
            continue;
        if (a != NULL && b != NULL) {
            compare_cells(&l, a, b, before->whole && after->whole);
        } else {
            heading(&l, a != NULL ? CHANGE_GONE : CHANGE_NEW);
            fputc('\n', to);
        }
    }
}

int comparison_differs(const comparison *c)
{
    int lines = 0;
    for (int k = 0; k < COMPARISON_KINDS; k++)
        lines += c->count[k];
    return lines > 0;
}
