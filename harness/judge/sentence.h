/* Verdicts in words. */
#ifndef BEAMWORK_SENTENCE_H
#define BEAMWORK_SENTENCE_H

#include "harness/judge/verdict.h"

/* The verdict in words: "converges to a wrong limit: +0.115 %". */
void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size);

#endif
