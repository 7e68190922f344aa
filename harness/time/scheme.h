/* What all integrators of motions are: one step from an instant to another. */
#ifndef BEAMWORK_SCHEME_H
#define BEAMWORK_SCHEME_H

#include "harness/newton/newton.h"
#include "harness/time/between.h"
#include "harness/time/carried.h"
#include "harness/time/work.h"

typedef struct scheme_request {
    analysis_context *c;
    const carried_masses *masses;
    const scene_motion *how;
    outer_work *work; /* of what acts from outside: for instant.work */
    int estimate;     /* 1: the error of each step is wanted */
} scheme_request;

typedef struct motion_scheme motion_scheme;
struct motion_scheme {
    int order;             /* of the error of one step that is estimated, in its size */
    int adds;              /* 1: the estimates add up to the error of the motion; 0: they are of a
                              lower order and far above it */
    const double *light;   /* what has no inertia and is in no error: metric_distance; NULL: none,
                              or not known before the first step */
    between_degree degree; /* inside a step; quintic: accelerations are as exact as rates */
    /* One step of h [s]; *error: estimate of what it adds to positions, in the measure of
     * model.h. NOT_CONVERGED: `to` is of no use, `from` is as it was. */
    status (*step)(motion_scheme *, const instant *from, double h, instant *to, double *error,
                   step_record *, fault *);
    void (*free)(motion_scheme *);
};

#endif
