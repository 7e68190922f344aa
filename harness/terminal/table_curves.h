/* Curves as text: their values, and how far meshes and formulations are apart. */
#ifndef BEAMWORK_TABLE_CURVES_H
#define BEAMWORK_TABLE_CURVES_H

#include <stdio.h>

#include "harness/study/study.h"

/* Those over one abscissa beside each other; of many points some. */
void table_curves_values(FILE *to, const scene *s, const solve_result *r);
/* Of one point: for each curve the largest error of each mesh, then the values of the formulation
 * that the others are compared with. */
void table_curves_errors(FILE *to, const sweep *s);

#endif
