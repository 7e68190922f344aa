/* A scene in another unit of length. */
#ifndef BEAMWORK_SCENE_UNIT_H
#define BEAMWORK_SCENE_UNIT_H

#include "cases/scene/scene.h"

/* All lengths in a unit of which there are x in 1 m, x > 0; newtons and seconds stay, so that
 * masses are divided by x. Quantities are reported as before, curves are not. REFUSED: x is no such
 * number, or a driver moves lengths and angles at once. */
status scene_change_unit(scene *s, double x, fault *f);

#endif
