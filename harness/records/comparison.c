#include "harness/records/comparison.h"

#include <string.h>

#include "elements/shared/number.h"
#include "harness/records/comparison_lines.h"
#include "harness/study/study.h"

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
                             "threshold '%.40s': write error=R,floor=R,work=R, each once, with "
                             "numbers that are not negative",
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

/* A series that is in one of the two only, or a mesh of it (elements > 0). which: 0: the old one
 * has it. *last: the series that was counted last, in the order of their names. */
static void tell_lone(const listing *l, int which, const char **last)
{
    const stored_results *here = which == 0 ? l->before : l->after,
                         *other = which == 0 ? l->after : l->before;
    int *count = NULL;
    if (!results_part_wants(other, here, l->name))
        count = &l->out->outside[which];
    else if (results_part_is_fresh(&here->part, l->name))
        count = &l->out->fresh[which];
    if (count == NULL) {
        comparison_lines_lone(l, which == 0 ? CHANGE_GONE : CHANGE_NEW);
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
        int order = i == before->cells ? 1 : -1; /* all of one are done */
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
            tell_lone(&l, a == NULL, &last);
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
            tell_lone(&l, a == NULL, &last);
    }
}

void comparison_run(FILE *to, const stored_results *before, const stored_results *after,
                    const comparison_limits *limits, const char *select, comparison *out)
{
    const listing l = {to, limits, out, before, after, "", 0};
    memset(out, 0, sizeof *out);
    out->whole = before->whole && after->whole;
    out->judged = before->limits && after->limits;
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
