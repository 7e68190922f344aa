/* Loads along members as they act between vertices: their work on the displacements within elements
 * (elements/field), and what goes through sections. */
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

/* Does the load do its work within elements? Else halves of it go to their ends (applied.h). */
int distributed_spreads(const model *, const scene_load *);
/* forces[7 nodes] += what a load along a member times `scale` does on an element, K[7 nodes x 7
 * nodes] -= its derivative (NULL: not wanted); 0: nothing. */
int distributed_add_one(const model *, const node_state x[], int element, const scene_load *,
                        double scale, double forces[], double K[]);
/* The same of all of them at `path`. */
int distributed_add(const model *, const node_state x[], int element, double path, double forces[],
                    double K[]);

/* Does anything act along it? */
int distributed_acts(const distributed *);
/* A load that begins, ends or acts between its ends, or SCENE_NONE. */
int distributed_jumps(const distributed *);
/* What acts per initial length at x in [0, 1] of the element, on a section with this frame: loads
 * of its member, and what a rotating frame adds (of the section's turn too where rotary inertia is
 * active).  context: a distributed. */
void distributed_at(void *context, double x, const span_frame *, span_load *out);

#endif
