/* Formulations side by side: a table for each quantity, a column for each formulation. */
#ifndef BEAMWORK_TABLE_BESIDE_H
#define BEAMWORK_TABLE_BESIDE_H

#include <stdio.h>

#include "harness/study/study.h"

/* Of the one point of a sweep: rows are meshes, then limit, its uncertainty and order; below what
 * is not a pass, in words. Errors where a formulation has something to be measured by, else values.
 * Within 100 columns: several blocks where more formulations ran than fit; last what did not run.
 */
void table_beside(FILE *to, const sweep *s, const truths *t);

#endif
