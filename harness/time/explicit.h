/* Runge-Kutta of order 8 with an error estimate of order 7 (Prince & Dormand 1981, rk8pd of GSL)
 * for inc' = X v,  v' = M^-1 (f - h - J^T sigma), X the inverse Jacobian of turning.h for rotations
 * in the frame's axes, 1 else: for truths of a mesh. Positions are increments from the begin of
 * each step. */
#ifndef BEAMWORK_EXPLICIT_H
#define BEAMWORK_EXPLICIT_H

#include "harness/time/scheme.h"

/* REFUSED: a coordinate has no inertia. */
status explicit_alloc(const scheme_request *, motion_scheme **, fault *);

#endif
