/* Quantities of the sections of a member. */
#ifndef BEAMWORK_EXTRACT_SECTION_H
#define BEAMWORK_EXTRACT_SECTION_H

#include "harness/solver/context.h"

/* As extracted, in a state of a path; NAN where there is none: *r says why. moving: of a motion;
 * else NULL. */
double extract_section_state(const analysis_context *, const scene_quantity *, const model_state *,
                             const outcome_instant *moving, quantity_result *r);
/* At full load, about the undeformed state. */
void extract_section_linear(const analysis_context *, const scene_quantity *,
                            const analysis_outcome *, quantity_result *r);

#endif
