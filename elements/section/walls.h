/* Sections of straight thin walls: one of the ways to fill a section. */
#ifndef BEAMWORK_SECTION_WALLS_H
#define BEAMWORK_SECTION_WALLS_H

#include "elements/section/section.h"

/* Adds geometry and the shear compliance F to a zeroed section; the material is not its concern.
 * REFUSED: closed cell, disconnected wall, unused point, sizes that are not positive, walls on one line. */
status section_walls(const section_spec *spec, section *out, fault *f);

#endif
