/* A motion inside one of its steps: a polynomial of every coordinate's increment, that of rotations
 * of the vector in the frame's axes at the begin, with the places and rates of both ends, and where
 * a scheme has them as exactly, with the accelerations too. What is driven is read where it is
 * prescribed. */
#ifndef BEAMWORK_BETWEEN_H
#define BEAMWORK_BETWEEN_H

#include "harness/newton/newton.h"
#include "harness/time/instant.h"

typedef enum between_degree {
    BETWEEN_CUBIC,  /* of places and rates: order 4 inside a step; accelerations run linearly */
    BETWEEN_QUINTIC /* of accelerations too: order 6 */
} between_degree;

typedef struct step_between {
    const equations *eq;
    const model *m;
    const instant *from, *to;
    between_degree degree;
    double *part; /* [free + driven] x 5: of s, s^2 .. s^5; s = 0 .. 1 along the step */
    double *room; /* [3 x (free + driven)] */
} step_between;

status between_alloc(const equations *, step_between *, fault *);
void between_free(step_between *);
/* Of the step; both instants stay as they are as long as it is read. */
void between_take(step_between *, between_degree, const instant *from, const instant *to);
/* Places and rates at a time of the step, or next to it [s]. */
void between_places(const step_between *, double time, instant *at);
/* With all of a state. Strains, stresses and inner unknowns
 * run linearly from end to end: fit for pictures, not for forces. */
void between_at(const step_between *, double time, instant *at);

#endif
