/* What a scene file that was written for an older version means now. */
#ifndef BEAMWORK_SUPPORTS_TOLD_H
#define BEAMWORK_SUPPORTS_TOLD_H

#include "harness/cli/case_input.h"

/* For one minor version: one line where ends of members hold their warping because of their
 * supports, were free before, and the answers of this formulation depend on it, as far as two
 * elements for each member tell. Of built-in cases: none. */
void supports_told(const scene_file *, const double parameter[], const formulation *,
                   const scene *);

#endif
