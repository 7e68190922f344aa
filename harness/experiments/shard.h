/* One shard of a work: its batches, each computed by a process, each a file once it is done. */
#ifndef BEAMWORK_SHARD_H
#define BEAMWORK_SHARD_H

#include "harness/experiments/work.h"

enum { SHARD_MOST_JOBS = 64, SHARD_MOST = 100000 };

typedef struct shard_request {
    int index, count; /* 0-based: of so many shards the one */
    const char *into; /* folder; it is made where it is not there */
    int jobs;         /* processes, >= 1 */
    int stop;         /* ends once this descriptor can be read; 0: SIGINT, SIGTERM, SIGHUP end it */
    FILE *progress;   /* NULL: quiet */
    FILE *tell;       /* lines about what is damaged or was lost; NULL: none */
} shard_request;

typedef struct shard_outcome {
    int mine;        /* batches of the shard */
    int before;      /* that were there */
    int done;        /* that were computed now */
    int lost;        /* whose process ended before they were done */
    int interrupted; /* 1: somebody asked to end */
    double seconds;  /* that those computed now took, each in its process */
} shard_outcome;

/* "2/4" -> 1, 4. REFUSED: anything else. */
status shard_parse(const char *text, int *index, int *count, fault *f);
/* Computes what is not there yet, the dearest batches first. A batch whose process ends without an
 * answer is lost alone: it is done when the shard is started again. REFUSED: the folder has batches
 * of another work. FAULT: disk, memory, or the batch itself: all ends, what is done stays. */
status shard_run(const shard_work *w, const shard_request *request, shard_outcome *out, fault *f);

#endif
