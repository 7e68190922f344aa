/* All cells of a sweep, run by several processes. */
#ifndef BEAMWORK_RUN_H
#define BEAMWORK_RUN_H

#include "harness/study/sweep.h"

/* Runs every cell; a cell that fails or crashes is a result. Order of results does not depend on
 * jobs. */
status run_sweep(const sweep_request *request, sweep *s, fault *f);

#endif
