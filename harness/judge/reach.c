#include "harness/judge/reach.h"

#include <math.h>

const double reach_level[REACH_LEVELS] = {0.1, 0.01, 0.001, 0.0001};

int reach_mesh(const sweep *s, const verdict *v, double level)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    int first = -1;
    if (v->truth == NULL || one->missing[0] != '\0')
        return -1;
    for (int i = one->meshes - 1; i >= 0; i--) {
        const solve_result *r = &one->cell[i].solve;
        const double value = v->quantity < r->quantities ? r->quantity[v->quantity].value : NAN;
        if (!(fabs(verdict_error(q, value, v->truth->value)) <= level)) /* NAN is not within */
            break;
        first = i;
    }
    return first;
}

int reach_fastest(const sweep *s, const verdict *v, double level)
{
    const series *one = &s->series[v->series];
    const int first = reach_mesh(s, v, level);
    int best = first;
    if (first < 0 || one->timing == NULL)
        return first;
    for (int i = first; i < one->meshes; i++)
        if (rounds_least(&one->timing[i].as_is) < rounds_least(&one->timing[best].as_is))
            best = i;
    return best;
}
