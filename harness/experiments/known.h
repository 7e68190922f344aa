/* Truths of one point of a sweep. */
#ifndef BEAMWORK_KNOWN_H
#define BEAMWORK_KNOWN_H

#include "harness/experiments/ranges.h"

typedef struct known {
    truths stored, derived;
    int borrowed; /* 1: the rows of stored belong to the request */
} known;

/* Those stored for the point, and where there is none and --derive was given those that a program
 * of reference/derive solves for. A program that fails derives nothing. FAULT: out of memory. */
status known_at(const ranges *r, const point *p, known *out, fault *f);
void known_free(known *);

#endif
