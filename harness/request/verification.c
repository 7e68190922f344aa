#include "harness/request/verification.h"

#include "harness/judge/judgement.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"

static int doubts(void *context, const sweep *s, int series_index)
{
    return judgement_doubts(s, context, series_index);
}

status verification_run(const sweep_request *request, truths *t, sweep *s, fault *f)
{
    TRY(plan_sweep(request, t, s, f));
    return verification_run_planned(request, t, s, f);
}

status verification_run_planned(const sweep_request *request, truths *t, sweep *s, fault *f)
{
    const sweep_follower follower = {.context = t, .doubts = doubts};
    sweep_request followed = *request;
    followed.follower = &follower;
    return run_sweep(&followed, s, f);
}
