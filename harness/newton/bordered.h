/* Solutions of a tangent that what is released borders (tangent.c). */
#ifndef BEAMWORK_BORDERED_H
#define BEAMWORK_BORDERED_H

#include "harness/newton/tangent.h"

/* Factors of the bordered system. */
typedef struct bordered {
    double *Z; /* [count x free] K^-1 U */
    double S[TANGENT_BORDER * TANGENT_BORDER];
    int pivot[TANGENT_BORDER];
    double *solution;                 /* [TANGENT_COMPONENTS x all] for unit loads */
    double *x, *load, *rest, *weight; /* [all] of one that is refined */
} bordered;

/* SINGULAR: not held when the prescribed motion is released. Freed by bordered_free in either
 * case. */
status bordered_alloc(node_tangent *t, counters *n, bordered *out, fault *f);
void bordered_free(bordered *s);
/* In place; what is held or prescribed stays as it is. x: [columns x all] */
void bordered_solve(node_tangent *t, counters *n, const bordered *s, int columns, double x[]);
/* Iterative refinement of s->x for s->load, with residuals whose stiff part comes from the element
 * strains (refinement.h). SINGULAR: round-off leaves too few digits. */
status bordered_refine(const equations *eq, node_tangent *t, const bordered *s, fault *f);

#endif
