/* How often limits hold: the check of their uncertainties. */
#ifndef BEAMWORK_COVERAGE_H
#define BEAMWORK_COVERAGE_H

#include "harness/judge/judgement.h"

/* Fills the coverages of a judgement from its verdicts. */
status coverage_count(const sweep *s, judgement *out, fault *f);

#endif
