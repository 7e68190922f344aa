/* Linear solutions about the undeformed state. */
#ifndef BEAMWORK_LINEAR_SYSTEM_H
#define BEAMWORK_LINEAR_SYSTEM_H

#include "harness/newton/context.h"

/* A linear solution about the undeformed state: x[free + driven] of K x = f, with the factors of K
 * kept for the caller. */
typedef struct linear_system {
    sparse K;
    matrix_factor *factor;
} linear_system;
status linear_system_alloc(analysis_context *, linear_system *, fault *);
void linear_system_free(linear_system *);
/* Loads and drivers at `path`. */
status linear_system_solve(analysis_context *, linear_system *, double path, double x[], fault *);

#endif
