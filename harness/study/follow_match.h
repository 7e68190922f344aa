/* Shapes of modes at one value of a parameter, and which of them are those of another. */
#ifndef BEAMWORK_FOLLOW_MATCH_H
#define BEAMWORK_FOLLOW_MATCH_H

#include "harness/newton/newton.h"

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] with those of before */
    double *shape;     /* [modes x rows] of unit mass */
} follow_shapes;

/* The first `modes` of a state. */
status follow_match_first(const state_matrices *, int modes, follow_shapes *out, fault *);
/* Those of `before` among the modes of a state. *least: the worst match; 0 where two would be the
 * same mode. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

#endif
