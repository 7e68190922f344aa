#include "harness/newton/run_state.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

/* Fewer elements than this are done before another thread is awake (measured on the joint and the
 * hexapod). */
enum { ELEMENTS_OF_A_THREAD = 32 };

status linear_memory_alloc(const model *m, linear_memory *out, fault *f)
{
    out->slot =
        malloc(((size_t)model_elements(m) * (size_t)model_work_size(m) + 1) * sizeof *out->slot);
    return out->slot != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED, "%d elements: more than memory allows; give fewer",
                           model_elements(m));
}

void linear_memory_free(linear_memory *memory)
{
    free(memory->slot);
    memory->slot = NULL;
}

static status begin(run_state *run, const model *m, int threads, fault *f)
{
    const int most = model_sizes(m).elements / ELEMENTS_OF_A_THREAD;
    TRY(assemble_patterns_alloc(&run->patterns, f));
    TRY(linear_memory_alloc(m, &run->memory, f));
    return team_alloc(threads < most ? threads : most, &run->team, f);
}

status run_state_begin(run_state *run, const model *m, int threads, fault *f)
{
    memset(run, 0, sizeof *run);
    const status outcome = begin(run, m, threads, f);
    if (outcome != STATUS_OK)
        run_state_end(run);
    return outcome;
}

void run_state_end(run_state *run)
{
    free(run->undeformed.of);
    free(run->undeformed.value);
    free(run->ahead);
    free(run->part);
    team_free(run->team);
    assemble_patterns_free(run->patterns);
    linear_memory_free(&run->memory);
    memset(run, 0, sizeof *run);
}

element_rotating_frame loading_frame(const loading *l, double path)
{
    element_rotating_frame frame = l->frame;
    if (l->rotation_follows_path)
        for (int i = 0; i < 3; i++)
            frame.omega[i] *= path;
    return frame;
}
