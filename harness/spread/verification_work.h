/* `verify` here, as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_VERIFICATION_WORK_H
#define BEAMWORK_VERIFICATION_WORK_H

#include "harness/spread/sweep_work.h"

/* Plans and runs; the cells that measure noise belong to the batch of their series. */
status verification_work_run(const command_request *, const sweep_request *, truths *, sweep *,
                             spread_end *, fault *);

#endif
