#include "harness/judge/reach.h"

#include <math.h>

const double reach_level[REACH_LEVELS] = {0.1, 0.01, 0.001, 0.0001};

/* Index of the coarsest mesh from which on every value is within the level of the truth, or -1. */
static int first_within(const series *one, int quantity, const scene_quantity *q,
                        const truth *reference, double level)
{
    int first = -1;
    for (int i = one->meshes - 1; i >= 0; i--) {
        const solve_result *r = &one->cell[i].solve;
        const double value = quantity < r->quantities ? r->quantity[quantity].value : NAN;
        if (!(fabs(verdict_error(q, value, reference->value)) <= level)) /* NAN is not within */
            break;
        first = i;
    }
    return first;
}

int reach_mesh(const sweep *s, const verdict *v, double level)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    if (v->truth == NULL || one->missing[0] != '\0')
        return -1;
    return first_within(one, v->quantity, q, v->truth, level);
}

int reach_every(const sweep *s, const truths *t, int series_index, double level)
{
    const series *one = &s->series[series_index];
    const point *p = &s->point[one->point];
    int first = -1;
    if (one->missing[0] != '\0')
        return -1;
    for (int q = 0; q < p->scene.quantities; q++) {
        const truth *reference = verdict_reference(t, p, &one->formulation, q);
        if (p->scene.quantity[q].reduction == SCENE_CURVE || reference == NULL)
            continue;
        const int here = first_within(one, q, &p->scene.quantity[q], reference, level);
        if (here < 0)
            return -1;
        first = here > first ? here : first;
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
