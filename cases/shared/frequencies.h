/* Natural frequencies as quantities of a case. */
#ifndef BEAMWORK_CASES_FREQUENCIES_H
#define BEAMWORK_CASES_FREQUENCIES_H

#include "cases/scene/scene.h"

/* The lowest `count` of the family, [Hz], as quantities STEM_1, STEM_2, ... that converge with
 * order 1.8 at least. analysis: modal, or a stationary rotation. */
void frequencies_add(scene *s, const char *stem, int analysis, scene_family family, int count);
/* The same as angular frequencies; their time is counted in the case's own unit. */
void frequencies_add_angular(scene *s, const char *stem, int analysis, scene_family family,
                             int count);

#endif
