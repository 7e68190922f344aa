/* What the tables on a terminal are written with. */
#ifndef BEAMWORK_TABLE_H
#define BEAMWORK_TABLE_H

#include <stdio.h>

#include "harness/study/sweep.h"

/* A relative error in 11 columns, in percent where that shows it; a dash where there is none. */
void table_percent(FILE *to, double error);
/* printf's conversion 'g', 'e' or 'f' in a field of `width`; a dash for what is not finite. */
void table_value(FILE *to, int width, int digits, char conversion, double value);
/* "case: parameters" as far as they differ from the defaults. */
void table_point(FILE *to, const point *p);
/* A line "case (parameters), formulation". */
void table_series(FILE *to, const sweep *s, int index);

#endif
