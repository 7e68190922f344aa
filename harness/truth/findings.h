/* Expected verdicts that are not a pass: a table of the packed truths. */
#ifndef BEAMWORK_FINDINGS_H
#define BEAMWORK_FINDINGS_H

#include <hdf5.h>

#include "harness/truth/truths.h"

/* Into out->finding; what was read before a failure is in it. */
status findings_read(const char *path, hid_t file, truths *out, fault *f);

#endif
