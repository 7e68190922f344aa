/* What tells the batches of one request, build and input from those of another. */
#ifndef BEAMWORK_SPREAD_IDENTITY_H
#define BEAMWORK_SPREAD_IDENTITY_H

#include "harness/cli/command.h"
#include "harness/experiments/work.h"
#include "harness/study/sweep.h"

enum { IDENTITY_TEXT = 2000 };

typedef struct identity_texts {
    char build[400], request[IDENTITY_TEXT], plan[DIGEST_TEXT];
    char *origin; /* JSON; identity_free releases it */
} identity_texts;

/* Version, commit, and the digest of the program itself; the command line in words; a digest of
 * every file that answers depend on, to which the plan adds itself. FAULT: a file that cannot be
 * read. */
status identity_make(const char *verb, const command_request *r, identity_texts *out, digest *plan,
                     fault *f);
/* Points, formulations and meshes. */
void identity_add_sweep(digest *plan, const sweep *s);
/* Into a work that the texts outlive; no more is added to the plan. */
void identity_set(identity_texts *texts, const digest *plan, work *w);
void identity_free(identity_texts *);

#endif
