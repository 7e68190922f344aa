/* What quantities read of a state beyond its places and rates: reactions, resultants, stresses. */
#ifndef BEAMWORK_MOTION_RESULTANTS_H
#define BEAMWORK_MOTION_RESULTANTS_H

#include "harness/newton/newton.h"

/* As extracted, without factor and offset, of SCENE_REACTION, SCENE_INTERNAL and SCENE_STRESS. v,
 * a[free + driven]: rates of a motion and their derivatives; NULL: nothing moves. */
status resultants_of(const equations *, const scene_quantity *, const model_state *,
                     const double v[], const double a[], double *out, fault *);
/* Of a section, in any state that internal.h knows. */
status resultants_in_section(const equations *, const scene_quantity *, const internal_state *,
                             double *out, fault *);

#endif
