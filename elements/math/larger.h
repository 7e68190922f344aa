/* The larger of two numbers. */
#ifndef BEAMWORK_LARGER_H
#define BEAMWORK_LARGER_H

#include <math.h>

/* NAN where one of them is, which fmax passes over. */
static inline double larger(double a, double b)
{
    return a >= b || isnan(a) ? a : b;
}

#endif
