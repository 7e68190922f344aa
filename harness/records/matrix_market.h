/* Matrices as text that other programs read: Matrix Market, coordinate format (R. F. Boisvert,
 * R. Pozo, K. A. Remington, NISTIR 5935, 1996), 17 digits. */
#ifndef BEAMWORK_MATRIX_MARKET_H
#define BEAMWORK_MATRIX_MARKET_H

#include <stdio.h>

#include "harness/newton/newton.h"

/* comment: one line, or NULL. */
void matrix_market_write(FILE *to, const triplets *, const char *comment);

#endif
