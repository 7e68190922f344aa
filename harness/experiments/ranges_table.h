/* A sweep on a terminal. */
#ifndef BEAMWORK_RANGES_TABLE_H
#define BEAMWORK_RANGES_TABLE_H

#include <stdio.h>

#include "harness/experiments/tally.h"

/* What is swept: points, cells, and the axes. */
void ranges_table_head(FILE *to, const parameter_ranges *r);
/* Within PARAGRAPH_WIDTH: what errors are against; the share of points within the tolerance with
 * each mesh, for each quantity and formulation; where there are one or two axes the least elements
 * over them, of all quantities together (every: of each too); the worst points with their values
 * and a command that shows one. folder: of their scenes; "": none were kept. */
void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f);

#endif
