/* Is the number of an outcome a value, coarse, or wrong? */
#ifndef BEAMWORK_EXTREME_JUDGE_H
#define BEAMWORK_EXTREME_JUDGE_H

#include "harness/experiments/extreme_sweep.h"

/* From the first mesh alone: a value, a failure, or wrong until other meshes are seen. */
status extreme_judge_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f);
/* Does the error fall as a discretisation error does: to the finest mesh, by order 0.5 at least? */
void extreme_judge_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o);

#endif
