/* A planned sweep as work: batches of consecutive series. */
#ifndef BEAMWORK_SWEEP_WORK_H
#define BEAMWORK_SWEEP_WORK_H

#include "harness/cli/spread.h"
#include "harness/study/sweep.h"
#include "harness/study/truths.h"

typedef struct sweep_work sweep_work;
struct sweep_work {
    const char *verb;
    const sweep_request *request;
    truths *t; /* of the doubts that noise is measured for */
    /* Runs the cells of a part of the sweep: its points, some of its series. */
    status (*run)(const sweep_work *, sweep *part, fault *f);
};

/* The sweep is planned. Computes the shard, or takes the cells of --from; what is missing of
 * --partial is taken out and counted as unfinished. */
status sweep_work_do(const sweep_work *, const shard_options *r, sweep *s, spread_end *out,
                     fault *f);
/* Items of these costs [s] in batches of about half a second, or less where there is little work:
 * deal_cut. cost: of each batch. Returns their number. */
int sweep_work_cut(int items, const double each[], int first[], double cost[]);

#endif
