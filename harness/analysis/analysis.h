#ifndef BEAMWORK_ANALYSIS_H
#define BEAMWORK_ANALYSIS_H

#include "harness/newton/newton.h"

/* Runs the analyses of a scene on a model and extracts its quantities. This is the only public
 * function of harness/analysis. */

/* Fills the result and returns its status, that of the first failure. After a failure, quantities
 * that do not depend on it have values. result_free frees the result, also after a failure. */
status solve_scene(const scene *, const model *, const solve_options *, solve_result *, fault *);

#endif
