#include "harness/time/extent.h"

#include <float.h>
#include <math.h>

#include "harness/model/model.h"

const double extent_guess = 0.02;

void extent_begin(extent *e, const model *m)
{
    e->bent = metric_distance(m, kinematics_rest(m), e->begin, NULL);
}

extent extent_with(const extent *so_far, const model *m, const motion_scheme *s,
                   const instant *from, const instant *to, double h, double error)
{
    const double memory = 10, /* [rad] */
        distance = metric_distance(m, so_far->begin, to->state, s->light),
                 step = metric_distance(m, from->state, to->state, s->light);
    extent out = *so_far;
    out.largest = fmax(out.largest, distance);
    out.rate = fmax(out.rate, step / h);
    if (!s->adds || !(out.rate > 0))
        return out;
    const double per_jerk = 1 / 12.0, omega = sqrt(out.density / (per_jerk * out.rate));
    out.density = fmax(error / pow(h, s->order), out.density * exp(-omega * h / memory));
    return out;
}

double extent_error(const extent *so_far, const motion_scheme *s, double h, double error)
{
    return s->adds ? so_far->density * pow(h, s->order) : error;
}

/* What coordinates are rounded by. */
static const double rounding = 32 * DBL_EPSILON;

double extent_allows(const extent *so_far, double part, double tolerance)
{
    const double size = 1; /* flights far away leave the structure its size */
    const double most = tolerance * fmax(so_far->scale, fmin(size, so_far->largest)),
                 noise = 8 * DBL_EPSILON * so_far->bent;
    return fmax(part * fmax(most, rounding), noise);
}

int extent_is_less(const extent *so_far, double tolerance, double *scale)
{
    const double part = 0.5, known = 1e-10; /* of an equilibrium, by Newton */
    *scale = fmax(so_far->largest, rounding);
    return so_far->largest > known * so_far->bent && *scale < part * so_far->scale &&
           so_far->worst > tolerance * *scale;
}
