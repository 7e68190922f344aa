/* An extreme: a case in which a variable x takes values at which numerical errors become
 * critical. */
#ifndef BEAMWORK_EXTREME_H
#define BEAMWORK_EXTREME_H

#include "cases/scene/scene.h"

enum { EXTREME_MAX_SETTINGS = 8, EXTREME_MAX_QUANTITIES = 4, EXTREME_MAX_VALUES = 12 };

/* The value of the parameter is offset + factor x^power. */
typedef struct extreme_setting {
    const char *parameter; /* NULL ends the list */
    double offset, factor, power;
} extreme_setting;

typedef struct extreme_quantity {
    const char *name; /* NULL ends the list */
    double power;     /* for EXTREME_SAME: exponent for which value/x^power is equal for all x */
} extreme_quantity;

typedef enum extreme_knob {
    EXTREME_PARAMETERS,
    EXTREME_ELEMENTS, /* x is the number of elements per member */
    EXTREME_STEPS,    /* x is the number of load steps between two stations */
    EXTREME_SPLIT,    /* the first member is split at the fraction x of its length */
    EXTREME_REVERSE,  /* 1 if every member is reversed, otherwise 0 */
    EXTREME_WHOLE     /* the steps of a motion are not refined */
} extreme_knob;

typedef enum extreme_criterion {
    EXTREME_EXACT, /* compared with the stored exact value for the same parameters */
    EXTREME_SAME   /* compared with the value of the same formulation at `base` */
} extreme_criterion;

typedef struct extreme {
    const char *name;
    const char *group; /* name shared by the extremes of one kind on several cases */
    const char *summary;
    const char *base;  /* name of the base case */
    const char *fixed; /* "name=value;..." for parameters that differ from their defaults */
    extreme_setting setting[EXTREME_MAX_SETTINGS];
    extreme_quantity quantity[EXTREME_MAX_QUANTITIES];
    const char *x_name, *x_unit;
    extreme_knob knob;
    int elements; /* number per member, unless x sets it */
    int values;
    double value[EXTREME_MAX_VALUES];
    extreme_criterion criterion;
    double same_as;   /* value of x with which the results for other values are compared */
    double tolerance; /* relative tolerance; a value within it is accurate */
} extreme;

extern const extreme extremes[];

#endif
