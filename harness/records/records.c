#include "harness/records/schema.h"

const record_type *const record_types[] = {
    &record_point,  &record_series,    &record_cell,      &record_quantity,   &record_curve,
    &record_step,   &record_iteration, &record_event,     &record_motion,     &record_matrix,
    &record_timing, &record_verdict,   &record_agreement, &record_coverage,   &record_import,
    &record_scene,  &record_parameter, &record_meaning,   &record_assumption, NULL};
