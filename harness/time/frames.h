/* States of a motion for pictures, evenly over its time, between the ends of its steps, too. */
#ifndef BEAMWORK_FRAMES_H
#define BEAMWORK_FRAMES_H

#include "harness/newton/newton.h"
#include "harness/time/between.h"

typedef struct frames {
    const equations *eq;
    const model *m;
    outcome_path *to;
    double begin, end; /* [s] of the motion */
    step_between inside;
    instant at;
} frames;

/* m, to, begin and end are given; count 0: no pictures. */
status frames_alloc(frames *, int count, fault *);
void frames_free(frames *);
/* The motion is where it begins. */
status frames_begin(frames *, const instant *now, fault *);
status frames_step(frames *, between_degree, const instant *from, const instant *to, fault *);

#endif
