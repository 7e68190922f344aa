/* Result files of the former layout, which `beamwork compare` alone reads. */
#ifndef BEAMWORK_RESULTS_VERSION1_H
#define BEAMWORK_RESULTS_VERSION1_H

#include <hdf5.h>

#include "harness/comparison/results.h"

/* file: open, its checksum and schema checked. */
status results_read_version1(const char *path, hid_t file, results *out, fault *f);

#endif
