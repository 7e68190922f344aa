/* The batches of a sweep put together: what it comes to, its file, its worst points. */
#ifndef BEAMWORK_RANGES_COLLECT_H
#define BEAMWORK_RANGES_COLLECT_H

#include <limits.h>

#include "harness/experiments/ranges_work.h"
#include "harness/experiments/stock.h"

typedef struct ranges_output {
    const char *path;      /* HDF5; NULL: none */
    const char *plan;      /* digits that say which sweep it is */
    char folder[PATH_MAX]; /* of the worst points' scenes; empty: none */
} ranges_output;

/* "sweep.worst" of "sweep.h5", and so on. REFUSED: the name is too long. */
status ranges_collect_beside(const char *path, const char *ending, char out[PATH_MAX], fault *f);
/* Is there room for the scenes? REFUSED: something else is there. */
status ranges_collect_check(const ranges_output *, fault *f);
/* A sweep whose batches are being taken. */
typedef struct ranges_collect {
    ranges_work *work;
    const ranges_output *output;
    tally tally;
    ranges_file file;
} ranges_collect;

/* From now on what the work takes, one batch in memory at a time, goes into the tally and the file.
 * The output must outlive it. */
status ranges_collect_begin(ranges_work *, const ranges_output *, ranges_collect *out, fault *f);
/* After the last one: the scenes of the worst points, the file. taken: how that went; not OK:
 * nothing is left. The caller frees the tally. */
status ranges_collect_end(ranges_collect *, status taken, fault *f);
/* Once all is written: takes the batches of a stock of one folder away, and the folder where
 * nothing else is in it. */
status ranges_collect_remove(const stock *, const char *folder, fault *f);

#endif
