/* What a condensation consists of. */
#ifndef BEAMWORK_CONDENSATION_IMPL_H
#define BEAMWORK_CONDENSATION_IMPL_H

#include "harness/model/model.h"
#include "harness/newton/chain.h"
#include "harness/newton/condensation.h"

/* More coordinates of ends than this are not condensed: their pattern is made densely. */
enum { MOST_ENDS = 2000, MEMBER_COLUMNS = 2 * NODE_COORDINATES + 2 * SCENE_RELEASED };

typedef struct condensed_member {
    mesh_element ends; /* from the first node of the first element to the last of the last */
    mesh_triad triad[2];
    int first, links, joint, y;
    chain *chain;
} condensed_member;

struct condensation {
    const equations *eq;
    const model *m;
    const model_state *at;
    int members, all, unknowns;
    int lent; /* 1: chains and r are another one's */
    condensed_member *member;
    int *number;   /* [all] of a coordinate of an end among those; NONE: of no end */
    int *unknown;  /* [unknowns] coordinates of the system that is left */
    sparse K;      /* of the ends, in all coordinates */
    sparse inside; /* of the unknowns */
    int *from;     /* [entries of inside] in K */
    matrix_factor *factor;
    double *r;      /* of the longest member: loads, then motions, [links x y] */
    double *small;  /* [unknowns] */
    double *driven; /* [driven] */
    double *end;    /* [members x MEMBER_COLUMNS] forces of the ends */
    int negative;   /* eigenvalues of what was condensed */
    long factorisations;
};

/* condensation_pattern.c: coordinates of ends and, among them, the unknown ones. Returns how many
 * there are of the former; s->unknown NULL: out of memory. */
int condensation_number(condensation *s, int count, const int released[]);
/* Patterns of both. */
status condensation_patterns(condensation *s, int ends, fault *f);

#endif
