/* What motions in time must be, and the functions of time that they meet. */
#ifndef BEAMWORK_SCENE_VALIDATE_MOTION_H
#define BEAMWORK_SCENE_VALIDATE_MOTION_H

#include "cases/scene/scene.h"

/* REFUSED: the culprit. The scene's nodes, members, drivers and loads are sound. */
status scene_validate_motion(const scene *s, int analysis, fault *f);
/* REFUSED: nothing moves with inertia, and the analysis is of such a motion. */
status scene_validate_mass(const scene *s, int analysis, fault *f);
/* The functions of drivers and loads, also where no analysis is in time. */
status scene_validate_functions(const scene *s, fault *f);

#endif
