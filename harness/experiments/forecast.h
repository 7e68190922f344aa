/* How long shards will take, before they are computed: the batches dealt as they would be. */
#ifndef BEAMWORK_FORECAST_H
#define BEAMWORK_FORECAST_H

#include "harness/experiments/work.h"

typedef struct forecast {
    int shards;
    int most;          /* batches of one shard */
    double longest;    /* [s] until the shard that ends last has ended */
    double efficiency; /* of all processes: what they work by what they are there for */
} forecast;

/* What batches took, beside what was expected. */
typedef struct forecast_seconds {
    int measured;    /* batches that are there */
    double *seconds; /* [batches] of the processor, measured; of the others the expected ones times
                        `factor` */
    double factor;   /* measured by expected, of all that are there together; 1: none is */
    double median, tenth; /* factors of single batches beside that one, and that of nine of ten */
} forecast_seconds;

/* Dealt by the costs of the work; each shard has `jobs` processes, of which the next free one takes
 * the dearest batch that is left, and it takes seconds[batches]. FAULT: memory. */
status forecast_of(const work *w, const double seconds[], int shards, int jobs, forecast *out,
                   fault *f);
/* From the batches in a folder (NULL: from the costs alone). REFUSED: there are none of this work.
 * forecast_free frees it, also after a failure. */
status forecast_read(const work *w, const char *folder, forecast_seconds *out, fault *f);
void forecast_free(forecast_seconds *);
/* The table for 1, 2, 4, ... and that many shards, with what it is made of. */
status forecast_tell(const work *w, const char *folder, int shards, int jobs, FILE *to, fault *f);

#endif
