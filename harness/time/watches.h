/* What a motion passes through between its stations: largest and least values, crossings of a
 * level, means. Roots are those of the polynomial inside a step, to round-off. */
#ifndef BEAMWORK_WATCHES_H
#define BEAMWORK_WATCHES_H

#include "harness/time/between.h"
#include "harness/time/scheme.h"

/* One quantity. */
typedef struct watched {
    const scene_quantity *q;
    outcome_passing *out;
    double from, until; /* [s] */
    double noise;       /* values nearer to the level than that have no sign */
    int side;           /* of the level that was left last; 0: none yet */
    int crossings;      /* of its direction, in the window */
    double first, last; /* [s] of them */
    double error;       /* [s] of the first one and the last */
    double sum, span;   /* of values by time; [s] */
} watched;

typedef struct watches {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    outcome_motion *out;
    int count;
    watched *one; /* [count] */
    step_between inside;
    instant at;
} watches;

/* c, analysis, scheme and out are given. */
status watches_alloc(watches *, fault *);
void watches_free(watches *);
status watches_step(watches *, const instant *from, const instant *to, fault *);
/* The motion is over. */
void watches_end(watches *);

#endif
