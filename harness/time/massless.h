/* What has inertia and what has none: of the coordinates of a body and of the ends that are
 * released from it, some motions may be without. Their positions follow from balance at every
 * instant. */
#ifndef BEAMWORK_MASSLESS_H
#define BEAMWORK_MASSLESS_H

#include "harness/time/carried.h"

/* Free coordinates less the rank of their masses in the state. */
status massless_count(const model *, const carried_masses *, const model_state *, int *count,
                      fault *);
/* force[free], dx[free] (spatial increments of rotations): what of them works on, or is, motion
 * without inertia. */
status massless_forces(const model *, const carried_masses *, const model_state *, double force[],
                       fault *);
status massless_motion(const model *, const carried_masses *, const model_state *, double dx[],
                       fault *);
/* a[free] as rates have it (forms.h) loses the motion without inertia. */
status massless_drop(const model *, const carried_masses *, const model_state *, double a[],
                     fault *);
/* Spatial turns of bodies -> as rates have them (forms.h): a[free]. */
void massless_own_axes(const model *, const model_state *, double a[]);
/* The largest stiffness of what has inertia, by that [1/s^2]; diagonal[free]: of a stiffness. */
status massless_stiffest(const model *, const carried_masses *, const model_state *,
                         const double diagonal[], double *, fault *);
/* a[free] that forces give what has inertia, as rates have it (forms.h); 0 for what has none. */
status massless_accelerate(const model *, const carried_masses *, const model_state *,
                           const double force[], double a[], fault *);

#endif
