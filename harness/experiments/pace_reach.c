#include "harness/experiments/pace_reach.h"

#include <math.h>
#include <string.h>

const double pace_levels[PACE_LEVELS] = {1e-2, 1e-4, 1e-6};

/* Both of one integrator, by steps or by tolerances. */
static int is_coarser(const pace_run *a, const pace_run *b)
{
    return a->group == b->group && strcmp(a->method.name, b->method.name) == 0 &&
           (a->tolerance > 0) == (b->tolerance > 0) &&
           (a->tolerance > 0 ? a->tolerance > b->tolerance : a->step > b->step);
}

static int is_reached_from(const pace *p, const pace_run *r, double level)
{
    for (int i = 0; i < p->runs; i++)
        if ((&p->run[i] == r || is_coarser(r, &p->run[i])) && !(p->run[i].error <= level))
            return 0;
    return 1;
}

/* Errors and costs are powers of the step between two runs. */
static double cost_at(const pace *p, const pace_run *r, double level)
{
    const pace_run *before = r > p->run ? r - 1 : NULL;
    if (before == NULL || !is_coarser(before, r) || !(before->error > level) || r->error <= 0)
        return r->cost;
    const double share = log(before->error / level) / log(before->error / r->error);
    return before->cost * pow(r->cost / before->cost, share);
}

pace_reach pace_reach_of(const pace *p, int group, const char *method, double level)
{
    pace_reach best = {NULL, INFINITY};
    for (int i = 0; i < p->runs; i++) {
        const pace_run *r = &p->run[i];
        if (r->group != group || strcmp(r->method.name, method) != 0 ||
            !is_reached_from(p, r, level))
            continue;
        const double cost = cost_at(p, r, level);
        if (cost < best.cost)
            best = (pace_reach){r, cost};
    }
    return best;
}

int pace_reach_methods(const pace *p, const char *name[PACE_METHODS_MOST])
{
    int count = 0;
    for (int i = 0; i < p->runs; i++) {
        int known = 0;
        for (int k = 0; k < count; k++)
            known |= strcmp(name[k], p->run[i].method.name) == 0;
        if (!known && count < PACE_METHODS_MOST)
            name[count++] = p->run[i].method.name;
    }
    return count;
}
