#include "harness/spread/verification_work.h"

#include "harness/request/verification.h"
#include "harness/study/plan.h"

/* In a process of its own: one worker, which nobody asks to end. */
static status run(const sweep_work *of, sweep *part, fault *f)
{
    sweep_request alone = *of->request;
    alone.jobs = 1;
    alone.together = 1;
    alone.interruptible = 0;
    alone.progress = NULL;
    return verification_run_planned(&alone, of->t, part, f);
}

status verification_work_run(const command_request *r, const sweep_request *request, truths *t,
                             sweep *s, spread_end *out, fault *f)
{
    int asked;
    *out = (spread_end){.ended = 0};
    TRY(spread_asked(r, &asked, f));
    if (!asked)
        return verification_run(request, t, s, f);
    const sweep_work of = {.verb = "verify", .request = request, .t = t, .run = run};
    TRY(plan_sweep(request, t, s, f));
    return sweep_work_do(&of, r, s, out, f);
}
