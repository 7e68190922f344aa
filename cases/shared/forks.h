/* A column between forks. */
#ifndef BEAMWORK_CASES_FORKS_H
#define BEAMWORK_CASES_FORKS_H

#include "cases/scene/scene.h"

/* One member along x of that length [m], its section's y axis that of the scene. Held: u, v, w and
 * the twist at ends[0], v, w and the twist at ends[1]; bending rotations and warping are free, and
 * moments are about z. */
void forks_column(scene *s, const section_spec *spec, double length, int ends[2]);

#endif
