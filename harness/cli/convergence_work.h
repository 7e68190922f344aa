/* `converge` here, as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_CONVERGENCE_WORK_H
#define BEAMWORK_CONVERGENCE_WORK_H

#include "harness/cli/sweep_work.h"

/* The sweep is planned. */
status convergence_work_run(const shard_options *, const sweep_request *, sweep *, spread_end *,
                            fault *);

#endif
