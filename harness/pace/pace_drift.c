#include "harness/pace/pace_drift.h"

#include <math.h>

#include "harness/pace/pace_plan.h"

/* The first point of a curve behind `from`: where loads end, accelerations and what has no mass are
 * found anew. */
static int first_of(const curve *c, double from)
{
    int i = 0;
    while (i < c->points && c->x[i] <= from * (1 + 1e-12))
        i++;
    return i;
}

/* With the first point at which nothing acts any more: the run may have stopped before. */
static void take_energy(const curve *c, int first, pace_run *r)
{
    const double before = c->value[first];
    r->largest = r->last = 1;
    r->energy = 0;
    for (int i = first; i < c->points; i++) {
        r->last = c->value[i] / before;
        r->largest = fmax(r->largest, r->last);
        r->energy = fmax(r->energy, fabs(r->last - 1));
    }
}

static double length_at(const curve *const c[3], int i)
{
    return sqrt(c[0]->value[i] * c[0]->value[i] + c[1]->value[i] * c[1]->value[i] +
                c[2]->value[i] * c[2]->value[i]);
}

/* Largest change of a vector since the first point. */
static double change_of(const curve *const c[3], int first)
{
    double largest = 0;
    for (int i = first; i < c[0]->points; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            const double d = c[k]->value[i] - c[k]->value[first];
            square += d * d;
        }
        largest = fmax(largest, sqrt(square));
    }
    return largest;
}

/* Both momenta against their size; what is at rest has none. */
static double momentum_drift(const pace *p, const pace_run *r, int first)
{
    double largest = 0;
    for (int which = PACE_PX; which < PACE_CURVES; which += 3) {
        const curve *c[3];
        for (int k = 0; k < 3; k++)
            c[k] = pace_plan_curve(p, r->series, which + k);
        const double size = length_at(c, first);
        if (size > 0)
            largest = fmax(largest, change_of(c, first) / size);
    }
    return largest;
}

/* Of the work that went in and came out, in parts of the largest energy. */
static double unexplained(const pace *p, const pace_run *r)
{
    const curve *energy = pace_plan_curve(p, r->series, PACE_ENERGY),
                *drift = pace_plan_curve(p, r->series, PACE_DRIFT);
    double most = 0, size = 0;
    for (int i = 0; energy != NULL && drift != NULL && i < drift->points; i++) {
        most = isnan(drift->value[i]) ? NAN : fmax(most, fabs(drift->value[i]));
        size = fmax(size, fabs(energy->value[i]));
        if (isnan(most))
            return NAN;
    }
    return size > 0 ? most / size : NAN;
}

static pace_fate fate_of(const pace_run *r)
{
    if (r->status != STATUS_OK)
        return PACE_STOPS;
    if (isnan(r->largest))
        return PACE_UNJUDGED;
    if (!(r->largest <= 1 + pace_growth))
        return PACE_GROWS;
    return r->energy <= pace_energy && r->momentum <= pace_momentum ? PACE_EXACT : PACE_BOUNDED;
}

void pace_drift(const pace *p, pace_run *r)
{
    const pace_group *g = &p->group[r->group];
    const curve *energy = pace_plan_curve(p, r->series, PACE_ENERGY);
    const int first = energy != NULL ? first_of(energy, g->from) : 0;
    r->energy = r->momentum = r->largest = r->last = NAN;
    if (energy != NULL && first < energy->points && energy->value[first] > 0) {
        take_energy(energy, first, r);
        r->momentum = momentum_drift(p, r, first);
    } else if (!isfinite(g->from))
        r->energy = unexplained(p, r);
    r->fate = isfinite(g->from) || r->status != STATUS_OK ? fate_of(r) : PACE_UNJUDGED;
}
