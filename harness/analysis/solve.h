/* Runs a scene's analyses on a model and extracts its quantities. The only door of
 * harness/analysis. */
#ifndef BEAMWORK_SOLVE_H
#define BEAMWORK_SOLVE_H

#include "harness/newton/newton.h"

/* Fills result even on failure (quantities that could be found stay); result_free frees it. */
status solve_scene(const scene *, const model *, const solve_options *, solve_result *, fault *);

#endif
