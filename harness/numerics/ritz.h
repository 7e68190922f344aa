/* Approximate eigenpairs of (lambda^2 M + lambda G + K) x = 0 in a subspace: dense problems of
 * twice its size (LAPACK). */
#ifndef BEAMWORK_RITZ_H
#define BEAMWORK_RITZ_H

#include <complex.h>

#include "harness/numerics/subspace.h"

typedef struct ritz {
    int room, count, size;  /* pairs wanted and found; vectors in the basis when they were */
    double complex *lambda; /* [room], ascending in size; one of every lambda, -lambda, conj lambda,
                               -conj lambda */
    double complex *c;      /* [room x basis room] coefficients of x in the basis, of length 1 */
    double complex *left; /* the same of w, w^H (lambda^2 M + lambda G + K) = 0; with S = K it is x
                           */
} ritz;

/* Real part of lambda that is round-off, in parts of |lambda|. */
static const double ritz_imaginary = 1e-7;

status ritz_alloc(ritz *r, int room, const subspace *b, fault *f);
void ritz_free(ritz *r);
/* With S = K: Hermitian, every lambda is imaginary and the positive ones are found. */
status ritz_hermitian(const subspace *b, ritz *r, fault *f);
/* With S = K + shift M. */
status ritz_general(const subspace *b, double shift, ritz *r, fault *f);

#endif
