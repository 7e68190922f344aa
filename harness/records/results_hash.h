/* One number for all that a stored run says: two runs that differ in nothing but times, machines
 * and versions have the same. */
#ifndef BEAMWORK_RESULTS_HASH_H
#define BEAMWORK_RESULTS_HASH_H

#include "elements/shared/status.h"
#include "harness/records/digest.h"

typedef struct results_hash {
    char text[DIGEST_TEXT]; /* SHA-256 */
    long values;            /* numbers and texts that it is of */
} results_hash;

/* Every dataset in the order of names, by rows: results.h5, and any other file of ours. Left out:
 * tables `timings`, what is called `seconds...`, attributes. FAULT: not a file of ours. */
status results_hash_of(const char *path, results_hash *out, fault *f);

#endif
