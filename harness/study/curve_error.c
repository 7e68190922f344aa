#include "harness/study/curve_error.h"

#include <math.h>

/* Are its points those of steps, which differ from mesh to mesh? */
static int has_own_points(const scene *s, const scene_quantity *q)
{
    return s->analysis[q->analysis].kind == SCENE_CONTINUATION;
}

static const quantity_result *whole_of(const solve_result *r, int quantity)
{
    const quantity_result *q = quantity < r->quantities ? &r->quantity[quantity] : NULL;
    return q != NULL && q->status == STATUS_OK && q->curve.points > 0 ? q : NULL;
}

/* Of the curve the point with that abscissa; -1: none. */
static int point_at(const curve *c, double x, double size)
{
    for (int i = 0; i < c->points; i++)
        if (fabs(c->x[i] - x) <= 1e-9 * size)
            return i;
    return -1;
}

static double largest_of(int count, const double value[])
{
    double largest = 0;
    for (int i = 0; i < count; i++)
        largest = fmax(largest, fabs(value[i]));
    return largest;
}

double curve_error_between(const scene *s, int quantity, const solve_result *one,
                           const solve_result *two, int *at)
{
    const quantity_result *p = whole_of(one, quantity), *q = whole_of(two, quantity);
    if (p == NULL || q == NULL)
        return NAN;
    const int own = has_own_points(s, &s->quantity[quantity]);
    const double size = largest_of(q->curve.points, q->curve.value),
                 width = largest_of(q->curve.points, q->curve.x);
    double largest = NAN;
    if (!own && p->curve.points != q->curve.points)
        return NAN;
    for (int i = 0; i < p->curve.points; i++) {
        const int k = own ? point_at(&q->curve, p->curve.x[i], width) : i;
        const double apart = k >= 0 ? fabs(p->curve.value[i] - q->curve.value[k]) : NAN;
        if (isnan(apart) || !(isnan(largest) || apart > largest))
            continue;
        largest = apart;
        if (at != NULL)
            *at = i;
    }
    return largest > 0 ? largest / size : largest;
}

int curve_error_finest(const series *one, int quantity)
{
    for (int k = one->meshes - 1; k >= 0 && one->missing[0] == '\0'; k--)
        if (whole_of(&one->cell[k].solve, quantity) != NULL)
            return k;
    return -1;
}

int curve_error_reference(const sweep *s, int quantity)
{
    int found = -1;
    double least = INFINITY;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const int finest = curve_error_finest(one, quantity);
        if (finest < 0)
            continue;
        const double change =
            finest > 0
                ? curve_error_between(&s->point[one->point].scene, quantity,
                                      &one->cell[finest - 1].solve, &one->cell[finest].solve, NULL)
                : NAN;
        if (found < 0 || change < least) {
            found = i;
            least = isnan(change) ? INFINITY : change;
        }
    }
    return found;
}
