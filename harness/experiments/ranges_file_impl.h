/* What stands once in the group of a sweep. */
#ifndef BEAMWORK_RANGES_FILE_IMPL_H
#define BEAMWORK_RANGES_FILE_IMPL_H

#include "harness/experiments/ranges_file.h"

/* What was asked for, before any point. */
void ranges_file_request(record *, hid_t at, const ranges *, const char *plan);
/* The worst points, behind all of them. */
void ranges_file_worst(record *, hid_t at, const ranges *, const tally *);

#endif
