#include "harness/cli/convergence_work.h"

#include "harness/study/run.h"

static status run(const sweep_work *of, sweep *part, fault *f)
{
    sweep_request alone = *of->request;
    alone.jobs = 1;
    alone.together = 1;
    alone.progress = NULL;
    return run_sweep(&alone, part, f);
}

status convergence_work_run(const shard_options *r, const sweep_request *request, sweep *s,
                            spread_end *out, fault *f)
{
    int asked;
    *out = (spread_end){.ended = 0};
    TRY(spread_asked(r, &asked, f));
    if (!asked)
        return run_sweep(request, s, f);
    const sweep_work of = {.verb = "converge", .request = request, .run = run};
    return sweep_work_do(&of, r, s, out, f);
}
