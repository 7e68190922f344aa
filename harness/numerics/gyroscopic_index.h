/* What the negative eigenvalues of K prove of the modes found about an unstable state.
 *
 * (lambda^2 M + lambda G + K) x = 0 with M positive.  Each negative eigenvalue of K belongs to a
 * motion:  negative(K) = real + 2 complex + 2 opposed  counts the growing lambda > 0, the
 * lambda = a + i b with a, b > 0, and the frequencies whose energy x^H (K + omega^2 M) x is
 * negative (T. Kapitula, P. Kevrekidis, B. Sandstede, Physica D 195 (2004) 263-282).  When those
 * found make up the number, none of them is missing.  Then K - omega^2 M + i omega G has the
 * negative eigenvalues of K, one more for each frequency of positive energy below omega, and one
 * less for each opposed one. */
#ifndef BEAMWORK_GYROSCOPIC_INDEX_H
#define BEAMWORK_GYROSCOPIC_INDEX_H

#include "harness/numerics/ritz.h"

typedef struct gyroscopic_index {
    int negative; /* eigenvalues of K that the modes account for */
    int crossed;  /* frequencies of positive energy less the opposed ones */
} gyroscopic_index;

/* Does motion i grow? Its energy is zero then; that of an oscillation is not, so that its real part
 * is rounding, and none. Where two frequencies meet there is neither: they count as oscillations.
 */
int gyroscopic_index_grows(const ritz *, const subspace *, double shift, int i);
/* Of the first `count` pairs, found with S = K + shift M. */
gyroscopic_index gyroscopic_index_of(const ritz *, const subspace *, double shift, int count);

#endif
