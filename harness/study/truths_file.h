/* The packed file itself: undamaged, ours, and of this version. */
#ifndef BEAMWORK_TRUTHS_FILE_H
#define BEAMWORK_TRUTHS_FILE_H

#include <hdf5.h>

#include "elements/shared/status.h"

/* FAULT when it is damaged or not ours; *file below 0: nothing is open. */
status truths_file_open(const char *path, hid_t *file, fault *f);

#endif
