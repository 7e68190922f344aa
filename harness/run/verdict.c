#include "harness/run/verdict.h"

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

/* Against the truth, once there is a limit. */
static verdict_kind compare(const scene_quantity *q, const verdict *v, const history *h)
{
    const double finest = fabs(v->finest - v->truth->value), limit = fabs(v->fit.limit - v->truth->value),
                 coarse = h->count > 1 ? fabs(h->value[0] - v->truth->value) : finest;
    const int inside = finest <= v->tolerance || (v->fit.kind != CONVERGENCE_NONE && limit <= v->tolerance);
    if (!inside) {
        if (v->fit.kind == CONVERGENCE_NONE || limit <= v->tolerance + 2 * v->fit.limit_uncertainty)
            return VERDICT_NOT_ASYMPTOTIC;
        return VERDICT_WRONG_LIMIT;
    }
    /* An order is asked for where the error of the coarsest mesh leaves one to be seen. */
    const int visible = v->fit.kind == CONVERGENCE_ORDERLY && coarse > 10 * v->tolerance;
    if (q->least_order > 0 && visible && v->fit.order < q->least_order - order_slack && finest > v->tolerance)
        return VERDICT_LOW_ORDER;
    return VERDICT_PASS;
}

static void judge_one(const sweep *s, truths *t, verdict *v)
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

static verdict_kind kind_of(const char *name)
{
    for (int i = 0; i < VERDICT_KINDS; i++)
        if (strcmp(names[i], name) == 0)
            return (verdict_kind)i;
    return VERDICT_KINDS; /* matches nothing */
}

/* The first finding that speaks of this verdict sets what is expected, limit included. */
static void expect(const sweep *s, truths *t, verdict *v)
{
    const series *one = &s->series[v->series];
    const point *p = &s->point[one->point];
    v->matches = v->kind == v->expected;
    if (v->kind == VERDICT_SKIP)
        return;
    for (int i = 0; i < t->findings; i++) {
        finding *known = &t->finding[i];
        if (!finding_holds(known, p->type, p->parameter, one->formulation.key, p->scene.quantity[v->quantity].name))
            continue;
        v->finding = known;
        v->expected = kind_of(known->verdict);
        v->matches = v->kind == v->expected;
        if (v->matches && isfinite(known->limit) && !(fabs(v->fit.limit - known->limit) <= known->uncertainty)) {
            v->matches = 0;
            snprintf(v->reason, sizeof v->reason, "its limit differs from the finding's %.10g", known->limit);
        }
        known->observed += v->matches;
        return;
    }
}

static status add_agreements(const sweep *s, const truths *t, int index, judgement *out, fault *f)
{
    const series *one = &s->series[index];
    const point *p = &s->point[one->point];
    for (int r = 0; r < t->rows && one->missing[0] == '\0'; r++) {
        const truth *row = &t->row[r];
        if (row->elements == 0 || strcmp(row->formulation, one->formulation.key) != 0 || !truth_holds(row, p->type, p->parameter))
            continue;
        for (int i = 0; i < one->meshes; i++)
            for (int q = 0; q < p->scene.quantities && one->mesh[i] == row->elements; q++) {
                if (strcmp(p->scene.quantity[q].name, row->quantity) != 0)
                    continue;
                agreement *more = realloc(out->agreement, (size_t)(out->agreements + 1) * sizeof *more);
                if (more == NULL)
                    return fault_set(f, STATUS_FAULT, "out of memory for agreements");
                out->agreement = more;
                const solve_result *result = &one->cell[i].solve;
                const double value = q < result->quantities ? result->quantity[q].value : NAN;
                const int good = fabs(value - row->value) <= fmax(row->uncertainty, 1e-6 * fabs(row->value));
                more[out->agreements++] = (agreement){index, i, q, row, value, good};
                out->disagreements += !good;
            }
    }
    return STATUS_OK;
}

status judge(const sweep *s, truths *t, int whole, judgement *out, fault *f)
{
    int count = 0;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < t->findings; i++)
        t->finding[i].observed = 0;
    for (int i = 0; i < s->seriess; i++)
        count += s->point[s->series[i].point].scene.quantities;
    out->verdict = calloc((size_t)count + 1, sizeof *out->verdict);
    if (out->verdict == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for verdicts");
    for (int i = 0; i < s->seriess; i++) {
        const point *p = &s->point[s->series[i].point];
        for (int q = 0; q < p->scene.quantities; q++) {
            if (p->scene.quantity[q].reduction == SCENE_CURVE)
                continue; /* curves are drawn, their points are judged by their own quantities */
            verdict *v = &out->verdict[out->verdicts++];
            v->series = i;
            v->quantity = q;
            judge_one(s, t, v);
            expect(s, t, v);
            out->by_kind[v->kind]++;
            out->judged += v->truth != NULL && v->kind != VERDICT_SKIP;
            out->unexpected += !v->matches;
        }
        const status outcome = add_agreements(s, t, i, out, f);
        if (outcome != STATUS_OK)
            return outcome;
    }
    for (int i = 0; i < t->findings && whole; i++)
        out->unobserved += t->finding[i].observed == 0;
    return STATUS_OK;
}

void judgement_free(judgement *j)
{
    free(j->verdict);
    free(j->agreement);
    memset(j, 0, sizeof *j);
}

int judgement_exit(const judgement *j)
{
    if (j->judged + j->agreements == 0)
        return 3;
    return j->unexpected + j->disagreements + j->unobserved > 0 ? 1 : 0;
}
