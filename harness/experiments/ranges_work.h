/* A sweep as work that can be cut into batches (harness/experiments/work.h). */
#ifndef BEAMWORK_RANGES_WORK_H
#define BEAMWORK_RANGES_WORK_H

#include "harness/experiments/ranges_file.h"
#include "harness/experiments/work.h"

typedef struct ranges_work {
    const parameter_ranges *of;
    double *cost;      /* [batches] */
    tally *tally;      /* where batches that are taken are counted ... */
    ranges_file *file; /* ... and stored; NULL: nowhere */
    FILE *csv;         /* where they are written as text; NULL: nowhere */
    int csv_begun;     /* 1: its head is there */
    digest content;    /* of all values that were taken, times left out */
} ranges_work;

/* FAULT: memory. ranges_work_free frees it. */
status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f);
void ranges_work_free(ranges_work *);
/* Which sweep it is, its identity, is the caller's to say. */
shard_work ranges_work_of(ranges_work *);

#endif
