/* Work of a verb that is computed as a shard, or taken from batches, as the command line asks. */
#ifndef BEAMWORK_SPREAD_H
#define BEAMWORK_SPREAD_H

#include "harness/cli/command.h"
#include "harness/experiments/work.h"
#include "harness/formulations/environment.h"

/* How it ended. */
typedef struct spread_end {
    int ended; /* 1: there is nothing to judge, and this is ... */
    int code;  /* ... the exit status */
    int batches;
    char *taken;         /* [batches] of a merge; spread_free releases it */
    char processor[128]; /* that the batches were computed on; empty: they were not merged */
} spread_end;

/* 1: --into, --shard, --from or --plan were given. REFUSED: what does not go together. */
status spread_asked(const command_request *r, int *asked, fault *f);
/* Computes the shard and says what became of it, takes the batches, or says how long they take.
 * times: 1 where machines matter, and one process computes at a time. */
status spread_work(const command_request *r, const work *w, int times, spread_end *out, fault *f);
/* What a result was made with: here, or where the batches were computed. */
environment spread_environment(const spread_end *, int threads);
void spread_free(spread_end *);

#endif
