/* Newton's corrections contract as their squares, and so do those of the stresses: in stiff
 * elements these are less exact than the motions by orders, so that the motions alone do not tell.
 */
#include "harness/newton/arrival.h"

#include <math.h>

/* Largest of two corrections after another (those of the geometrically exact element settle at
 * 3e-11 of 1000 elements, 6e-9 of 40 000) ... */
static const double small = 1e-8;
static const double many_elements = 1e4; /* with more of them in proportion */
/* ... or of one after which nothing is left that rounding would not hide ... */
static const double arrival_near = 1e-6, negligible = 1e-15;
/* ... or of one whose square is nothing even where stresses are 1e10 times as sensitive. */
static const double rounding = 1e-12;
/* Larger corrections need not contract as their squares. */
static const double quadratic = 0.1;
/* Of the stresses, relative to the largest one: compliances change by half of it at most (measured
 * on the mechanisms of cases/), which is less than the noise of most of them. */
static const double same_tangent = 3e-11;

void arrival_start(double criterion, int differences, int elements, arrival *a)
{
    *a = (arrival){.criterion = criterion > 0 || !differences ? criterion : small,
                   .small = small * fmax(1, elements / many_elements),
                   .correction = INFINITY,
                   .before = INFINITY,
                   .contraction = NAN,
                   .remaining = NAN};
}

/* Of the stresses of the path the largest one so far is the measure: they may pass through zero. */
void arrival_take(double correction, const advance_stress *stress, int first, arrival *a)
{
    a->before = first ? INFINITY : a->correction;
    a->correction = correction;
    a->stress = fmax(a->stress, stress->largest);
    a->stress_change = stress->change > 0 ? stress->change / a->stress : 0;
    if (a->before <= quadratic && a->before > 0)
        a->contraction = fmax(correction, a->stress_change) / (a->before * a->before);
    a->remaining = a->contraction * correction * correction;
}

int arrival_reached(const arrival *a)
{
    if (a->criterion > 0)
        return a->correction <= a->criterion;
    return a->correction <= rounding || (a->correction <= a->small && a->before <= a->small) ||
           (a->correction <= arrival_near && a->remaining <= negligible);
}

int arrival_tangent_stands(const arrival *a)
{
    return a->correction <= same_tangent && a->stress_change <= same_tangent;
}
