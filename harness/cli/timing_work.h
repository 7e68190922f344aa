/* `bench` as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_TIMING_WORK_H
#define BEAMWORK_TIMING_WORK_H

#include "harness/cli/sweep_work.h"

/* The sweep is planned. *asked: 0: the caller runs and times it. All rounds of a point are in one
 * batch, on one processor. floor: least [s] of a round for each cell. */
status timing_work_run(const shard_options *, const sweep_request *, double floor, int dense,
                       sweep *, int *asked, spread_end *, fault *);

#endif
