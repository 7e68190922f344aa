/* What stands once in the group of a sweep. */
#ifndef BEAMWORK_RANGES_FILE_IMPL_H
#define BEAMWORK_RANGES_FILE_IMPL_H

#include "harness/experiments/ranges_file.h"

/* What was asked for, before any point. */
void ranges_file_request(record_file *, hid_t at, const parameter_ranges *, const char *plan);
/* The worst points, behind all of them. */
void ranges_file_worst(record_file *, hid_t at, const parameter_ranges *, const tally *);

#endif
