/* Radau IIA of three stages (Hairer & Wanner II, IV.8), order 5, for q' = v, v' = a: positions of
 * the stages are the unknowns, rotations by their vectors in the frame's axes,
 *   t_i' = 1/h sum_j B_ij t_j,  W_i = Jr(t_i) t_i',  a_i = 1/h sum_j B_ij (v_j - v),  B = A^-1,
 * every stage in mixed Newton (N section 4), all three at once. */
#ifndef BEAMWORK_RADAU_H
#define BEAMWORK_RADAU_H

#include "harness/time/scheme.h"

/* With an estimate of the error of each step, of order 3, from one more factorisation. */
status radau_alloc(const scheme_request *, motion_scheme **, fault *);

#endif
