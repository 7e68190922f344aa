/* Rules and truths that a run should have shown and met and did not. */
#ifndef BEAMWORK_MISSED_H
#define BEAMWORK_MISSED_H

#include "harness/study/judgement.h"

/* Marks them (rule.missed) and counts them. whole: 1: nothing was selected away, and every rule
 * should have been shown; else only those of one's own (rule.from) whose formulations and cases
 * were all run, with all points and quantities: a selection (-k) covers a case where it holds by
 * the name of the case alone. */
int missed_rules(const sweep *s, truths *t, int whole);

/* Counts the truths that a whole run has not judged by: unmet, waiting and unread. What is unread
 * counts as met (truth.met) and is not judged: a run takes a motion at few of the instants and
 * structures that its quantities are known at, `make lab L=motions` at all. */
void missed_truths(const sweep *s, truths *t, judgement *out);

#endif
