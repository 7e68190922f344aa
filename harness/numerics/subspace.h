/* A growing real basis V of a quadratic eigenvalue problem, orthonormal in K + shift M, with the
 * matrices projected on it. */
#ifndef BEAMWORK_SUBSPACE_H
#define BEAMWORK_SUBSPACE_H

#include "harness/numerics/eigen.h"

typedef struct subspace {
    eigen_product *S; /* y = S x, S = K + shift M, positive definite */
    void *context;
    const sparse *M, *G; /* of G a symmetric pattern stores the upper triangle */
    int n, count, room;
    double *V, *SV, *MV, *GV; /* [room x n] the basis and its products */
    double *Mp, *Gp;          /* [room x room] V^T M V, V^T G V */
} subspace;

status subspace_alloc(subspace *b, eigen_product *S, void *context, const sparse *M,
                      const sparse *G, int room, fault *f);
void subspace_free(subspace *b);
/* Takes in what x adds to the basis; returns 1 if that was anything and there was room. */
int subspace_add(subspace *b, const double x[]);
/* y = G x with G skew, of which the upper triangle is stored. */
void subspace_skew_mul(const sparse *G, const double x[], double y[]);

#endif
