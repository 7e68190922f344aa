/* A case: a table of parameters and a function from their values to a scene.
 * One file in cases/ defines one const case_type whose symbol is case_<file name>. */
#ifndef BEAMWORK_CASE_H
#define BEAMWORK_CASE_H

#include "cases/scene/scene.h"

enum { CASE_MAX_PARAMETERS = 32 };

typedef struct case_parameter {
    const char *name;    /* NULL ends the table */
    const char *unit;    /* SI; "1" for a number, "" for a choice */
    double value;        /* default; of a choice: its index */
    double min, max;     /* inclusive; of a choice: unused */
    const char *choices; /* "shear_flow|printed|misprinted", or NULL for a number */
    const char *summary; /* one line */
} case_parameter;

typedef struct case_type {
    const char *name, *summary, *source;
    const case_parameter *parameters;
    /* value[i] belongs to parameters[i] and is inside its range.  Refuses combinations that make no sense. */
    status (*build)(const double value[], scene *s, fault *f);
} case_type;

#endif
