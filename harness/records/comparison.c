#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

static void comparison_lines_heading(const listing *l, comparison_kind kind);
/* The allowed change of a sum is the threshold times the mean work of a mesh. */
static void comparison_lines_work(const listing *l, const long before[RESULTS_WORKS],
                                  const long after[RESULTS_WORKS], int meshes);
static void comparison_lines_cost(const listing *l, double before, double after);
static void comparison_cells(const listing *l, const result_cell *a, const result_cell *b);
static void comparison_sweeps(const listing *l, const char *select);

const comparison_limits comparison_limits_default = {0.01, RESULTS_FLOOR, 0.02};

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
            if (name < length && strlen(known[i].name) == name &&
                strncmp(known[i].name, at, name) == 0)
                value = given[i]++ == 0 ? known[i].value : NULL;
        const char *end = at;
        double number = -1;
        if (value == NULL || !number_read(at + name + 1, &end, &number) || end != at + length ||
            number < 0)
            return fault_set(f, STATUS_REFUSED,
                             "--threshold '%.40s' is not valid; give each name at most once, with "
                             "a number of at least 0, such as error=0.01,floor=1e-8,work=0.02",
                             at);
        *value = number;
        more = at[length] == ',';
        at += length + (size_t)more;
    }
    return STATUS_OK;
}

static int selected(const char *select, const char *name)
{
    return select == NULL || select_matches(select, name) > 0;
}

static void report_foreign(const listing *l, int which, const char **last)
{
    const char *instead = results_part_instead(which == 0 ? l->after : l->before,
                                               which == 0 ? l->before : l->after, l->name);
    listing here = *l;
    if (*last != NULL && strcmp(*last, l->name) == 0)
        return;
    *last = l->name;
    here.elements = 0;
    comparison_lines_heading(&here, which == 0 ? CHANGE_MISSING : CHANGE_NEW);
    if (which == 0 && instead != NULL)
        fprintf(l->to,
                ": was the program renamed to '%.80s'? If so, write the version in '# version:' of "
                "the imported file, not in '# program:'",
                instead);
    else if (which == 0)
        fputs(": add the file with --imported (your own element with --element), or accept the new "
              "run",
              l->to);
    fputc('\n', l->to);
}

static int has_series(const stored_results *r, const char *name)
{
    for (int i = 0; i < r->seriess; i++)
        if (strcmp(r->series[i].name, name) == 0)
            return 1;
    return 0;
}

/* Handles a series, or a mesh of a series (elements > 0), that exists in only one run. which: 0 for
 * the old run, 1 for the new run. *last: last series that was counted. Series are visited in the
 * order of their names. */
static void report_lone(const listing *l, int which, const char **last)
{
    const stored_results *here = which == 0 ? l->before : l->after,
                         *other = which == 0 ? l->after : l->before;
    int *count = NULL;
    if (!results_part_needs(other, here, l->name))
        count = &l->out->outside[which];
    else if (results_part_is_fresh(&here->part, l->name))
        count = &l->out->fresh[which];
    if (count == NULL && results_part_is_foreign(l->name) && !has_series(other, l->name)) {
        report_foreign(l, which, last);
        return;
    }
    if (count == NULL) {
        comparison_lines_lone(l, which == 0 ? CHANGE_MISSING : CHANGE_NEW);
        return;
    }
    *count += *last == NULL || strcmp(*last, l->name) != 0;
    *last = l->name;
}

static void run_cells(listing l, const stored_results *before, const stored_results *after,
                      const char *select)
{
    const char *last = NULL;
    for (int i = 0, k = 0; i < before->cells || k < after->cells;) {
        int order = i == before->cells ? 1 : -1;
        if (i < before->cells && k < after->cells)
            order = results_order(&before->cell[i], &after->cell[k]);
        const result_cell *a = order <= 0 ? &before->cell[i++] : NULL;
        const result_cell *b = order >= 0 ? &after->cell[k++] : NULL;
        l.name = a != NULL ? a->name : b->name;
        l.elements = a != NULL ? a->elements : b->elements;
        if (!selected(select, l.name))
            continue;
        l.out->pairs += order == 0;
        if (order == 0)
            comparison_cells(&l, a, b);
        else
            report_lone(&l, a == NULL, &last);
    }
}

static void run_series(listing l, const stored_results *before, const stored_results *after,
                       const char *select)
{
    const char *last = NULL;
    for (int i = 0, k = 0; i < before->seriess || k < after->seriess;) {
        int order = i == before->seriess ? 1 : -1;
        if (i < before->seriess && k < after->seriess)
            order = strcmp(before->series[i].name, after->series[k].name);
        const result_series *a = order <= 0 ? &before->series[i++] : NULL;
        const result_series *b = order >= 0 ? &after->series[k++] : NULL;
        l.name = a != NULL ? a->name : b->name;
        if (!selected(select, l.name))
            continue;
        l.out->pairs += order == 0;
        if (order == 0)
            comparison_series(&l, a, b);
        else
            report_lone(&l, a == NULL, &last);
    }
}

