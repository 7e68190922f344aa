/* What a formulation offers along one axis only. */
#ifndef BEAMWORK_MODEL_LACKS_H
#define BEAMWORK_MODEL_LACKS_H

#include "harness/model/model.h"

/* What the type offers in one direction only (element_lack) where the scene needs it, in words: 0:
 * nothing, 1: so little of it that it is shown and not refused, 2: missing_words says so too. */
int lacks_of(const scene *, const element_type *, char *words, int size);

#endif
