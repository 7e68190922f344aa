/* Which nodes of a scene are moved by themselves, and carry faces of solids. */
#ifndef BEAMWORK_RIGID_H
#define BEAMWORK_RIGID_H

#include "cases/scene/scene.h"

/* Node whose body a node is part of: itself where it is attached to none. */
int rigid_body(const scene *s, int node);
/* Is it a body, or a node of its own, at which a member ends? */
int rigid_moves(const scene *s, int node);
/* One turn about x, y or z and no other: its axis 0, 1 or 2; SCENE_NONE: it turns otherwise. */
int rigid_single_axis(const scene_node *n);

#endif
