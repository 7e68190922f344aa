/* Records of extremes, of outcomes and of the counts of a formulation, for JSON and CSV. */
#ifndef BEAMWORK_EXTREME_RECORD_H
#define BEAMWORK_EXTREME_RECORD_H

#include "harness/experiments/extreme_sweep.h"
#include "harness/records/schema.h"

extern const record_type record_extreme, record_outcome, record_extreme_count;
subject extreme_record_subject(const extreme_sweep *s,
                               const extreme_outcome *o); /* of record_outcome */

#endif
