/* Times of all cells of a sweep that has been run, in rounds over the cells of a point. */
#ifndef BEAMWORK_TIMING_H
#define BEAMWORK_TIMING_H

#include "harness/study/dense_reference.h"
#include "harness/study/rounds.h"
#include "harness/study/sweep.h"

/* Repeated runs of a cell, as it is and with nothing left out (--keep-all). */
typedef struct cell_timing {
    rounds_reading as_is, keep_all; /* rounds = 0: not measured */
    int free_keep_all;              /* unknowns when nothing is left out */
    /* [s] of the solution in one run more, in which the clock is read between the parts of the
     * iterations */
    double phase[PHASES];
    dense_reference dense; /* when asked for */
} cell_timing;

/* floor: least [s] a round spends on a cell. Of several points the defaults are measured in full:
 * there the parts of an iteration too, and what is left out, on the middle mesh of each
 * formulation; elsewhere rounds are short and long cells keep the time of their one run. Cells that
 * crashed are not run again. dense: the published algorithm is timed too. to: of the progress, or
 * NULL. */
status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f);

#endif
