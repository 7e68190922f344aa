/* Work that comes from outside: of the loads and of what holds driven coordinates on their way. */
#ifndef BEAMWORK_WORK_H
#define BEAMWORK_WORK_H

#include "harness/time/carried.h"
#include "harness/time/instant.h"

typedef struct work {
    const equations *eq;
    const model *m;
    const carried *masses;
    double *force, *holding; /* [free + driven] room */
    int elements, *element;  /* that driven coordinates move */
} work;

status work_alloc(const equations *, const carried *, work *, fault *);
void work_free(work *);

/* Power [W] at rates v (or work [J] along increments, rotations by vectors in the frames' axes):
 * `along`; the forces are those of the state with rates v and accelerations a, at `time`. */
double work_power(work *, const model_state *, const double v[], const double a[], double time,
                  const double along[]);
/* Of a step: the mean of the forces at its begin and its end along its increment inc[free +
 * driven]. Exact for forces that stay; else of second order. */
double work_trapezoid(work *, const instant *from, const instant *to, const double inc[]);

#endif
