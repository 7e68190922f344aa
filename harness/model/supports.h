/* Whether the supports hold all parts of a structure. */
#ifndef BEAMWORK_MODEL_SUPPORTS_H
#define BEAMWORK_MODEL_SUPPORTS_H

#include "harness/model/model.h"

/* 1: the supports leave a part of the undeformed structure loose: a node of it, and a rigid motion
 * (displacement of that node [m], turn [rad], of any size) that they allow. Coordinates that are
 * driven are held. */
int supports_loose_part(const model *, int *node, double motion[6]);

#endif
