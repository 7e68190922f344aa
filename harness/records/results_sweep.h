/* A sweep, read back. */
#ifndef BEAMWORK_RESULTS_SWEEP_H
#define BEAMWORK_RESULTS_SWEEP_H

#include <hdf5.h>

#include "harness/records/results.h"

/* Adds a cell for each point, formulation and mesh, named by the values of all parameters that the
 * file knows, in the order of their names; and one of no mesh, for the references of each point. */
status results_sweep_read(const char *path, hid_t at, stored_results *out, fault *f);

#endif
