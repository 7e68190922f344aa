/* Structures that several tests load in their own ways. */
#ifndef BEAMWORK_TEST_SCENES_H
#define BEAMWORK_TEST_SCENES_H

#include "cases/scene/scene.h"

/* A bar of 1 m along x, clamped at the origin; its section's y axis is that of the scene. Returns
 * its free tip; the root is the node before it. */
int scenes_cantilever(scene *, const section_spec *);

#endif
