/* A case: a table of parameters and a function from their values to a scene.
 * One file in cases/ defines one const case_type whose symbol is case_<file name>. */
#ifndef BEAMWORK_CASE_H
#define BEAMWORK_CASE_H

#include "cases/scene/scene.h"
#include "elements/shared/parameter.h"

enum { CASE_MAX_PARAMETERS = 32 };

typedef struct case_type {
    const char *name, *summary, *source;
    const parameter_type *parameters;
    /* value[i] belongs to parameters[i] and is inside its range.  Refuses combinations that make no sense. */
    status (*build)(const double value[], scene *s, fault *f);
} case_type;

#endif
