#include "harness/cli/timing_work.h"

#include "harness/study/run.h"
#include "harness/study/timing.h"

static status run(const sweep_work *of, sweep *part, fault *f)
{
    sweep_request alone = *of->request;
    alone.jobs = 1;
    alone.together = 1;
    alone.progress = NULL;
    TRY(run_sweep(&alone, part, f));
    if (part->threads <= 1)
        rounds_pin();
    return timing_run(part, of->floor, of->dense, NULL, f);
}

status timing_work_run(const shard_options *r, const sweep_request *request, double floor,
                       int dense, sweep *s, int *asked, spread_end *out, fault *f)
{
    *out = (spread_end){.ended = 0};
    TRY(spread_asked(r, asked, f));
    const sweep_work of = {.verb = "bench",
                           .request = request,
                           .run = run,
                           .points = 1,
                           .floor = floor,
                           .dense = dense};
    return *asked ? sweep_work_do(&of, r, s, out, f) : STATUS_OK;
}
