/* An extreme: a named case driven to where numbers, not only structures, become unstable. Pure
 * data. */
#ifndef BEAMWORK_EXTREME_H
#define BEAMWORK_EXTREME_H

#include "cases/scene/scene.h"

enum { EXTREME_MAX_SETTINGS = 8, EXTREME_MAX_QUANTITIES = 4, EXTREME_MAX_VALUES = 12 };

/* parameter = offset + factor x^power */
typedef struct extreme_setting {
    const char *parameter; /* NULL ends the list */
    double offset, factor, power;
} extreme_setting;

typedef struct extreme_quantity {
    const char *name; /* NULL ends the list */
    double power;     /* EXTREME_SAME: the value divided by x^power is the same at every x */
} extreme_quantity;

/* Effect of x besides setting parameters. */
typedef enum extreme_knob {
    EXTREME_PARAMETERS, /* nothing */
    EXTREME_ELEMENTS,   /* x is the number of elements per member */
    EXTREME_STEPS,      /* x is the number of load steps between two stations */
    EXTREME_SPLIT,      /* the first member is split at x of its length */
    EXTREME_REVERSE,    /* 1: every member runs the other way; 0: as it is */
    EXTREME_WHOLE       /* no step of a motion is halved */
} extreme_knob;

typedef enum extreme_judge {
    EXTREME_EXACT, /* against the stored exact value of the same parameters */
    EXTREME_SAME   /* against the same formulation's own value at `base` */
} extreme_judge;

typedef struct extreme {
    const char *name;    /* NULL ends the table */
    const char *group;   /* extremes of the same kind on several cases: one column of a map */
    const char *summary; /* one line */
    const char *base;    /* name of the base case */
    const char *fixed;   /* its parameters: "name=value;..." where they differ from the defaults */
    extreme_setting setting[EXTREME_MAX_SETTINGS];
    extreme_quantity quantity[EXTREME_MAX_QUANTITIES];
    const char *x_name, *x_unit;
    extreme_knob knob;
    int elements; /* per member, where x does not say */
    int values;
    double value[EXTREME_MAX_VALUES]; /* of x */
    extreme_judge judge;
    double same_as;   /* x of the value the others are compared with */
    double tolerance; /* relative, of a value that is not to be called coarse or wrong */
} extreme;

extern const extreme extremes[];

#endif
