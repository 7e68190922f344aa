/* Parts of results_read for HDF5 files. */
#ifndef BEAMWORK_RESULTS_HDF5_H
#define BEAMWORK_RESULTS_HDF5_H

#include <hdf5.h>

#include "harness/record/results.h"

/* Text attribute of fixed length; 0: it is not there, too long or of another type. */
int attribute_text(hid_t at, const char *name, char *text, size_t size);
/* Whole number of a scalar attribute; 0: it is not there or of another type. */
int attribute_count(hid_t at, const char *name, long *out);
/* The former layout; `beamwork compare` alone reads it. */
status results_read_version1(const char *path, hid_t file, results *out, fault *f);

#endif
