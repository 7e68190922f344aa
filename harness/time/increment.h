/* From a state at one instant to that at another: inc[free + driven], additive for translations,
 * warping and angles, the rotation vector in the frame's axes for rotations of FORM_BODY. */
#ifndef BEAMWORK_INCREMENT_H
#define BEAMWORK_INCREMENT_H

#include "harness/time/forms.h"

/* `to` has the frames of `from` moved by inc; its strains, stresses and inner unknowns stay. */
void increment_apply(const model *, const model_state *from, const double inc[], double time,
                     model_state *to);
/* The increment that spatial increments dx of the state it has led to, still without them, add. */
void increment_add(const model *, const model_state *now, const double dx[], double inc[]);

#endif
