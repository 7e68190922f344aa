#include "harness/experiments/pace_verdict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/number.h"
#include "harness/experiments/pace_order.h"

/* Of a decimal logarithm: the same, but for a factor of two. */
static const double same_decade = 0.3;

static void say(pace_verdict *v, const char *word)
{
    const size_t at = strlen(v->found);
    snprintf(v->found + at, sizeof v->found - at, "%s%s", at > 0 ? " " : "", word);
}

static double drift_of(const pace_verdict *v, const pace_run *r)
{
    return v->kind == PACE_ENERGY_KEPT ? r->energy : r->momentum;
}

/* Of a drift at halved steps, from the last two pairs; 0: they do not agree on any. */
static int drift_order(const pace_verdict *v, const pace_run r[])
{
    double order[2];
    if (v->count < 3)
        return 0;
    for (int i = 0; i < 2; i++) {
        const pace_run *fine = &r[v->count - 1 - i];
        order[i] = log(drift_of(v, fine - 1) / drift_of(v, fine)) / log(fine[-1].step / fine->step);
    }
    const double whole = round(order[0]);
    return fabs(order[0] - whole) <= pace_order_slack && fabs(order[1] - whole) <= pace_order_slack
               ? (int)whole
               : 0;
}

static void reach_drift(pace_verdict *v, const pace_run r[])
{
    const double most = v->kind == PACE_ENERGY_KEPT ? pace_energy : pace_momentum;
    int kept = 1;
    for (int i = 0; i < v->count; i++)
        kept = kept && drift_of(v, &r[i]) <= most;
    const int order = drift_order(v, r);
    if (kept)
        say(v, "conserved");
    else if (order > 0)
        snprintf(v->found, sizeof v->found, "order %d", order);
    else
        say(v, "drifts");
}

static void reach_tolerance(pace_verdict *v, const pace_run r[])
{
    for (int i = 0; i < v->count; i++) {
        char text[16];
        snprintf(text, sizeof text, "%.1f", log10(r[i].error / r[i].tolerance));
        say(v, text);
    }
}

static void reach_one(const pace *p, pace_verdict *v)
{
    const pace_run *r = &p->run[v->first];
    v->found[0] = '\0';
    if (v->kind == PACE_ORDER)
        say(v, pace_order_name(pace_order_of(p, v->first).kind));
    else if (v->kind == PACE_TOLERANCE)
        reach_tolerance(v, r);
    else if (v->kind != PACE_FATE)
        reach_drift(v, r);
    else
        for (int i = 0; i < v->count; i++)
            say(v, r[i].fate != PACE_UNJUDGED ? pace_fate_name(r[i].fate) : "unjudged");
}

/* Numbers that differ by little, as many of them. */
static int is_near(const char *a, const char *b)
{
    while (*a != '\0' && *b != '\0') {
        double x, y;
        if (!number_read(a, &a, &x) || !number_read(b, &b, &y) || !(fabs(x - y) <= same_decade))
            return 0;
    }
    return *a == *b;
}

int pace_verdict_is_expected(const pace_verdict *v)
{
    return v->kind == PACE_TOLERANCE ? v->found[0] != '\0' && is_near(v->found, v->expected)
                                     : strcmp(v->found, v->expected) == 0;
}

void pace_verdict_reach(const pace *p, pace_verdicts *all)
{
    all->unexpected = 0;
    for (int i = 0; i < all->count; i++) {
        pace_verdict *v = &all->verdict[i];
        reach_one(p, v);
        v->as_expected = pace_verdict_is_expected(v);
        all->unexpected += !v->as_expected;
    }
}

void pace_verdict_free(pace_verdicts *all)
{
    own_table_free(&all->table);
    free(all->verdict);
    memset(all, 0, sizeof *all);
}
