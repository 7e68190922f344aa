/* What Newton's method did: the iterations of every load step that was kept. */
#ifndef BEAMWORK_HISTORY_H
#define BEAMWORK_HISTORY_H

#include "harness/solver/result.h"

/* One more iteration of the step that is being tried. energy = |r . K^-1 r| of its residual r [J];
 * NAN: not known. */
status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f);
/* The step was tried in vain: its iterations are forgotten. */
void history_drop_step(solve_result *r, const step_record *step);

status history_add_step(solve_result *, const step_record *, fault *);
/* All steps of a motion. */
status history_add_motion(solve_result *, int analysis, const outcome_motion *, fault *);
status history_add_event(solve_result *, const path_event *, fault *);

#endif
