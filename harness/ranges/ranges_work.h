/* A sweep as work that can be cut into batches (harness/shards/work.h). */
#ifndef BEAMWORK_RANGES_WORK_H
#define BEAMWORK_RANGES_WORK_H

#include "harness/ranges/ranges_file.h"
#include "harness/ranges/ranges_identity.h"
#include "harness/shards/work.h"

typedef struct ranges_work {
    const ranges *of;
    ranges_identity identity;
    const char *origin; /* what merge needs to ask again, JSON */
    double *cost;       /* [batches] */
    tally *tally;       /* where batches that are taken are counted ... */
    ranges_file *file;  /* ... and stored; NULL: nowhere */
    FILE *csv;          /* where they are written as text; NULL: nowhere */
    digest content;     /* of all values that were taken, times left out */
} ranges_work;

/* origin must outlive it. FAULT: memory, a file that cannot be read. ranges_work_free frees it. */
status ranges_work_make(const ranges *r, const char *truths_path, const char *origin,
                        ranges_work *out, fault *f);
void ranges_work_free(ranges_work *);
work ranges_work_of(ranges_work *);

#endif
