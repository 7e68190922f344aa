/* What of a verification is worse than in a former run. */
#ifndef BEAMWORK_REGRESSIONS_H
#define BEAMWORK_REGRESSIONS_H

#include "harness/records/records.h"
#include "harness/study/study.h"

/* Adds to the judgement every mesh whose error is larger than in the former run (by more than 2 %
 * and RESULTS_FLOOR), that has no value or no success any more, what the former run has and this
 * one should, and limits of default points that moved by more than 1e-5 of themselves where no
 * exact truth judges them as closely. Of a former run that is known by its short table, errors
 * series by series. Work is not compared. REFUSED: the two have nothing in common. */
status regressions_find(const stored_results *former, const char *name, const sweep *, judgement *,
                        fault *);

#endif
