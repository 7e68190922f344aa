/* What the tables on a terminal are written with. */
#ifndef BEAMWORK_TABLE_H
#define BEAMWORK_TABLE_H

#include <stdio.h>

#include "harness/study/study.h"

/* A relative error in percent, in 12 columns with a blank before it; a dash where there is none. */
void table_percent(FILE *to, double error);
/* A value as far as it is known (harness/study/study.h). */
void table_known(FILE *to, int width, double value, double uncertainty);
/* A value with that many digits. */
void table_digits(FILE *to, int width, double value, int digits);
/* printf's conversion 'g', 'e' or 'f' in a field of `width`; a dash for what is not finite. */
void table_value(FILE *to, int width, int digits, char conversion, double value);
/* "case: parameters" as far as they differ from the defaults. */
void table_point(FILE *to, const sweep_point *p);
/* A line "case (parameters), formulation". */
/* A line on members that loads divide, one on the physics that the scene leaves out, and one on the
 * theory of shear that the formulation follows where there are both shear and stability; none where
 * there is nothing to say.
 */
void table_omitted(FILE *to, const sweep_point *p);
void table_theory(FILE *to, const scene *s, const element_type *type);
void table_series(FILE *to, const sweep *s, int index);

#endif
