/* Every formulation on every case and parameter point that has a truth, run. */
#ifndef BEAMWORK_VERIFICATION_H
#define BEAMWORK_VERIFICATION_H

#include "harness/study/sweep.h"

/* Plans and runs the sweep; the finest meshes again where verdicts may turn on their noise, unless
 * the run was interrupted. sweep_free frees it, also after a failure. */
status verification_run(const sweep_request *, truths *, sweep *, fault *);
/* The same of a sweep that is planned, or of some of its series. */
status verification_run_planned(const sweep_request *, truths *, sweep *, fault *);

#endif
