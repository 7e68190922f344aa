/* What the moment m that acts on a node does while the node turns, and so what its stiffness is.
 * With the stiffness K of the exponential chart R = exp(theta~) R0, in which the generalized moment
 * of theta is constant:
 *   semitangential: K.  The moment follows half of the rotation, m + theta x m/2, and has a
 *                   potential (Argyris et al. 1979)
 *   spatial:        K - m~/2 on the rotations.  The moment is dead about fixed axes; the matrix is
 *                   not symmetric
 *   symmetrised:    the symmetric part of the spatial stiffness; K itself where everything else has
 *                   a potential.
 * A tangent has one of the first two: the spatial one at a node that is held about one axis alone,
 * whose moment keeps its direction (coordinates_held_turn), else the semitangential one. */
#ifndef BEAMWORK_CONVENTION_H
#define BEAMWORK_CONVENTION_H

#include "cases/scene/scene.h"
#include "harness/model/model.h"

/* Does the convention change the stiffness of the tangent's?  Then one column of the compliance
 * depends on all the others. */
int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3]);

/* C[6 x 6] of the tangent, complete in the components that can move, becomes that of the
 * convention, and K[6 x 6] is its inverse on the motions the node can make; where nothing changes C
 * keeps all its digits.  m[3]: moment on the node [N m]. Rows and columns of held components: zero.
 * SINGULAR: C has no inverse there, beside its round-off. */
status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f);

#endif
