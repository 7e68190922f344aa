/* An element or a spring over a step: what differs is only who evaluates it. */
#ifndef BEAMWORK_DEFORMABLE_H
#define BEAMWORK_DEFORMABLE_H

#include "harness/model/model.h"
#include "harness/time/cayley_slopes.h"
#include "harness/time/conserving_impl.h"

enum {
    DEFORMABLE_POINTS = 2, /* between the ends of a step */
    DEFORMABLE_STRAINS = ELEMENT_MAX_STRAINS,
    DEFORMABLE_COORDINATES = MODEL_MAX_COORDINATES
};

typedef struct deformable {
    const mesh_element *el;
    const mesh_discrete *spring; /* NULL: an element */
    int index;                   /* of the element */
    int strains, coordinates;    /* 7 nodes */
    const double *before;        /* sigma_n */
    double *W, *C_before;        /* mean of P'' at the ends of the step; P''(e_n) */
    double *e, *sigma, *d;       /* of the present iteration */
    /* Kept from one iteration's evaluation to its update. */
    double *J;             /* [strains x coordinates] de/dx at the end by dr, c, da */
    double *C, *memory;    /* P''(e) [strains x strains]; of stress */
    double *present;       /* [strains] P'(e) */
    double *gap_e, *gap_d; /* [strains] D(x_1) - e, A (dr, c, da) - d */
    const double *S;       /* S0 of a damped member, else NULL */
    double damping;        /* eta [s] of it */
    double length;         /* [m] that incompatibilities are relative to */
} deformable;

/* Number of them, the springs behind the elements, and each of them. */
int deformable_count(const conserving *);
deformable deformable_at(const conserving *, const instant *from, model_state *now, int i);
/* How many behind `first`, and it, are evaluated in one go: elements of one kind, or 1. */
int deformable_together(const conserving *, int first);

/* What one iteration evaluates of one of them. */
struct evaluation {
    deformable of;
    cayley_step step;
    cayley_point point[DEFORMABLE_POINTS];
    node_state first[ELEMENT_MAX_NODES], last[ELEMENT_MAX_NODES];
    double turn[DEFORMABLE_POINTS + 1][3]; /* of a spring: where its vector has come to */
    double middle[DEFORMABLE_STRAINS];     /* (sigma_n + P'(e))/2 + k W d */
    double D[DEFORMABLE_STRAINS];
    double J[DEFORMABLE_POINTS][DEFORMABLE_STRAINS * ELEMENT_MAX_COORDINATES];
    double H[DEFORMABLE_POINTS][ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES]; /* middle */
    /* Their equations: forces on dr, c, da of the coordinates, its tangent, the column A^T W d and
     * the row k_e + k_d. */
    double force[DEFORMABLE_COORDINATES], column[DEFORMABLE_COORDINATES],
        row[DEFORMABLE_COORDINATES];
    double K[DEFORMABLE_COORDINATES * DEFORMABLE_COORDINATES];
};

/* evaluation.c: strains and their derivatives of count deformables `of`, elements of one kind
 * where they are more than one. */
void deformable_evaluate(const conserving *, const instant *from, const model_state *now, int count,
                         evaluation[]);

#endif
