#include "harness/study/proposal.h"

#include <math.h>
#include <string.h>

static const series *series_of(const sweep *s, const verdict *v)
{
    return &s->series[v->series];
}

static const char *case_of(const sweep *s, const verdict *v)
{
    return s->point[series_of(s, v)->point].type->name;
}

static const char *quantity_of(const sweep *s, const verdict *v)
{
    return s->point[series_of(s, v)->point].scene.quantity[v->quantity].name;
}

/* Would one rule explain both? */
static int same_rule(const sweep *s, const verdict *a, const verdict *b)
{
    return a->needs_finding && b->needs_finding && a->kind == b->kind &&
           strcmp(case_of(s, a), case_of(s, b)) == 0 &&
           strcmp(series_of(s, a)->formulation.key, series_of(s, b)->formulation.key) == 0;
}

/* Index of the first verdict of the same rule; of the same quantity too. */
static int first_of(const sweep *s, const judgement *j, int index, int quantity)
{
    const verdict *v = &j->verdict[index];
    for (int i = 0; i < index; i++)
        if (same_rule(s, &j->verdict[i], v) &&
            (!quantity || strcmp(quantity_of(s, &j->verdict[i]), quantity_of(s, v)) == 0))
            return i;
    return index;
}

static void write_rule(FILE *to, const sweep *s, const judgement *j, int first, int number)
{
    const verdict *v = &j->verdict[first];
    const char *key = series_of(s, v)->formulation.key, *blank = "";
    double largest = 0;
    fprintf(to, "NEW%d-%s,\"%s\",%s,,\"", number, case_of(s, v), key, case_of(s, v));
    for (int i = first; i < j->verdicts; i++) {
        const verdict *one = &j->verdict[i];
        if (!same_rule(s, v, one))
            continue;
        if (isfinite(one->departure))
            largest = fmax(largest, fabs(one->departure));
        if (first_of(s, j, i, 1) != i)
            continue;
        fprintf(to, "%s%s", blank, quantity_of(s, one));
        blank = " ";
    }
    fprintf(to, "\",\"%s\",", verdict_name(v->kind));
    if (largest > 0)
        fprintf(to, "%.2g", 4 * largest / 3);
    fprintf(to, ",,\"" PROPOSAL_CAUSE "\",\n");
}

int proposal_write(FILE *to, const sweep *s, const judgement *j)
{
    int rules = 0;
    fprintf(to, "rule,formulations,cases,condition,quantities,verdicts,largest_error,predicted,"
                "cause,proof\n");
    for (int i = 0; i < j->verdicts; i++)
        if (j->verdict[i].needs_finding && first_of(s, j, i, 0) == i)
            write_rule(to, s, j, i, ++rules);
    return rules;
}
