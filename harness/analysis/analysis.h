#ifndef BEAMWORK_ANALYSIS_H
#define BEAMWORK_ANALYSIS_H

#include "harness/newton/newton.h"

/* Runs the analyses of a scene on a model and extracts its quantities. This is the only public
 * function of harness/analysis. */

/* Fills the result. After a failure, it contains the quantities that were found before the failure.
 * result_free frees the result. */
status solve_scene(const scene *, const model *, const solve_options *, solve_result *, fault *);

#endif
