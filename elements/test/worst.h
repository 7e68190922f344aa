/* The larger of two departures, for tests. */
#ifndef BEAMWORK_TEST_WORST_H
#define BEAMWORK_TEST_WORST_H

#include <math.h>

/* What is not a number is the worst there is; fmax would drop it. */
static inline double worst_of(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

#endif
