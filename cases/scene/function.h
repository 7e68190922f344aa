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
void function_free(scene_function *);
/* REFUSED: what is wrong with it. */
status function_check(const scene_function *, fault *);
/* Value and first two derivatives at t; at the end of a piece: of the next one. */
void function_at(const scene_function *, double t, double out[3]);

#endif
