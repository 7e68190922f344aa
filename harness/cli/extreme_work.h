/* `stress` here, as a shard, or from batches: as the command line asks. */
#ifndef BEAMWORK_EXTREME_WORK_H
#define BEAMWORK_EXTREME_WORK_H

#include "harness/cli/spread.h"
#include "harness/experiments/extreme_run.h"

/* A batch is one extreme or several, with the neighbouring meshes that its numbers need: whether
 * they do depends on that extreme alone. path: of the packed ones. */
status extreme_work_run(const shard_options *, const extreme_request *, const char *path,
                        extreme_sweep *, spread_end *, fault *);

#endif
