/* Quantities of a scene from the outcomes of its analyses. */
#ifndef BEAMWORK_EXTRACT_H
#define BEAMWORK_EXTRACT_H

#include "harness/newton/newton.h"

void extract_quantity(const analysis_context *, const scene_quantity *, quantity_result *);

#endif
