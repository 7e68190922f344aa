/* States of elements that differences want, gathered and evaluated together: a function that takes
 * differences is called twice, to hear which states it wants and, when these are known, for its
 * result. */
#ifndef BEAMWORK_GATHER_H
#define BEAMWORK_GATHER_H

#include "elements/element.h"

typedef struct gather {
    int answered;    /* 0: states are gathered; 1: their answers are handed out, in that order */
    int count, next; /* states, and how many of them were handed out */
    int nodes;       /* of a state */
    size_t size;     /* doubles of an answer */
    const element_data **data; /* [count] of the type as it is given */
    node_state *x;             /* [count x nodes] */
    double *answer;            /* [count x size] */
    int room, failed;          /* states that there is room for; 1: no memory */
} gather;

/* What element i makes of its differences, through gather_next. */
typedef void gather_element(void *context, gather *, int i);
/* Fills the answers of states first .. first + count - 1. */
typedef void gather_evaluate(void *context, gather *, int first, int count);
enum { GATHER_TOGETHER = 4096 }; /* states that are evaluated together, at most */

/* Calls element(context, g, i) twice for each of `count`, and evaluate between; with g NULL, once,
 * where there is no memory. */
void gather_run(int count, int nodes, size_t size, gather_element *, gather_evaluate *,
                void *context);
/* The answer for this state [size], or NULL while they are gathered: its value does not count
 * then. x[nodes]. */
const double *gather_next(gather *, const element_data *own, const node_state x[]);

#endif
