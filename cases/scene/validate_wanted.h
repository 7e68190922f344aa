/* What the analyses and quantities of a scene must be. */
#ifndef BEAMWORK_SCENE_VALIDATE_WANTED_H
#define BEAMWORK_SCENE_VALIDATE_WANTED_H

#include "cases/scene/scene.h"

/* REFUSED: the culprit and the remedy, of the analysis or quantity i. */
status scene_validate_analysis(const scene *s, int i, fault *f);
status scene_validate_quantity(const scene *s, int i, fault *f);

#endif
