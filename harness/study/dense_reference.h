/* The published algorithm beside ours: all coordinates, strains and stresses at once, dense
 * Gaussian elimination (newton=dense). */
#ifndef BEAMWORK_DENSE_REFERENCE_H
#define BEAMWORK_DENSE_REFERENCE_H

#include "harness/study/rounds.h"

typedef struct dense_reference {
    int unknowns;         /* of the dense system; 0: not measured */
    double iteration;     /* [s] least time of one iteration */
    rounds_reading whole; /* of whole runs, where these are short enough; else rounds = 0 */
} dense_reference;

/* One more round beside those of the cell itself, which was solved with the result `cell`; nothing
 * for linear or very large ones. */
void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out);
/* [s] of a run: measured, or the time of one iteration times their number (the iterations are the
 * same); INFINITY: not measured. */
double dense_reference_seconds(const dense_reference *b, long iterations);

#endif
