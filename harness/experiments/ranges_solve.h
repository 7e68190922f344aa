/* The cells of some points of a sweep, solved and measured. */
#ifndef BEAMWORK_RANGES_SOLVE_H
#define BEAMWORK_RANGES_SOLVE_H

#include "harness/experiments/ranges.h"

/* All points of a batch into rows that the caller frees, also after a failure. What a point, a cell
 * or a truth fails with is a result; FAULT: memory or processes. */
status ranges_solve(const parameter_ranges *r, int batch, rows *out, fault *f);

#endif
