/* Structures that several tests load in their own ways. */
#ifndef BEAMWORK_TEST_SCENES_H
#define BEAMWORK_TEST_SCENES_H

#include "cases/scene/scene.h"

/* A straight section by its products [N, N, N m^2, N m^2] and [kg/m, kg m]. */
typedef struct timed_section {
    double EA, GA, GJ, EI, mass, polar, rotary;
} timed_section;
section_spec timed_profile(const timed_section *);

/* A bar of 1 m along x, clamped at the origin; its section's y axis is that of the scene. Returns
 * its free tip; the root is the node before it. */
int scenes_cantilever(scene *, const section_spec *);
/* Quantities NAME_0, NAME_1, ...: the first frequencies [Hz] of an analysis. */
void scenes_ask_frequencies(scene *, const char *name, int analysis, int count);
/* NAME_0 to NAME_2: displacements [m] of a node at the end of an analysis. */
void scenes_ask_motion(scene *, const char *name, int analysis, int node);

#endif