void comparison_run(FILE *to, const stored_results *before, const stored_results *after,
                    const comparison_limits *limits, const char *select, comparison *out)
{
    const listing l = {to, limits, out, before, after, "", 0};
    memset(out, 0, sizeof *out);
    out->whole = before->whole && after->whole;
    out->evaluated = before->limits && after->limits;
    out->swept = before->swept && after->swept;
    if (out->swept)
        comparison_sweeps(&l, select);
    else if (out->whole)
        run_cells(l, before, after, select);
    else
        run_series(l, before, after, select);
}

int comparison_differs(const comparison *c)
{
    int lines = 0;
    for (int k = 0; k < COMPARISON_KINDS; k++)
        lines += c->count[k];
    return lines > 0;
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

static void compare_value(const listing *l, const result_value *a, const result_value *b)
{
    const comparison_limits *m = l->limits;
    if (isfinite(a->value) != isfinite(b->value)) {
        comparison_lines_heading(l, isfinite(a->value) ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %s\n", a->quantity,
                isfinite(a->value) ? "no longer has a value" : "has a value now");
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
        comparison_lines_heading(l, CHANGE_MISSING);
        fprintf(l->to, ": %s\n", a->value[i].quantity);
    }
    for (int i = 0; i < b->values; i++)
        if (value_named(a, i, b->value[i].quantity) == NULL &&
            results_part_selects(&l->before->part, l->name, b->value[i].quantity)) {
            comparison_lines_heading(l, CHANGE_NEW);
            fprintf(l->to, ": %s\n", b->value[i].quantity);
        }
}

static void comparison_cells(const listing *l, const result_cell *a, const result_cell *b)
{
    comparison_lines_status(l, a->status, b->status);
    if (l->before->swept)
        comparison_lines_cost(l, a->cost, b->cost);
    else if (!results_part_differ(l->before, l->after, l->name))
        comparison_lines_work(l, a->work, b->work, 1);
    compare_values(l, a, b);
}

const char *const comparison_kind_names[COMPARISON_KINDS] = {"worse", "better", "changed", "gone",
                                                             "new"};

static void comparison_lines_heading(const listing *l, comparison_kind kind)
{
    l->out->count[kind]++;
    fprintf(l->to, "%-8s %s", comparison_kind_names[kind], l->name);
    if (l->elements > 0)
        fprintf(l->to, " n=%d", l->elements);
}

void comparison_lines_lone(const listing *l, comparison_kind kind)
{
    comparison_lines_heading(l, kind);
    fputc('\n', l->to);
}

void comparison_lines_status(const listing *l, const char *before, const char *after)
{
    if (strcmp(before, after) == 0)
        return;
    comparison_kind kind = CHANGE_OTHER;
    if (strcmp(after, "ok") == 0)
        kind = CHANGE_BETTER;
    else if (strcmp(before, "ok") == 0)
        kind = CHANGE_WORSE;
    comparison_lines_heading(l, kind);
    fprintf(l->to, ": %s -> %s\n", before, after);
}

static void comparison_lines_work(const listing *l, const long before[RESULTS_WORKS],
                                  const long after[RESULTS_WORKS], int meshes)
{
    for (int k = 0; k < RESULTS_WORKS; k++) {
        const double old = (double)before[k], new = (double)after[k];
        l->out->work[0][k] += old;
        l->out->work[1][k] += new;
        if (fabs(new - old) <= l->limits->work * old / meshes)
            continue;
        comparison_lines_heading(l, new > old ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %ld -> %ld", results_work_names[k], before[k], after[k]);
        fprintf(l->to, old > 0 ? " (%+.1f %%)\n" : "\n", 100 * (new - old) / old);
    }
}

static void comparison_lines_cost(const listing *l, double before, double after)
{
    const double milli = 1e3;
    if (!(before > 0 && after > 0))
        return;
    l->out->cost[0] += before;
    l->out->cost[1] += after;
    if (fabs(after - before) <= l->limits->work * before)
        return;
    comparison_lines_heading(l, after > before ? CHANGE_WORSE : CHANGE_BETTER);
    fprintf(l->to, ": cost %.4g ms -> %.4g ms (%+.1f %%)\n", milli * before, milli * after,
            100 * (after - before) / before);
}

/* Returns the largest relative difference between a value and the same value rounded to this number
 * of digits. */
static double last_digit(int digits)
{
    return 0.5 * pow(10, 1 - digits);
}

/* Writes a line for each mesh whose status has changed or that exists in only one run. Returns 1 if
 * the meshes are the same. */
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
            comparison_lines_lone(&here, old != NULL ? CHANGE_MISSING : CHANGE_NEW);
        same = same && old != NULL && new != NULL;
        i += old != NULL;
        k += new != NULL;
    }
    return same;
}

