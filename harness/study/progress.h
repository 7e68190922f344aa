/* How far a long run is, in one line of a terminal that is written over and taken away at the end.
 */
#ifndef BEAMWORK_PROGRESS_H
#define BEAMWORK_PROGRESS_H

#include <stdio.h>

typedef struct progress {
    FILE *to;           /* NULL: nothing is said */
    const char *things; /* "cells" */
    int count;          /* of them */
    double begun;       /* [s] of clock_wall_seconds */
    double last;        /* [s] when something was said */
    int width;          /* columns of what stands there now */
} progress;

/* now: [s] of clock_wall_seconds, here and below. */
progress progress_begin(FILE *to, const char *things, int count, double now);
/* Is it time to say something again? */
int progress_is_due(const progress *, double now);
/* "cells 12 of 40, 25 %, about 3 min left: WHAT". share: of the whole work that is done, 0 to 1;
 * the time left is reckoned from it once it means something. */
void progress_show(progress *, double now, int done, double share, const char *what);
/* The line is as empty as before. */
void progress_end(progress *);

#endif
