/* A verdict in words: what the meshes show, with the numbers that decided. */
#include <math.h>
#include <stdio.h>

#include "harness/judge/verdict.h"

static void passed(const verdict *v, char *text, size_t size)
{
    switch (v->fit.kind) {
    case CONVERGENCE_ORDERLY:
        snprintf(text, size, "converges to the truth, order %.2g", v->fit.order);
        return;
    case CONVERGENCE_FLOOR:
        snprintf(text, size, "has converged to the truth: the last meshes differ by round-off only");
        return;
    case CONVERGENCE_NONE:
        break;
    }
    snprintf(text, size, "the last meshes agree with the truth within the tolerance, but show no order");
}

static void uncertain(const verdict *v, char *text, size_t size)
{
    if (v->fit.kind == CONVERGENCE_NONE && isfinite(v->fit.limit_uncertainty))
        snprintf(text, size, "shows no limit yet: the last two meshes differ by %.2g, the truth is %+.3g %% away",
                 v->fit.limit_uncertainty, 100 * v->error);
    else if (v->fit.kind == CONVERGENCE_NONE)
        snprintf(text, size, "one mesh shows no limit");
    else
        snprintf(text, size, "undecided: its limit is %+.3g %% off, but known to %.2g only", 100 * v->error,
                 v->fit.limit_uncertainty);
}

void verdict_sentence(const verdict *v, double least_order, char *text, size_t size)
{
    switch (v->kind) {
    case VERDICT_PASS:
        passed(v, text, size);
        return;
    case VERDICT_WRONG_LIMIT:
        snprintf(text, size, "converges to a wrong limit: %+.3g %%", 100 * v->error);
        return;
    case VERDICT_LOW_ORDER:
        snprintf(text, size, "converges to the truth, but with order %.2g instead of %.2g", v->fit.order, least_order);
        return;
    case VERDICT_NOT_ASYMPTOTIC:
        uncertain(v, text, size);
        return;
    case VERDICT_DIVERGED:
        snprintf(text, size, "has no value on the finest mesh: %s", v->reason);
        return;
    case VERDICT_REFUSED:
        snprintf(text, size, "refused: %s", v->reason);
        return;
    case VERDICT_SKIP:
        snprintf(text, size, "skipped: %s", v->reason);
        return;
    case VERDICT_NO_TRUTH:
    case VERDICT_KINDS:
        break;
    }
    snprintf(text, size, "no truth to judge by");
}
