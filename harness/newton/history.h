/* What Newton's method did: the iterations of every load step that was kept. */
#ifndef BEAMWORK_HISTORY_H
#define BEAMWORK_HISTORY_H

#include "harness/newton/result.h"

/* One more iteration of the step that is being tried. energy = |r . K^-1 r| of its residual r [J];
 * NAN: not known. */
status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f);
/* The step was tried in vain: its iterations are forgotten. */
void history_drop_step(solve_result *r, const step_record *step);

/* What the steps from `first` on are of, and whether the states where they ended are stable. */
void history_judge_steps(solve_result *, const scene *, int analysis, int first);
/* What the modes at a station say, where pivots do not. */
void history_judge_station(solve_result *, int analysis, double path, step_stability);
/* Where a step of the analysis ended at that path parameter; STEP_OPEN: nowhere. */
step_stability history_stability_at(const solve_result *, int analysis, double path);
status history_add_step(solve_result *, const step_record *, fault *);
/* All steps of a motion. */
/* path: parameter of the state that it starts from; NAN: it has none. */
status history_add_motion(solve_result *, int analysis, double path, const outcome_motion *,
                          fault *);
/* What is there so far; what was added since then is forgotten. */
typedef struct history_mark {
    int steps, iterations, ends;
} history_mark;
history_mark history_here(const solve_result *);
void history_go_back(solve_result *, const history_mark *);
status history_add_event(solve_result *, const path_event *, fault *);

#endif
