/* Inside of follow.h: what its files share. */
#ifndef BEAMWORK_FOLLOW_IMPL_H
#define BEAMWORK_FOLLOW_IMPL_H

#include "harness/study/follow.h"
#include "harness/study/follow_match.h"

static const double follow_sure = 0.9; /* match of two shapes that are one mode */

typedef struct follow_walk {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_walk;

/* follow_solve.c: the modes at a value, matched with those of before (NULL: the first ones), and
 * the worst match. */
status follow_solve(follow_walk *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* follow_events.c: crossings within the last step; *least: the worst match on the way there. Shapes
 * that change places within one step (a veering) do not match where the frequencies would meet. */
status follow_events_step(follow_walk *, double *least, fault *);
/* Crossings at samples, and veerings; all in the order of their values. */
status follow_events_rest(follow_walk *, fault *);

#endif
