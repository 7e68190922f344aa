/* A function of time in pieces, each a formula: between them it may have kinks and jumps, where no
 * step goes across. */
#ifndef BEAMWORK_FUNCTION_H
#define BEAMWORK_FUNCTION_H

#include "cases/scene/formula.h"

typedef struct scene_piece {
    double until; /* [s]; of the last: for ever */
    char *text;
    formula *is; /* NULL: text is wrong, see function_check */
} scene_piece;

typedef struct scene_function {
    int pieces;
    scene_piece *piece; /* [pieces] ascending */
    double scale;       /* of its value; 0: 1 */
} scene_function;

/* A further piece, behind those that there are; text is copied. -1: out of memory. */
int function_add(scene_function *, double until, const char *text);
/* The pieces of another one, and its scale; `to` has none yet. -1: out of memory. */
int function_copy(scene_function *to, const scene_function *from);
void function_free(scene_function *);
/* REFUSED: what is wrong with it. */
status function_check(const scene_function *, fault *);
/* Value and first two derivatives at t; at the end of a piece: of the next one. */
void function_at(const scene_function *, double t, double out[3]);
/* Is it finite from 0 to `end`, with so many of its derivatives (0 to 2), at both ends of all
 * pieces and at 63 instants between? 0: not at *time. */
int function_finite(const scene_function *, double end, int derivatives, double *time);
/* Do value and velocity go on from piece to piece before `end`? 0: not at *time, the value
 * (*derivative 0) or the velocity (1). */
int function_smooth(const scene_function *, double end, double *time, int *derivative);

#endif
