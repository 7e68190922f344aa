/* What an end of a member does with its warping where nobody says it. */
#ifndef BEAMWORK_SCENE_WARPING_H
#define BEAMWORK_SCENE_WARPING_H

#include "cases/scene/scene.h"

/* An end of a member of which nobody has said anything yet. */
enum { SCENE_WARP_BY_SUPPORT = -3 };

/* Gives every end that is SCENE_WARP_BY_SUPPORT what its support does.  Held: all six components of
 * its node are held or driven, or the node is part of a rigid body, or one that
 * members or springs are joined to at other nodes too.
 * Free: a turn is released there, or the node is a fork, is free or has only a mass.  Where
 * exactly two members meet at such a node and run on in one line with one section in the same axes,
 * nothing releases and nobody says anything, they share it: a node does not cut a beam. */
void scene_warping_by_supports(scene *s);

#endif
