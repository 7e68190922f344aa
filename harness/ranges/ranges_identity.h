/* Which sweep it is: what batches of one sweep have in common, wherever they are computed. */
#ifndef BEAMWORK_RANGES_IDENTITY_H
#define BEAMWORK_RANGES_IDENTITY_H

#include "harness/ranges/ranges.h"
#include "harness/shards/digest.h"

enum { RANGES_BUILD = 512, RANGES_REQUEST = 2048 };

typedef struct ranges_identity {
    char build[RANGES_BUILD], request[RANGES_REQUEST]; /* one line each */
    char plan[DIGEST_TEXT]; /* of both, of the scene, of the truths, of quantities and batches */
} ranges_identity;

/* truths_path: of the stored truths; NULL: none are read. FAULT: a file cannot be read. */
status ranges_identity_make(const ranges *r, const char *truths_path, ranges_identity *out,
                            fault *f);

#endif
