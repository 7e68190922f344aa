/* Inside of the table of a sweep. */
#ifndef BEAMWORK_RANGES_TABLE_IMPL_H
#define BEAMWORK_RANGES_TABLE_IMPL_H

#include <stdio.h>

#include "harness/experiments/tally.h"

enum { RANGES_TABLE_NAME = 24, RANGES_TABLE_COLUMN = 7, RANGES_TABLE_LINE = 1024 };

/* Of a quantity, or of all together: index, or their number. */
static inline const char *ranges_table_name(const parameter_ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all quantities";
}

/* ranges_table_known.c: what errors are against, and points without a scene. */
void ranges_table_known(FILE *to, const tally *t);
/* ranges_table_map.c: the least elements over one or two axes; every: of each quantity, too. */
void ranges_table_map(FILE *to, const tally *t, int every);

#endif
