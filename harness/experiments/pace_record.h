/* Records of motions, for JSON and CSV. */
#ifndef BEAMWORK_PACE_RECORD_H
#define BEAMWORK_PACE_RECORD_H

#include "harness/experiments/pace_order.h"
#include "harness/records/schema.h"

extern const record_type record_pace_run, record_pace_ladder;
subject pace_record_subject(const pace *, const pace_run *);

#endif
