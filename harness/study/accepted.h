/* Formulations whose verdicts gate (reference/accepted.csv), as they are packed. */
#ifndef BEAMWORK_ACCEPTED_H
#define BEAMWORK_ACCEPTED_H

#include <hdf5.h>

#include "elements/shared/status.h"

/* Makes those of an open file of truths known (formulations_accept). FAULT: the table is missing or
 * damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

#endif
