/* What a node must be: its place, supports, fork, body and attachment. */
#ifndef BEAMWORK_SCENE_VALIDATE_NODE_H
#define BEAMWORK_SCENE_VALIDATE_NODE_H

#include "cases/scene/scene.h"

/* REFUSED: the culprit and the remedy, of the node i. */
status scene_validate_node(const scene *s, int i, fault *f);

#endif
