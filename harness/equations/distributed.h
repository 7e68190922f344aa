/* Loads along members as they act between vertices: what applied.h lumps. */
#ifndef BEAMWORK_MODEL_DISTRIBUTED_H
#define BEAMWORK_MODEL_DISTRIBUTED_H

#include "harness/model/model.h"
#include "harness/recovery/span.h"

/* Of one element, at a path parameter. */
typedef struct distributed {
    const model *m;
    int element;
    double path;
} distributed;

/* Does anything act along it? */
int distributed_acts(const distributed *);
/* What acts per initial length at x in [0, 1] of the element, on a section with this frame: loads
 * of its member, and what a rotating frame adds (of the section's turn too where rotary inertia is
 * active).  context: a distributed. */
void distributed_at(void *context, double x, const span_frame *, span_load *out);

#endif
