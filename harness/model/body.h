/* Inertia of a rigid body that moves with a node. */
#ifndef BEAMWORK_MODEL_BODY_H
#define BEAMWORK_MODEL_BODY_H

#include "cases/scene/scene.h"
#include "elements/element.h"

/* Of the node's coordinates [7: translation, spatial turn, warping (not moved)], its frame at x:
 * position, and turn since the undeformed state in R.  frame NULL: the frame is at rest. */
void body_inertia(const scene_body *, const node_state *x, const element_rotating_frame *frame,
                  inertia_output *);

#endif
