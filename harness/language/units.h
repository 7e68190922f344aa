/* Units: SI throughout; what else is written is refused with the way to write it. */
#ifndef BEAMWORK_SCENE_UNITS_H
#define BEAMWORK_SCENE_UNITS_H

#include "harness/language/document.h"

/* A mistake where the text is none of the units that values have here. */
void units_check(const document_node *unit, mistakes *m);

#endif
