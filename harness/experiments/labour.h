/* A process that computes batches, one after the other, and says what became of each. */
#ifndef BEAMWORK_LABOUR_H
#define BEAMWORK_LABOUR_H

#include <stdatomic.h>

#include "harness/experiments/batch.h"
#include "harness/experiments/shard.h"

/* Shared by all processes. */
typedef struct labour_shelf {
    atomic_int next;                /* of the list */
    atomic_int at[SHARD_MOST_JOBS]; /* batch that a process is at, or -1 */
} labour_shelf;

typedef struct labour {
    const shard_work *w;
    const shard_request *request;
    int count; /* batches to do */
    int *list; /* [count] in the order in which they are begun */
    labour_shelf *shelf;
    machine here;
} labour;

/* What is said of one batch, in one piece that fits into a pipe. */
typedef struct labour_notice {
    int batch;
    status status;
    double seconds;
    char text[FAULT_TEXT];
} labour_notice;

/* Takes batches until none is left, or one cannot be done; to: a pipe. */
_Noreturn void labour_work(const labour *, int self, int to);

#endif
