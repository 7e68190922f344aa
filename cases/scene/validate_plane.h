/* Whether all of a scene that is held in a plane lies and acts in it. */
#ifndef BEAMWORK_SCENE_VALIDATE_PLANE_H
#define BEAMWORK_SCENE_VALIDATE_PLANE_H

#include "cases/scene/scene.h"

/* REFUSED: what lies, moves or acts out of the plane, and the remedy. */
status scene_validate_plane(const scene *s, fault *f);

#endif
