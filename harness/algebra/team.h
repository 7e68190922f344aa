/* Threads that share a loop. Each takes one run of consecutive indices, so that what is written
 * where does not depend on their number. */
#ifndef BEAMWORK_TEAM_H
#define BEAMWORK_TEAM_H

#include "elements/shared/status.h"

typedef struct team team;
typedef void team_work(void *context, int first, int end); /* [first, end) */

enum { TEAM_MOST = 16 };

status team_alloc(int threads, team **out,
                  fault *f); /* the caller is one of them; threads <= 1: *out = NULL */
void team_free(team *t);
/* work over [0, count), shared; t NULL: by the caller alone. Returns when all is done. */
void team_run(team *t, int count, team_work *work, void *context);

#endif
