/* Records of extremes, of outcomes and of the counts of a formulation. */
#ifndef BEAMWORK_EXTREME_RECORD_H
#define BEAMWORK_EXTREME_RECORD_H

#include "harness/experiments/extreme_sweep.h"
#include "harness/records/records.h"

extern const record_type record_extremes_all, record_extreme, record_outcome, record_extreme_count;
extern const record_type *const extreme_records[]; /* all but the first; ends with NULL */
void extreme_gather(const void *found, const record_type *type, subjects *out);

#endif
