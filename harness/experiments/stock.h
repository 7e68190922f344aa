/* Which batches of a work are there, in one or several folders. */
#ifndef BEAMWORK_STOCK_H
#define BEAMWORK_STOCK_H

#include "harness/experiments/batch.h"

typedef struct stock_kind {
    machine node; /* the first of the kind */
    int batches;
} stock_kind;

typedef struct stock {
    int batches;
    const char *const *folder; /* of the caller */
    int folders;
    char stem[BATCH_STEM];
    int *where; /* [batches] index of the folder that has it, or -1 */
    int there, damaged, twice;
    int shards; /* of the batches that are there; 0: of different numbers */
    double seconds;
    int kinds; /* of machines */
    stock_kind *kind;
} stock;

/* Looks at the batches that are wanted (NULL: all), bytes and all; of one that is in two folders
 * the first is taken. damaged: each is told in a line on `tell` (NULL: not) and counts as missing.
 * REFUSED: a batch of another build, request or plan, a file that only is called like one, two
 * batches that differ. FAULT: a folder that cannot be read. stock_free frees it, also after a
 * failure. */
status stock_take(const shard_work *w, const char *const folder[], int folders, const char *wanted,
                  FILE *tell, stock *out, fault *f);
void stock_free(stock *);
/* Where a batch that is there is. */
status stock_path(const stock *, int batch, char out[PATH_MAX], fault *f);
/* "3 of 149 batches are missing: 3, 7-12 (shards 2/4, 3/4)"; nothing where none is. */
void stock_missing(const stock *, const shard_work *, char *out, size_t size);
/* A line for each kind of machine where there are several. */
void stock_tell_kinds(const stock *, FILE *to);
/* The first batch of a folder that can be read, by its name: what merge asks again. REFUSED: there
 * is none. */
status stock_first(const char *folder, batch_label *out, fault *f);

#endif
