/* How the rotation between two nodes is measured: a vector along its axis, whose length is a
 * function of the angle. */
#ifndef BEAMWORK_EXACT_MEASURE_H
#define BEAMWORK_EXACT_MEASURE_H

typedef enum exact_measure_kind {
    EXACT_MEASURE_QUARTER, /* 4 tan(angle/4): what the interpolation of two quaternions gives half
                              way */
    EXACT_MEASURE_ANGLE,   /* the angle itself */
    EXACT_MEASURE_EIGHTH   /* 8 tan(angle/8) */
} exact_measure_kind;

/* From x, the first kind, to the kind wanted [3], and its derivative T [3 x 3]. */
void exact_measure_of(exact_measure_kind kind, const double x[3], double out[3], double T[9]);

/* Second derivative [3 x 3] of n . measure(x); not for the first kind, which is linear. */
void exact_measure_second(exact_measure_kind kind, const double x[3], const double n[3],
                          double H[9]);

#endif
