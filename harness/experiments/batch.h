/* One batch as a file: a line of JSON that says what it is, its bytes, a line with length and
 * checksum. It appears complete or not at all. */
#ifndef BEAMWORK_BATCH_H
#define BEAMWORK_BATCH_H

#include <jansson.h>
#include <limits.h>

#include "harness/experiments/node.h"
#include "harness/experiments/work.h"

#define BATCH_ENDING ".batch"
enum { BATCH_STEM = 48, BATCH_NAME = BATCH_STEM + 24 };

typedef struct batch_label {
    char build[512], request[2048], plan[DIGEST_TEXT], verb[32];
    int batch, batches; /* counted from 0 */
    int shard, shards;  /* who computed it, counted from 0 */
    char content[DIGEST_TEXT];
    double seconds;           /* that it took */
    double processor_seconds; /* of these, those of the processor, of all its processes */
    machine node;
    json_t *origin; /* batch_label_free releases it */
} batch_label;

/* "verify-0123456789ab": what the names of all batches of one work begin with. */
void batch_stem(const shard_work *w, char out[BATCH_STEM]);
/* "verify-0123456789ab-000017.batch"; batches are counted from 1 there. */
void batch_name(const char *stem, int batch, char out[BATCH_NAME]);
/* The batch of a name, or -1: it is none of that stem. */
int batch_of_name(const char *name, const char *stem);
/* 1: it ends as names of batches do. */
int batch_is_name(const char *name);

/* Writes folder/NAME beside its place, then renames it. FAULT: disk, memory. */
status batch_write(const char *folder, const batch_label *label, const void *bytes, size_t size,
                   fault *f);
/* Takes away what processes that were killed left of a batch; gone: 1, its writer is known to be.
 */
void batch_clean(const char *folder, const char *name, int gone);
/* The label; *from (may be NULL) stands at the first of the bytes, and *end behind the last.
 * FAULT: cut short, damaged, or no batch. */
status batch_open(const char *path, batch_label *out, FILE **from, long *end, fault *f);
/* The label alone: nothing is said of the bytes. */
status batch_read_label(const char *path, batch_label *out, fault *f);
void batch_label_free(batch_label *);
/* Does it belong to the work? REFUSED: no; what differs, with its path. */
status batch_belongs(const batch_label *, const shard_work *, const char *path, fault *f);

#endif
