/* Work that can be cut into batches: what a verb gives to this room, which knows nothing of cells.
 */
#ifndef BEAMWORK_WORK_H
#define BEAMWORK_WORK_H

#include <stdio.h>

#include "elements/shared/status.h"
#include "harness/records/records.h"

/* All of it depends on the request and the build alone: two processes that never met say the same.
 */
typedef struct shard_work {
    const char *verb;
    /* one line each: the program, what it was asked, and all that its answers depend on; batches
     * belong together where all three are equal */
    const char *build, *request, *plan;
    const char *origin; /* JSON object: what merge needs to ask again; it is not compared */
    int batches;
    const double *cost; /* [batches] about [s] */
    void *context;
    /* Answers as bytes, which another process of this build can take. *content gathers what must be
     * equal when the batch is computed again: no times, no names of machines. It runs in a process
     * of its own and frees what it took. */
    status (*run)(void *context, int batch, FILE *to, digest *content, fault *f);
    /* In canonical order, each batch once. FAULT: it cannot be read. */
    status (*take)(void *context, int batch, FILE *from, fault *f);
} shard_work;

#endif
