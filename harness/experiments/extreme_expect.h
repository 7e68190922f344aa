/* What a sweep of extremes is expected to show (reference/extreme_findings.csv), and what it counts
 * to. */
#ifndef BEAMWORK_EXTREME_EXPECT_H
#define BEAMWORK_EXTREME_EXPECT_H

#include "harness/experiments/extreme_sweep.h"

/* The findings of the packed truths at `path`. */
status extreme_expect_read(const char *path, extreme_sweep *out, fault *f);
/* Sets finding and as_expected of every outcome, and the counts. whole: 1 when nothing was selected
 * away, so that a finding that nobody observed is a failure. */
void extreme_expect(extreme_sweep *s, int whole);

#endif
