/* Two sweeps side by side: at each of their points each has all of its formulations and meshes. */
#include <stdio.h>
#include <string.h>

#include "harness/records/comparison_lines.h"
#include "harness/study/study.h"

enum { TOLD = 1 << 14, NAME = 2048 };

/* What one of them has alone, and what had its line. */
typedef struct lone {
    comparison_kind kind;
    const stored_results *other;
    char told[TOLD];  /* formulations and meshes, a line each */
    char where[NAME]; /* the last point */
} lone;

/* Begins the name of a cell beside `next` like this one, by so many characters? */
static int is_beside(const stored_results *r, int next, const char *name, size_t length)
{
    for (int i = next - 1; i <= next; i++)
        if (i >= 0 && i < r->cells && strncmp(r->cell[i].name, name, length) == 0)
            return 1;
    return 0;
}

static void tell(const listing *l, comparison_kind kind, const char *name, int elements)
{
    listing here = *l;
    here.name = name;
    here.elements = elements;
    comparison_lines_lone(&here, kind);
}

static void tell_point(const listing *l, lone *only, int length)
{
    if (strncmp(only->where, l->name, (size_t)length) == 0 && only->where[length] == '\0')
        return;
    snprintf(only->where, sizeof only->where, "%.*s", length, l->name);
    tell(l, only->kind, only->where, 0);
}

/* Of all points: case/formulation, or a mesh of the case. */
static void tell_column(const listing *l, lone *only, const char *key, int elements)
{
    const size_t used = strlen(only->told);
    char name[NAME], line[NAME + FORMULATION_KEY];
    snprintf(name, sizeof name, "%.*s%s", (int)strcspn(l->name, "/"), l->name, key);
    snprintf(line, sizeof line, "%s n=%d", name, elements);
    if (results_part_has(only->told, line))
        return;
    snprintf(only->told + used, sizeof only->told - used, "%s%s", used > 0 ? "\n" : "", line);
    tell(l, only->kind, name, elements);
}

/* A cell that only one of them has; in the other, cells beside it stand at `next`. */
static void tell_cell(const listing *l, int next, lone *only)
{
    const char *key = strrchr(l->name, '/');
    const int length = (int)(key - l->name);
    if (!is_beside(only->other, next, l->name, (size_t)length + 1))
        tell_point(l, only, length);
    else if (!is_beside(only->other, next, l->name, strlen(l->name) + 1))
        tell_column(l, only, key, 0);
    else
        tell_column(l, only, "", l->elements);
}

static int order_of(const listing *l, int i, int k)
{
    if (i == l->before->cells || k == l->after->cells)
        return i == l->before->cells ? 1 : -1;
    return results_order(&l->before->cell[i], &l->after->cell[k]);
}

void comparison_sweeps(const listing *l, const char *select)
{
    listing here = *l;
    lone gone = {CHANGE_GONE, l->after, "", ""}, new = {CHANGE_NEW, l->before, "", ""};
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
            tell_cell(&here, a != NULL ? k : i, a != NULL ? &gone : &new);
    }
}
