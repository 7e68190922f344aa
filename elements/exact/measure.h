/* How the rotation between two nodes is measured: a vector along its axis, whose length is a function of the angle. */
#ifndef BEAMWORK_EXACT_MEASURE_H
#define BEAMWORK_EXACT_MEASURE_H

typedef enum measure_kind {
    MEASURE_QUARTER, /* 4 tan(angle/4): what the interpolation of two quaternions gives half way */
    MEASURE_ANGLE,   /* the angle itself */
    MEASURE_EIGHTH   /* 8 tan(angle/8) */
} measure_kind;

/* From x, the first kind, to the kind wanted [3], and its derivative T [3 x 3]. */
void measure_of(measure_kind kind, const double x[3], double out[3], double T[9]);

/* Second derivative [3 x 3] of n . measure(x); not for the first kind, which is linear. */
void measure_second(measure_kind kind, const double x[3], const double n[3], double H[9]);

#endif
