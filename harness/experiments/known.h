/* Truths of one point of a sweep. */
#ifndef BEAMWORK_KNOWN_H
#define BEAMWORK_KNOWN_H

#include "harness/experiments/ranges.h"

typedef struct known_truths {
    truths stored, derived;
    int borrowed; /* 1: the rows of stored belong to the request */
} known_truths;

/* Those stored for the point, and where there is none and --derive was given those that a program
 * of reference/derive solves for. A program that fails derives nothing. FAULT: out of memory. */
status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f);
void known_free(known_truths *);

#endif
