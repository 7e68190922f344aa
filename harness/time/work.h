/* Work that comes from outside: of the loads and of what holds driven coordinates on their way. */
#ifndef BEAMWORK_WORK_H
#define BEAMWORK_WORK_H

#include "harness/time/carried.h"
#include "harness/time/instant.h"

typedef struct outer_work {
    const equations *eq;
    const model *m;
    const carried_masses *masses;
    double *force, *holding; /* [free + driven] room */
    int elements, *element;  /* that driven coordinates move */
} outer_work;

status work_alloc(const equations *, const carried_masses *, outer_work *, fault *);
void work_free(outer_work *);

/* Power [W] at rates v (or work [J] along increments, rotations by vectors in the frames' axes):
 * `along`; the forces are those of the state with rates v and accelerations a, at `time`. */
double work_power(outer_work *, const model_state *, const double v[], const double a[],
                  double time, const double along[]);
/* Of a step: the mean of the forces at its begin and its end along its increment inc[free +
 * driven]. Exact for forces that stay; else of second order. */
double work_trapezoid(outer_work *, const instant *from, const instant *to, const double inc[]);

#endif
