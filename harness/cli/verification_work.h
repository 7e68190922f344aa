/* `verify` as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_VERIFICATION_WORK_H
#define BEAMWORK_VERIFICATION_WORK_H

#include "harness/cli/sweep_work.h"

/* Runs a planned sweep, or takes what was run; the cells that measure noise belong to the batch of
 * their series. */
status verification_work_run(const shard_options *, const sweep_request *, truths *, sweep *,
                             spread_end *, fault *);

#endif
