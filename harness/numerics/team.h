/* Threads that share a loop. Each takes one run of consecutive indices, so that what is written
 * where does not depend on their number. */
#ifndef BEAMWORK_TEAM_H
#define BEAMWORK_TEAM_H

#include "elements/shared/status.h"

typedef struct thread_team thread_team;
typedef void team_work(void *context, int first, int end); /* [first, end) */

/* One piece of work into a slot; all members. */
typedef void team_fill(void *context, int piece, int slot);
/* What a slot holds is used up, by the caller; 0: that was the last piece that is wanted. */
typedef int team_take(void *context, int piece, int slot);

enum { TEAM_MOST = 16, TEAM_SLOTS = 8 };

status team_alloc(int threads, thread_team **out,
                  fault *f); /* the caller is one of them; threads <= 1: *out = NULL */
void team_free(thread_team *t);
/* work over [0, count), shared; t NULL: by the caller alone. Returns when all is done. */
void team_run(thread_team *t, int count, team_work *work, void *context);
/* Pieces [0, pieces) are filled by whoever is free, a few ahead, and taken in their order by the
 * caller, who fills too: slots stay in the cache, and sums keep their order. slot: below
 * TEAM_SLOTS, and 0 where t is NULL. */
void team_relay(thread_team *t, int pieces, team_fill *fill, team_take *take, void *context);

#endif
