/* What each row of the matrices of a model belongs to. */
#ifndef BEAMWORK_MODEL_ROWS_H
#define BEAMWORK_MODEL_ROWS_H

#include "harness/model/model.h"

typedef struct row_label {
    int node;   /* of the scene; SCENE_NONE: inside a member, or an end that keeps motions to itself
                 */
    int member; /* SCENE_NONE: of the node alone */
    double along; /* from the member's beginning, in parts of its length; NAN: of a node alone */
    double position[3];    /* undeformed [m] */
    const char *component; /* "ux", ..., "rz", "angle 1" of a sequence, "turn 1" and "shift 1" of a
                              released end, "warping" */
    const char *unit;      /* of the coordinate: "m", "rad", "rad/m" */
} row_label;

/* out[free]; a coordinate that several nodes share is the first one's. */
void rows_label(const model *, row_label out[]);

#endif
