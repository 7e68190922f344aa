/* The command line that batches were computed by, asked once more. */
#ifndef BEAMWORK_SPREAD_AGAIN_H
#define BEAMWORK_SPREAD_AGAIN_H

#include "harness/cli/command.h"

typedef struct again {
    int count;
    char **argument; /* "beamwork", the verb, ...; NULL-terminated; their order may be changed */
    char **owned;    /* the same, which again_free releases */
} again;

/* What the first batch of the first folder was asked, with --from for all folders and the outputs
 * of the request. REFUSED: no batches there; FAULT: memory, or a file that cannot be read.
 * again_free frees it, also after a failure. */
status again_make(const command_request *r, again *out, fault *f);
void again_free(again *);

#endif
