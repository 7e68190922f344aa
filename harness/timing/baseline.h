/* The published algorithm beside ours: all coordinates, strains and stresses at once, dense Gaussian elimination (newton=dense). */
#ifndef BEAMWORK_BASELINE_H
#define BEAMWORK_BASELINE_H

#include "harness/timing/clock.h"

typedef struct baseline {
    int unknowns;        /* of the dense system; 0: not measured */
    double iteration;    /* [s] least time of one iteration */
    clock_reading whole; /* of whole runs, where these are short enough; else rounds = 0 */
} baseline;

/* One more round beside those of the cell itself, which was solved with the result `cell`; nothing for linear or very large ones. */
void baseline_round(const cell_request *own, const cell_result *cell, double floor, baseline *out);
/* [s] of a run: measured, or the time of one iteration times their number (the iterations are the same); INFINITY: not measured. */
double baseline_seconds(const baseline *b, long iterations);

#endif
