/* Why a stiffness matrix cannot be factored. */
#ifndef BEAMWORK_SINGULAR_H
#define BEAMWORK_SINGULAR_H

#include "harness/newton/context.h"

/* SINGULAR with the motion where released ends make the undeformed structure a mechanism; else
 * `otherwise`, f as it is. */
status singular_mechanism(const analysis_context *c, status otherwise, fault *f);

/* After the last factorisation failed: the fault with its cause.  A part that the supports leave
 * loose; digits lost in round-off, because of many elements or of stiffnesses far apart; else a
 * critical point.  Work done for it is not counted. */
void singular_explain(analysis_context *c, fault *f);

#endif
