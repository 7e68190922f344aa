#include "harness/newton/run_state.h"

#include <stdlib.h>
#include <string.h>

/* Fewer elements than this are done before another thread is awake (measured on the joint and the
 * hexapod). */
enum { ELEMENTS_OF_A_THREAD = 32 };

status run_state_begin(run_state *run, model *m, int threads, fault *f)
{
    const int most = model_sizes(m).elements / ELEMENTS_OF_A_THREAD;
    memset(run, 0, sizeof *run);
    run->m = m;
    return team_alloc(threads < most ? threads : most, &run->team, f);
}

void run_state_end(run_state *run)
{
    free(run->undeformed.of);
    free(run->undeformed.value);
    free(run->ahead);
    free(run->part);
    team_free(run->team);
    memset(run, 0, sizeof *run);
}
