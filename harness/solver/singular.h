/* Why a stiffness matrix cannot be factored. */
#ifndef BEAMWORK_SINGULAR_H
#define BEAMWORK_SINGULAR_H

#include "harness/solver/context.h"

/* After the last factorisation failed: the fault with its cause.  A part that the supports leave
 * loose; digits lost in round-off, because of many elements or of stiffnesses far apart; else a
 * critical point.  Work done for it is not counted. */
void singular_explain(analysis_context *c, fault *f);

#endif
