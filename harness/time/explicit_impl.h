/* Inside of the explicit integrator. */
#ifndef BEAMWORK_EXPLICIT_IMPL_H
#define BEAMWORK_EXPLICIT_IMPL_H

#include <gsl/gsl_odeiv2.h>

#include "harness/time/scheme.h"

typedef struct explicit_scheme {
    motion_scheme base;
    scheme_request of;
    gsl_odeiv2_step *stepper;
    int free, all;
    double *y, *error, *dydt; /* [2 x free + 1] increments, rates, work; GSL's estimate; at the end
                               */
    double *inc, *residual;   /* [free + driven] */
    double *memory, *still;   /* of one element: as its type has it; no increment of strains */
    double *weight;           /* [free + driven] model.h */
    const instant *from;      /* of the present step */
    double end;               /* [s] where its last loads are read */
    instant *at;              /* the last evaluation */
    status outcome;           /* of it */
    fault why;
} explicit_scheme;

/* explicit_rates.c: dydt at t [s] and y, GSL's way; the motion there is left in `at`. */
int explicit_rates(double t, const double y[], double dydt[], void *context);

/* explicit_mass.c: a[free] = M^-1 of the residual, which has what the driven accelerations of a
 * take. SINGULAR: a sequence of angles is where two of them turn about one axis. */
status explicit_accelerate(const model *, const carried_masses *, const model_state *,
                           const double v[], const double residual[], double a[], fault *);
/* REFUSED: a coordinate of the undeformed model has no inertia. */
status explicit_check(const model *, const carried_masses *, fault *);

#endif
