/* Functions and constants of expressions, and which of them functions of time have. */
#ifndef BEAMWORK_FUNCTIONS_H
#define BEAMWORK_FUNCTIONS_H

#include "cases/scene/jet.h"

typedef struct expression_function {
    const char *name;
    int arguments; /* 0: a constant; -1: two or more */
    double value;  /* of a constant */
    double (*of_one)(double);
    double (*of_two)(double, double); /* of more: taken again and again */
    int kinked;                       /* 1: it has kinks or jumps */
    jet_operation in_time; /* JET_NUMBER: none, of what changes in time it cannot be taken */
} expression_function;

/* The function or constant with that name of `length` bytes, or NULL. */
const expression_function *functions_find(const char *name, int length);
/* The i-th name, or NULL behind the last. */
const char *functions_name(int i);

#endif
