/* Candidates made better where assembling K has lost digits of its soft motions. */
#ifndef BEAMWORK_POLISH_H
#define BEAMWORK_POLISH_H

#include "harness/numerics/candidates.h"

/* Replaces the candidates by Ritz vectors among K^-1 A times them, with refined solutions
 * (candidates_refine): parts that are not among them shrink by the quotient of their mu and the
 * candidate's. One refined solution each. */
status polish(candidates *p, long *solutions, fault *f);

#endif
