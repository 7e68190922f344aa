/* Generalized-alpha on the group of rotations (Chung & Hulbert 1993; Bruls, Cardona & Arnold 2012):
 *   inc = h v + h^2 [(1/2 - beta) a + beta a1],  v1 = v + h [(1 - gamma) a + gamma a1],
 *   (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) v1' + alpha_f v',
 * equilibrium with the true accelerations v1' at the end; rotations in the frame's axes. */
#ifndef BEAMWORK_ALPHA_H
#define BEAMWORK_ALPHA_H

#include "harness/time/scheme.h"

/* The error of a step is that of its positions, h^2 |beta + (alpha_m - alpha_f)/2 - 1/6| (a1 - a).
 */
status alpha_alloc(const scheme_request *, motion_scheme **, fault *);

#endif
