#include "harness/request/verification.h"

#include <stdlib.h>

#include "harness/judge/judgement.h"
#include "harness/study/noise.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"

static status measure_noise(const sweep_request *request, const truths *t, sweep *s, fault *f)
{
    char *wanted = malloc((size_t)s->seriess + 1);
    if (wanted == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for noise");
    judgement_doubts(s, t, wanted);
    const status outcome = noise_measure(request, wanted, s, f);
    free(wanted);
    return outcome;
}

status verification_run(const sweep_request *request, const truths *t, sweep *s, fault *f)
{
    TRY(plan_sweep(request, t, s, f));
    TRY(run_sweep(request, s, f));
    return s->unfinished == 0 ? measure_noise(request, t, s, f) : STATUS_OK;
}
