/* What is released of the prescribed motion of a node borders the tangent of the free coordinates.
 */
#ifndef BEAMWORK_BORDER_H
#define BEAMWORK_BORDER_H

#include "harness/newton/context.h"

enum { TANGENT_COMPONENTS = 6, TANGENT_BORDER = 12 };

/* Released coordinates: driven ones that are free now. */
typedef struct border {
    int count;
    int coordinate[TANGENT_BORDER];
    double *U, *V; /* [count x free]: K_fr; K_rf */
    double W[TANGENT_BORDER * TANGENT_BORDER];
} border;

/* Index of a released coordinate, or -1. */
int border_place(const border *, int coordinate);
/* Those of the analysis' node; the matrices have room and no values. */
status border_alloc(const analysis_context *, const scene_compliance *, border *, fault *);
void border_free(border *);
/* From K of all coordinates. */
void border_fill(border *, int free_count, const sparse *K);

#endif
