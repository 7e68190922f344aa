#include "harness/experiments/pace_distance.h"

#include <math.h>

#include "harness/study/study.h"

static double apart(const double a[3], const double b[3])
{
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

/* Between two unit quaternions, whatever their signs; of small angles exact, too. */
static double angle(const double a[4], const double b[4])
{
    double less = 0, more = 0;
    for (int i = 0; i < 4; i++) {
        less += (a[i] - b[i]) * (a[i] - b[i]);
        more += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 4 * atan2(sqrt(fmin(less, more)), sqrt(fmax(less, more)));
}

/* Largest distance of two nodes at rest. */
static double size_of(const shapes *s)
{
    double size = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < i; k++)
            size = fmax(size, apart(s->node + 3 * (size_t)i, s->node + 3 * (size_t)k));
    return size > 0 ? size : 1;
}

static double of_state(const shapes *a, const shapes *b, size_t at, size_t other, double size)
{
    double largest = 0;
    for (size_t i = 0; i < (size_t)a->points; i++) {
        const centreline_point *p = &a->point[at * (size_t)a->points + i],
                               *q = &b->point[other * (size_t)b->points + i];
        largest = fmax(largest, fmax(apart(p->r, q->r) / size, angle(p->q, q->q)));
    }
    for (size_t i = 0; i < (size_t)a->nodes; i++)
        largest = fmax(largest, apart(a->node + 3 * (at * (size_t)a->nodes + i),
                                      b->node + 3 * (other * (size_t)b->nodes + i)) /
                                    size);
    return largest;
}

double pace_distance(const cell_result *cell, const cell_result *other, int analysis)
{
    const shapes *a = &cell->solve.shapes, *b = &other->solve.shapes;
    double largest = 0;
    if (cell->solve.status != STATUS_OK || other->solve.status != STATUS_OK || a->states == 0 ||
        a->states != b->states || a->points != b->points)
        return NAN;
    const double size = size_of(a);
    for (int i = 0; i < a->states; i++)
        if (a->state[i].kind == SHAPE_MOTION && a->state[i].analysis == analysis)
            largest = fmax(largest, of_state(a, b, (size_t)i, (size_t)i, size));
    return largest;
}

double pace_distance_of(const scene_quantity *q, const quantity_result *one,
                        const quantity_result *other)
{
    return one->status == STATUS_OK && other->status == STATUS_OK
               ? fabs(verdict_error(q, one->value, other->value))
               : NAN;
}
