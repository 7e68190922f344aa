/* A scene in another unit of length. */
#ifndef BEAMWORK_SCENE_UNIT_H
#define BEAMWORK_SCENE_UNIT_H

#include "cases/scene/scene.h"

/* All lengths in a unit of which there are x in 1 m, x > 0; newtons and seconds stay, so that
 * masses are divided by x. Quantities are reported as before. REFUSED: x is no such
 * number, or a driver moves lengths and angles at once. */
status scene_change_unit(scene *s, double x, fault *f);
/* All forces in a unit of which there are y in 1 N, masses alike; metres and seconds stay.
 * Quantities are reported as before. */
void scene_change_force(scene *s, double y);
/* Do the numbers look like those of another system than SI?  Says which, and why; 0: no. Of scenes
 * without dimensions nothing is said. */
int scene_looks_foreign(const scene *s, char words[FAULT_TEXT]);

#endif
