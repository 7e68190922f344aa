/* What a scene needs and a formulation does not offer. */
#ifndef BEAMWORK_MODEL_MISSING_H
#define BEAMWORK_MODEL_MISSING_H

#include "harness/model/model.h"

/* The needs that the type does not offer, or a limit it hits, in words, which are empty if and only
 * if there are none; 0: it can run. */
int missing_words(const scene *, const element_type *, char *words, int size);
/* The limit of the type that a section of so many closed cells hits, in words; NULL: none. */
const char *missing_in_section(const element_type *, const section *, int cells, int warps);

#endif