/* Writes a line and returns 1 if the error has changed. */
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
        fprintf(l->to, ": number of values with a known error: %d (before: %d)\n", b->errors,
                a->errors);
        return;
    }
    const int largest = compare_error(l, "largest", &a->largest, &b->largest);
    const int least = compare_error(l, "least", &a->least, &b->least);
    if (largest || least || fabs(change) <= slack)
        return;
    comparison_lines_heading(l, change > 0 ? CHANGE_WORSE : CHANGE_BETTER);
    fprintf(l->to,
            ": errors between the smallest and the largest changed by %+.4f decades in total\n",
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
            fprintf(l->to, ": %s no longer has a limit\n", old->quantity);
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
    result_series common = {.name = NULL};
    const int same = compare_meshes(l, a, b),
              more = !same && l->after->whole && results_series_restrict(l->after, a, &common);
    if (same || more) {
        const result_series *now = same ? b : &common;
        if (results_part_differ(l->before, l->after, l->name)) {
            l->out->partial++;
        } else {
            comparison_lines_work(l, a->work, now->work, a->meshes);
            compare_errors(l, a, now);
        }
    }
    free(common.mesh);
    free(common.limit);
    if (l->out->evaluated)
        compare_limits(l, a, b);
}

enum { REPORTED = 1 << 14, NAME = 2048 };

typedef struct lone {
    comparison_kind kind;
    const stored_results *other;
    char reported[REPORTED];
    char where[NAME];
} lone;

/* Returns 1 if the name of cell number `next` - 1 or `next` of the run starts with the first
 * `length` characters of `name`. */
static int is_beside(const stored_results *r, int next, const char *name, size_t length)
{
    for (int i = next - 1; i <= next; i++)
        if (i >= 0 && i < r->cells && strncmp(r->cell[i].name, name, length) == 0)
            return 1;
    return 0;
}

static void report(const listing *l, comparison_kind kind, const char *name, int elements)
{
    listing here = *l;
    here.name = name;
    here.elements = elements;
    comparison_lines_lone(&here, kind);
}

static void report_point(const listing *l, lone *only, int length)
{
    if (strncmp(only->where, l->name, (size_t)length) == 0 && only->where[length] == '\0')
        return;
    snprintf(only->where, sizeof only->where, "%.*s", length, l->name);
    report(l, only->kind, only->where, 0);
}

static void report_column(const listing *l, lone *only, const char *key, int elements)
{
    const size_t used = strlen(only->reported);
    char name[NAME], line[NAME + FORMULATION_KEY];
    snprintf(name, sizeof name, "%.*s%s", (int)strcspn(l->name, "/"), l->name, key);
    snprintf(line, sizeof line, "%s n=%d", name, elements);
    if (results_part_has(only->reported, line))
        return;
    snprintf(only->reported + used, sizeof only->reported - used, "%s%s", used > 0 ? "\n" : "",
             line);
    report(l, only->kind, name, elements);
}

/* Handles a cell that exists in only one run. next: position of the cell in the other run, if it
 * existed there. */
static void report_cell(const listing *l, int next, lone *only)
{
    const char *key = strrchr(l->name, '/');
    const int length = (int)(key - l->name);
    if (!is_beside(only->other, next, l->name, (size_t)length + 1))
        report_point(l, only, length);
    else if (!is_beside(only->other, next, l->name, strlen(l->name) + 1))
        report_column(l, only, key, 0);
    else
        report_column(l, only, "", l->elements);
}

static int order_of(const listing *l, int i, int k)
{
    if (i == l->before->cells || k == l->after->cells)
        return i == l->before->cells ? 1 : -1;
    return results_order(&l->before->cell[i], &l->after->cell[k]);
}

static void comparison_sweeps(const listing *l, const char *select)
{
    listing here = *l;
    lone absent = {CHANGE_MISSING, l->after, "", ""}, new = {CHANGE_NEW, l->before, "", ""};
    for (int i = 0, k = 0; i < l->before->cells || k < l->after->cells;) {
        const int order = order_of(l, i, k);
        const result_cell *a = order <= 0 ? &l->before->cell[i++] : NULL;
        const result_cell *b = order >= 0 ? &l->after->cell[k++] : NULL;
        here.name = a != NULL ? a->name : b->name;
        here.elements = a != NULL ? a->elements : b->elements;
        if (select != NULL && select_matches(select, here.name) <= 0)
            continue;
        here.out->pairs += order == 0 && here.elements > 0;
        if (order == 0)
            comparison_cells(&here, a, b);
        else
            report_cell(&here, a != NULL ? k : i, a != NULL ? &absent : &new);
    }
}
