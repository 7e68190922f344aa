/* Who of several processes was the first to solve a thing: the others take its answer. */
#ifndef BEAMWORK_CLAIMS_H
#define BEAMWORK_CLAIMS_H

#include "harness/newton/newton.h"

typedef struct claims claims;

/* Room for so many things, shared with all processes that are started from now on; NULL: no memory.
 */
claims *claims_alloc(int count);
void claims_free(claims *);
/* The task that was the first to claim this; `task` itself where nobody was. */
int claims_take(claims *, const identity *, int task);

#endif
