/* How long runs of cells take: rounds over the cells of a parameter point, for all cells of a sweep
 * that has been run. */
#ifndef BEAMWORK_EXPERIMENTS_TIMING_H
#define BEAMWORK_EXPERIMENTS_TIMING_H

#include "harness/study/study.h"

/* One more round: repeats until `floor` [s] of the processor's time are spent, at least once. A
 * cell that fails has a time too. */
void rounds_run(const cell_request *request, double floor, rounds_reading *out);
/* One more round beside those of the cell itself, which was solved with the result `cell`; nothing
 * for linear or very large ones. */
void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out);

/* floor: least [s] a round spends on a cell. Of several points the defaults are measured in full:
 * there the parts of an iteration too, and what is left out, on the middle mesh of each
 * formulation; elsewhere rounds are short and long cells keep the time of their one run. Cells that
 * crashed are not run again. dense: the published algorithm is timed too. to: of the progress, or
 * NULL. */
status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f);

/* Binds this process to the processor it runs on, so that repetitions are comparable. */
void rounds_pin(void);
/* Libraries that thread decide so when they are loaded: starts the program anew with one thread.
 * arguments: NULL-terminated. */
void rounds_single_thread(char **arguments);

#endif
