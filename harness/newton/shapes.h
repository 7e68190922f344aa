/* What a structure looks like in chosen states: kept when a solution is asked for it. */
#ifndef BEAMWORK_SHAPES_H
#define BEAMWORK_SHAPES_H

#include "harness/model/model.h"

typedef enum shape_kind {
    SHAPE_UNDEFORMED,
    SHAPE_PATH,
    SHAPE_LINEAR,
    SHAPE_BUCKLING,
    SHAPE_MODE,
    SHAPE_MOTION /* a frame of a motion */
} shape_kind;

typedef struct shape_state {
    shape_kind kind;
    int analysis; /* of the scene; -1: none */
    double value; /* path parameter [1], load factor [1], frequency [Hz] or time [s] */
    double scale; /* the displacements are this many times those of the eigenvector; 1 elsewhere */
} shape_state;

typedef struct shapes {
    int states, members, points, nodes; /* states 0: not asked for */
    int *first;                         /* [members + 1] point where each member begins */
    shape_state *state;                 /* [states] */
    centreline_point *point;            /* [states x points] */
    double *node;                       /* [states x nodes x 3] [m] */
} shapes;

enum { SHAPES_ALL = 1 << 30, SHAPES_MODES = 6, SHAPES_FRAMES = 60, SHAPES_FEW = 5 };

/* Empty arrays for that many of each; FAULT: out of memory. */
status shapes_alloc(shapes *, fault *);
void shapes_free(shapes *);
const char *shapes_kind_name(shape_kind);
/* Frames of a motion, evenly over its time, where at most so many states of a path are kept: as
 * many, and SHAPES_FRAMES where these are all or few. */
int shapes_frames(int most);

#endif
