/* The steps of a deck, and which printed number of which step is which quantity:
 *
 *   **Q name|unit|displacements or forces|step|node|direction|reciprocal|factor|offset|x
 *
 * value = factor*printed + offset, of the reciprocal of what is printed where it says 1; steps are
 * counted from 1, x [SI] is the abscissa of a curve or empty. */
#ifndef BEAMWORK_ANSWERS_H
#define BEAMWORK_ANSWERS_H

#include "harness/exchange/body.h"

/* All steps: linear analyses and compliances of the undeformed structure, then the static path,
 * with one unit load about its last state. FAULT: out of memory. */
status answers_write(const scene *s, const body_numbers *bodies, FILE *to, fault *f);

#endif
