/* What a deck of solids carries of a scene: everything else is refused, never left out. */
#ifndef BEAMWORK_CARRIED_H
#define BEAMWORK_CARRIED_H

#include "cases/scene/scene.h"

/* The one static analysis, or SCENE_NONE. */
int carried_static(const scene *s);
/* REFUSED: names what of the structure and its analyses no deck says, and what to do. */
status carried_check(const scene *s, fault *f);
/* The same of the quantities. */
status carried_asked_check(const scene *s, fault *f);

#endif
