/* Series over their meshes for people, with their limits. */
#ifndef BEAMWORK_TABLE_CONVERGENCE_H
#define BEAMWORK_TABLE_CONVERGENCE_H

#include <stdio.h>

#include "harness/study/study.h"

void table_convergence(FILE *to, const sweep *s, const truths *t);

#endif
