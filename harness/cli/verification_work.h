/* `verify` as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_VERIFICATION_WORK_H
#define BEAMWORK_VERIFICATION_WORK_H

#include "harness/cli/spread.h"
#include "harness/study/study.h"

/* Computes a shard of a planned sweep, or takes the cells of --from: what is missing of --partial
 * is taken out and counted as unfinished. A batch is consecutive series, with the cells that
 * measure their noise. */
status verification_work_run(const shard_options *, const sweep_request *, truths *, sweep *,
                             spread_end *, fault *);

#endif
