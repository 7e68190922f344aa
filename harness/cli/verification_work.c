#include "harness/cli/verification_work.h"

#include "harness/experiments/verification.h"

/* In a process of its own: one worker, which nobody asks to end. */
static status run(const sweep_work *of, sweep *part, fault *f)
{
    sweep_request alone = *of->request;
    alone.jobs = 1;
    alone.together = 1;
    alone.interruptible = 0;
    alone.progress = NULL;
    return verification_cells(&alone, of->t, part, f);
}

status verification_work_run(const shard_options *r, const sweep_request *request, truths *t,
                             sweep *s, spread_end *out, fault *f)
{
    const sweep_work of = {.verb = "verify", .request = request, .t = t, .run = run};
    return sweep_work_do(&of, r, s, out, f);
}
