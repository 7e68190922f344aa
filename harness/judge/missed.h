/* Rules that a run should have shown and did not. */
#ifndef BEAMWORK_MISSED_H
#define BEAMWORK_MISSED_H

#include "harness/study/sweep.h"

/* Marks them (rule.missed) and counts them. whole: 1: nothing was selected away, and every rule
 * should have been shown; else only those of one's own (rule.from) whose formulations and cases
 * were all run, with all points and quantities: a selection (-k) covers a case where it holds by
 * the name of the case alone. */
int missed_rules(const sweep *s, truths *t, int whole);

#endif
