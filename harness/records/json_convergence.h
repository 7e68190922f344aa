/* JSON of what meshes show: values, limits, orders. */
#ifndef BEAMWORK_JSON_CONVERGENCE_H
#define BEAMWORK_JSON_CONVERGENCE_H

#include <stdio.h>

#include "harness/study/study.h"

/* Every quantity of every series over its meshes, with limit, order and verdict; which formulations
 * are within the level (relative error) in every quantity. */
status json_convergence_write(FILE *to, const sweep *s, const truths *t, double level, fault *f);

#endif
