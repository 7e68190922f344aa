#include "harness/experiments/pace_order.h"

#include <math.h>
#include <string.h>

const double pace_order_slack = 0.3;

/* Of what the reference may be off, and of rounding. */
static const double floor_of_reference = 10, floor_of_rounding = 1e-11;

const char *pace_order_name(pace_order_kind kind)
{
    static const char *const name[PACE_ORDER_KINDS] = {"pass", "low order", "undecided"};
    return name[kind];
}

static int follows(const pace_run *a, const pace_run *b)
{
    return b->group == a->group && strcmp(b->method.name, a->method.name) == 0 &&
           a->tolerance == 0 && b->tolerance == 0 && b->step < a->step;
}

static double order_of(const pace_run *coarse, const pace_run *fine)
{
    return log(coarse->error / fine->error) / log(coarse->step / fine->step);
}

void pace_order_fill(pace *p)
{
    for (int i = 0; i < p->runs; i++)
        p->run[i].order = i > 0 && follows(&p->run[i - 1], &p->run[i])
                              ? order_of(&p->run[i - 1], &p->run[i])
                              : NAN;
}

/* Two orders say it; where they are far apart, they may be on their way to anything. */
static pace_order_kind judge(const pace_ladder *l)
{
    const double least = l->method->order - pace_order_slack;
    if (isnan(l->order) || isnan(l->before))
        return PACE_ORDER_UNDECIDED;
    if (l->order >= least && l->before >= least)
        return PACE_ORDER_PASS;
    return l->order < least && l->before < least ? PACE_ORDER_LOW : PACE_ORDER_UNDECIDED;
}

pace_ladder pace_order_of(const pace *p, int first)
{
    const pace_run *r = &p->run[first];
    pace_ladder out = {
        .group = r->group,
        .method = &r->method,
        .first = first,
        .count = 1,
        .order = NAN,
        .before = NAN,
        .floor = fmax(floor_of_reference * p->group[r->group].uncertainty, floor_of_rounding)};
    while (first + out.count < p->runs && follows(&r[out.count - 1], &r[out.count]))
        out.count++;
    for (int i = 1; i < out.count && r[i].error > out.floor; i++) {
        out.before = out.order;
        out.order = order_of(&r[i - 1], &r[i]);
    }
    out.kind = judge(&out);
    return out;
}

int pace_order_stands(const pace *p, const pace_ladder *l, int quantity)
{
    static const double least = 1e-3, fall = 2, steps = 3.9;
    const pace_run *first = &p->run[l->first], *last = first + l->count - 1;
    if (first->values == NULL || last->values == NULL || first->step < steps * last->step)
        return 0;
    const double from = first->values[quantity], to = last->values[quantity];
    return to > least && to > l->floor && from < fall * to;
}

int pace_order_is_stopped(const pace_group *g)
{
    return g->order < PACE_REFERENCE_ORDER - 1;
}
