/* One file of results for all experiments: each has a group of its own below /experiments, which a
 * later run replaces whole; what verify leaves is the root. Several runs may write one file at a
 * time: each reads again, under a lock, what the others have left. */
#ifndef BEAMWORK_KEPT_H
#define BEAMWORK_KEPT_H

#include "harness/records/record.h"

#define KEPT_GROUPS "experiments"

/* Where an experiment writes: its group; name NULL: the root. The caller closes it with
 * H5Gclose. */
hid_t kept_group(record *r, const char *name);
/* As record_close, with all that the file at `path` holds of other experiments than `name`. On
 * FAULT the file is as it was. */
status kept_close(record *r, const char *name, const char *path, fault *f);
/* REFUSED: HDF5 is there that is damaged, or not of results, and would be lost. */
status kept_check(const char *path, fault *f);
/* For a file of another kind that would take its place. REFUSED: a file of results is there. */
status kept_spare(const char *path, fault *f);

#endif
