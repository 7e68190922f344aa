/* A verdict in words: what the meshes show, with the numbers that decided. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/judge/sentence.h"

static void passed(const verdict *v, char *text, size_t size)
{
    const char *digits = v->below_digits ? "; the difference is below the truth's digits" : "";
    if (v->fit.kind == LIMIT_NOISE_DOMINATED)
        snprintf(text, size, "has converged to the truth: the last meshes differ by noise only%s",
                 digits);
    else if (isfinite(v->fit.order))
        snprintf(text, size, "converges to the truth, order %.2g%s", v->fit.order, digits);
    else
        snprintf(text, size, "agrees with the truth within the tolerance, without an order%s",
                 digits);
}

static void undecided(const verdict *v, char *text, size_t size)
{
    if (isfinite(v->fit.limit_uncertainty))
        snprintf(
            text, size, "undecided: its limit is %+.3g %% off, known to %.2g only (%s, %d meshes)",
            100 * v->error, v->fit.limit_uncertainty, limit_kind_name(v->fit.kind), v->fit.meshes);
    else
        snprintf(text, size, "undecided: one mesh shows no limit");
}

static void unjudged(const verdict *v, char *text, size_t size)
{
    if (v->model_truth != NULL && v->model_truth->theory[0] != '\0')
        snprintf(text, size,
                 "no truth of its theory of shear; its limit is %+.3g %% from that of %s",
                 100 * v->model_error, v->model_truth->theory);
    else if (v->model_truth != NULL && strcmp(v->model_truth->kind, "agreement") == 0)
        snprintf(text, size, "no truth to judge by; its limit is %+.2g %% from that on which %s",
                 100 * v->model_error, v->model_truth->source);
    else
        snprintf(text, size, "no truth to judge by");
}

void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size)
{
    switch (v->kind) {
    case VERDICT_PASS:
        passed(v, text, size);
        return;
    case VERDICT_BIASED:
        snprintf(text, size, "has a limit of its own within the tolerance: %+.3g %%",
                 100 * v->error);
        return;
    case VERDICT_WRONG_LIMIT:
        snprintf(text, size, "converges to a wrong limit: %+.3g %%", 100 * v->error);
        return;
    case VERDICT_BIASED_AS_PREDICTED:
    case VERDICT_WRONG_AS_PREDICTED:
        snprintf(text, size,
                 "converges to the limit that was derived for it, %.10g: %+.3g %% from the truth",
                 v->predicted->value, 100 * v->error);
        return;
    case VERDICT_LOW_ORDER:
        snprintf(text, size, "converges to the truth, but with order %.2g instead of %.2g",
                 v->fit.order, least_order);
        return;
    case VERDICT_UNDECIDED:
        undecided(v, text, size);
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
    unjudged(v, text, size);
}
