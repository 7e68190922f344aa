/* Work of a verb that is computed as a shard, or taken from batches, as the command line asks. */
#ifndef BEAMWORK_SPREAD_H
#define BEAMWORK_SPREAD_H

#include "harness/cli/options.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* How it ended. */
typedef struct spread_end {
    int ended; /* 1: there is nothing to judge, and this is ... */
    int code;  /* ... the exit status */
    int batches;
    char *taken;         /* [batches] of a merge; spread_free releases it */
    char processor[128]; /* that the batches were computed on; empty: they were not merged */
} spread_end;

typedef struct shard_options {
    const command_line *line;
    int jobs;
    const char *shard, *into; /* K/N of the work, into which folder */
    text_list from;           /* folders with batches, taken instead of computing */
    int partial;              /* 1: what is missing is left out */
    int quiet;
} shard_options;
extern const option_group options_shards; /* all but jobs and quiet */

/* 1: --into, --shard or --from were given. REFUSED: what does not go together. */
status spread_asked(const shard_options *, int *asked, fault *f);
/* Computes the shard and says what became of it, or takes the batches. */
status spread_work(const shard_options *, const shard_work *w, spread_end *out, fault *f);
/* What a result was made with: here, or where the batches were computed. */
environment spread_environment(const spread_end *, int threads);
void spread_free(spread_end *);

enum { IDENTITY_TEXT = 2000 };

typedef struct identity_texts {
    char build[400], request[IDENTITY_TEXT], plan[DIGEST_TEXT];
    char *origin; /* JSON; identity_free releases it */
} identity_texts;

/* Version, commit, and the digest of the program itself; the command line in words; a digest of
 * every file that answers depend on, to which the plan adds itself. FAULT: a file that cannot be
 * read. */
status identity_make(const command_line *, identity_texts *out, digest *plan, fault *f);
/* Points, formulations and meshes. */
void identity_add_sweep(digest *plan, const sweep *s);
/* Into a work that the texts outlive; no more is added to the plan. */
void identity_set(identity_texts *texts, const digest *plan, shard_work *w);
void identity_free(identity_texts *);

#endif
