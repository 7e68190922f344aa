/* analysis/: linear, static, buckling, modal, continuation, rotation, flutter, compliance;
 * extraction of quantities. */
#ifndef BEAMWORK_ANALYSIS_H
#define BEAMWORK_ANALYSIS_H

#include "harness/newton/newton.h"

/* Runs a scene's analyses on a model and extracts its quantities. The only public function of
 * harness/analysis. */

/* Fills the result even on failure, with the quantities found so far; result_free frees it. */
status solve_scene(const scene *, const model *, const solve_options *, solve_result *, fault *);

#endif
