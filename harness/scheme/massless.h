/* Coordinates without inertia: their positions follow from balance at every instant. */
#ifndef BEAMWORK_MASSLESS_H
#define BEAMWORK_MASSLESS_H

#include "harness/inertia/carried.h"

/* Free coordinates less the rank of their masses in the state. */
status massless_count(const model *, const carried *, const model_state *, int *count, fault *);

#endif
