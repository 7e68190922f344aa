#include "harness/judge/verdict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[VERDICT_KINDS] = {"pass",     "wrong limit", "low order", "not asymptotic",
                                                 "diverged", "refused",     "skip",      "no truth"};
static const double order_slack = 0.3; /* an order seen on finite meshes is not sharper */

const char *verdict_name(verdict_kind kind)
{
    return names[kind];
}

static double scale_of(const scene_quantity *q, double truth_value)
{
    return fmax(fabs(truth_value), q->near_zero);
}

double relative_error(const scene_quantity *q, double value, double truth_value)
{
    const double scale = scale_of(q, truth_value);
    return scale > 0 ? (value - truth_value) / scale : value - truth_value;
}

/* Values of the meshes that have one, and the first failure. */
typedef struct history {
    int count, n[SERIES_MAX_MESHES];
    double value[SERIES_MAX_MESHES];
    status failure; /* of the finest mesh */
    const char *reason;
} history;

static history history_of(const series *s, int quantity)
{
    history h = {.failure = STATUS_OK, .reason = ""};
    for (int i = 0; i < s->meshes; i++) {
        const solve_result *r = &s->cell[i].solve;
        const quantity_result *q = quantity < r->quantities ? &r->quantity[quantity] : NULL;
        const int good = q != NULL && q->status == STATUS_OK && isfinite(q->value);
        h.failure = good                                  ? STATUS_OK
                    : q != NULL && q->status != STATUS_OK ? q->status
                    : r->status != STATUS_OK              ? r->status
                                                          : STATUS_NOT_CONVERGED;
        h.reason = good ? "" : q != NULL && q->reason[0] != '\0' ? q->reason : r->reason;
        if (good) {
            h.n[h.count] = s->mesh[i];
            h.value[h.count++] = q->value;
        }
    }
    return h;
}

/* Is the order that the last meshes show both known and too low?  Differences that the truth's own uncertainty hides, or
 * orders that still change from mesh to mesh, say nothing. */
static int order_is_low(const scene_quantity *q, const verdict *v, const history *h)
{
    const int settled = h->count == 3 || isfinite(v->fit.order_uncertainty);
    const double doubt = h->count == 3 ? 0 : v->fit.order_uncertainty;
    return v->fit.kind == CONVERGENCE_ORDERLY && settled && v->fit.order + doubt < q->least_order - order_slack &&
           fabs(v->finest - h->value[h->count - 2]) > v->truth->uncertainty;
}

/* Against the truth. */
static verdict_kind compare(const scene_quantity *q, const verdict *v, const history *h)
{
    const double limit = fabs(v->fit.limit - v->truth->value);
    if (v->fit.kind == CONVERGENCE_NONE) /* no limit: the last two meshes must both be there */
        return h->count > 1 && limit + v->fit.limit_uncertainty <= v->tolerance ? VERDICT_PASS : VERDICT_NOT_ASYMPTOTIC;
    if (limit > v->tolerance)
        return limit <= v->tolerance + 2 * v->fit.limit_uncertainty ? VERDICT_NOT_ASYMPTOTIC : VERDICT_WRONG_LIMIT;
    return order_is_low(q, v, h) ? VERDICT_LOW_ORDER : VERDICT_PASS;
}

void verdict_reach(const sweep *s, const truths *t, verdict *v)
{
    const series *one = &s->series[v->series];
    const point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[v->quantity];
    v->finest = v->error = v->model_error = v->fit.limit = v->fit.limit_uncertainty = v->fit.order = v->fit.order_uncertainty = NAN;
    v->truth = truth_of(t, p->type, p->parameter, q->name, "same");
    v->model_truth = truth_of(t, p->type, p->parameter, q->name, "other");
    v->expected = VERDICT_PASS;
    if (one->missing[0] != '\0') {
        v->kind = v->expected = VERDICT_SKIP;
        snprintf(v->reason, sizeof v->reason, "does not offer %s", one->missing);
        return;
    }
    if (p->status != STATUS_OK) {
        v->kind = p->status == STATUS_REFUSED ? VERDICT_REFUSED : VERDICT_DIVERGED;
        snprintf(v->reason, sizeof v->reason, "%s", p->reason);
        return;
    }
    const history h = history_of(one, v->quantity);
    const int last = h.count - 1;
    if (h.failure != STATUS_OK || h.count == 0) {
        v->kind = h.failure == STATUS_REFUSED ? VERDICT_REFUSED : VERDICT_DIVERGED;
        snprintf(v->reason, sizeof v->reason, "%s", h.reason);
        return;
    }
    v->finest = h.value[last];
    v->fit = convergence_of(h.count, h.n, h.value, scale_of(q, v->truth != NULL ? v->truth->value : v->finest));
    if (v->model_truth != NULL)
        v->model_error = relative_error(q, v->fit.limit, v->model_truth->value);
    if (v->truth == NULL) {
        v->kind = v->expected = VERDICT_NO_TRUTH;
        return;
    }
    v->tolerance = q->tolerance * scale_of(q, v->truth->value) + v->truth->uncertainty;
    v->error = relative_error(q, v->fit.kind == CONVERGENCE_NONE ? v->finest : v->fit.limit, v->truth->value);
    v->kind = compare(q, v, &h);
}
