/* How often limits hold: the check of their uncertainties. */
#ifndef BEAMWORK_COVERAGE_H
#define BEAMWORK_COVERAGE_H

#include "harness/study/judgement.h"

/* Adds to the coverages of a judgement what its verdicts show, from the given one on. */
status coverage_count(const sweep *s, int first, judgement *out, fault *f);

#endif
