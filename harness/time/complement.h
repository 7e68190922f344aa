/* Strains that belong to the stresses of the state, where the stress function P' of elements is not
 * linear. Newton's increment de leaves sigma = P'(e) + P''(e) de, yet at the new strains P' is off
 * by P''' de^2 / 2: in a member that is stiff in elongation thousands of times what it carries,
 * which the next tangent would take for a force in it. So the strains give way instead, to
 * P'(e) = sigma, and D(x) - e holds the difference: the same equations, from the complementary side
 * (Hellinger-Reissner). Where they converge to does not change. */
#ifndef BEAMWORK_COMPLEMENT_H
#define BEAMWORK_COMPLEMENT_H

#include "elements/shared/status.h"
#include "harness/newton/newton.h"

typedef struct complement complement; /* of one state */

/* NULL where there is nothing to do: stresses of all kinds of elements are linear in their strains;
 * they depend on unknowns of the element besides; or the type is asked for all elements at once
 * (another process), which would have to be asked again and again. */
status complement_alloc(const equations *, complement **out, fault *);
void complement_free(complement *);

/* Before advance_state. NULL: nothing. */
void complement_keep(complement *, const model_state *);
/* After it: e of every element, along the stresses from those that were kept to sigma, which stays.
 * An element stays as it is where its stresses agree to a tenth already, and where no strains
 * are found that have them. iteration: from 1; once all elements agree, corrections that are no
 * larger are not looked at in the same step. NULL: nothing. */
void complement_strains(complement *, model_state *, int iteration, double correction);

#endif
