/* Matrices that are stored whole and may be symmetric all the same. */
#ifndef BEAMWORK_FACTOR_BY_NUMBERS_H
#define BEAMWORK_FACTOR_BY_NUMBERS_H

#include "harness/algebra/sparse.h"

typedef struct by_numbers by_numbers;

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f);
void by_numbers_free(by_numbers *);
/* Largest |a_ij - a_ji|/sqrt|a_ii a_jj| of `a`, whose upper triangle is copied; INFINITY where that
 * has no measure. */
double by_numbers_take(by_numbers *, const sparse *a);
const sparse *by_numbers_upper(const by_numbers *);

#endif
