/* Verdicts in words. */
#ifndef BEAMWORK_SENTENCE_H
#define BEAMWORK_SENTENCE_H

#include "harness/study/judgement.h"

/* The verdict in words: "converges to a wrong limit: +0.115 %". */
void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size);
enum { SENTENCE_OF_RUN = 1000 };

/* The whole run in one sentence, which begins with PASS or FAIL (INTERRUPTED where it was,
 * INCOMPLETE where batches are missing) and says what of it was expected although it is not a pass;
 * empty where nothing was judged. */
void sentence_of_run(const sweep *s, const judgement *j, char *text, size_t size);

#endif
