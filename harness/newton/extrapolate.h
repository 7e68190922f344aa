/* Where the next state of a path is looked for. */
#ifndef BEAMWORK_MODEL_EXTRAPOLATE_H
#define BEAMWORK_MODEL_EXTRAPOLATE_H

#include "harness/newton/run_state.h"

/* First guess of the state at `path` from the last `count` ones (two: a line, three: a parabola,
 * ...), oldest first. 0: there is none, because what is prescribed bends, or the step is too long;
 * `out` is untouched then. */
enum { MODEL_EXTRAPOLATED = 12 };
int extrapolate_state(const equations *, int count, const model_state *const at[], double path,
                      model_state *out);
/* error[k], k = 1 ... most: how far a guess of at[most] from the k states before it would have been
 * off: the largest error of a displacement or strain [m]; of one: had it been taken as it is.
 * INFINITY: there would have been none. */
void extrapolate_errors(const equations *, int most, const model_state *const at[], double error[]);

#endif
