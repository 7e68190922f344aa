/* Quantities of the sections of a member. */
#ifndef BEAMWORK_EXTRACT_SECTION_H
#define BEAMWORK_EXTRACT_SECTION_H

#include "harness/newton/newton.h"

/* At full load, about the undeformed state. */
void extract_section_linear(const analysis_context *, const scene_quantity *,
                            const analysis_outcome *, quantity_result *r);

#endif
