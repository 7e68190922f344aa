/* One file of results for all experiments: each has a group of its own below /experiments, which a
 * later run replaces whole; what verify leaves is the root. Several runs may write one file at a
 * time: each reads again, under a lock, what the others have left. */
#ifndef BEAMWORK_KEPT_H
#define BEAMWORK_KEPT_H

#include "harness/records/record.h"

#define KEPT_GROUPS "experiments"
#define KEPT_SWEEP  "sweep"
/* An attribute of the group of a sweep, or of the root of a file that a sweep had for itself: the
 * group of such a file is made of it when others write there. */
#define KEPT_SWEEP_MARK "beamwork_sweep"

/* Where an experiment writes: its group; name NULL: the root. The caller closes it with
 * H5Gclose. */
hid_t kept_group(record_file *r, const char *name);
/* As record_close, with all that the file at `path` holds of other experiments than `name`. On
 * FAULT the file is as it was. */
status kept_close(record_file *r, const char *name, const char *path, fault *f);
/* Before the work. REFUSED: HDF5 is there that is damaged, or not of results, and would be lost, or
 * another program does not let go of it; FAULT: it cannot be locked. */
status kept_check(const char *path, fault *f);

#endif
