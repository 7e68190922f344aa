/* One case of a stored run. */
#ifndef BEAMWORK_RESULTS_CASE_H
#define BEAMWORK_RESULTS_CASE_H

#include <hdf5.h>

#include "harness/records/results.h"

/* Adds its cells. at: the group of the case, whose name is given. */
status results_case_read(const char *path, hid_t at, const char *name, stored_results *out,
                         fault *f);
/* What of a file, and where, is not as it was written. */
status results_case_damaged(const char *path, const char *where, const char *what, fault *f);

#endif
