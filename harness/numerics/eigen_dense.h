/* Eigenvectors of small problems: all of them, by LAPACK. */
#ifndef BEAMWORK_EIGEN_DENSE_H
#define BEAMWORK_EIGEN_DENSE_H

#include "harness/numerics/candidates.h"

/* The first wanted[i] of the most positive (0) and of the most negative (1) side become candidates;
 * NULL: a side that is not asked for. */
status eigen_dense_add(candidates *const side[2], const int wanted[2], fault *f);

#endif
