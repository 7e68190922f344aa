/* analysis/: linear, static, buckling, modal, continuation, rotation, flutter, compliance;
 * quantities read off. */
#ifndef BEAMWORK_ANALYSIS_H
#define BEAMWORK_ANALYSIS_H

#include "harness/newton/newton.h"

/* Runs a scene's analyses on a model and extracts its quantities. The only door of
 * harness/analysis. */

/* Fills result even on failure (quantities that could be found stay); result_free frees it. */
status solve_scene(const scene *, const model *, const solve_options *, solve_result *, fault *);

#endif
