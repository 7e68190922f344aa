/* Quantities of a continued path. */
#ifndef BEAMWORK_CONTINUATION_EXTRACT_H
#define BEAMWORK_CONTINUATION_EXTRACT_H

#include "harness/newton/newton.h"

/* Curves and critical points; 0: the quantity is something else. */
int continuation_extract(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                         quantity_result *);
/* A curve of coordinates is wanted: the states of all points are kept for it. */
int continuation_extract_keeps_states(const scene *, int analysis);

#endif
