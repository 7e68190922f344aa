/* What batches of one sweep have in common beside the command line. */
#ifndef BEAMWORK_RANGES_IDENTITY_H
#define BEAMWORK_RANGES_IDENTITY_H

#include "harness/experiments/ranges.h"
#include "harness/records/records.h"

/* Points, formulations, meshes, quantities, and how it is cut. */
void ranges_identity_add(const parameter_ranges *r, digest *plan);

#endif
