/* Quantities of a continued path. */
#include "harness/analysis/continuation_extract.h"

#include <math.h>
#include <stdio.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"

int continuation_extract_keeps_states(const scene *s, int analysis)
{
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        if (scene_asks(q, analysis, SCENE_COORDINATE) && q->reduction == SCENE_CURVE)
            return 1;
    }
    return 0;
}

/* Load factor or coordinate against the control coordinate, at every point. */
static void take_curve(const analysis_context *c, const scene_quantity *q,
                       const analysis_outcome *o, quantity_result *r)
{
    const outcome_continuation *p = outcome_continuation_of(o);
    if (!quantity_curve(r, p->points))
        return;
    for (int i = 0; i < p->points; i++) {
        const double value =
            q->what.kind == SCENE_FACTOR_AT
                ? p->factor[i]
                : kinematics_component(c->model, p->state[i], scene_component_of(q)->node,
                                       scene_component_of(q)->component);
        r->curve.x[i] = quantity_abscissa(q, p->control[i]);
        r->curve.value[i] = quantity_scaled(q, value);
    }
    r->value = p->points > 0 ? r->curve.value[p->points - 1] : NAN;
    if (o->status != STATUS_OK)
        quantity_no_value(r, o->status, o->reason);
}

static void take_critical(const analysis_context *c, const scene_quantity *q,
                          const analysis_outcome *o, quantity_result *r)
{
    const scene_point *what = scene_point_of(q);
    const event_kind kind = what->kind == SCENE_LIMIT_POINT ? EVENT_LIMIT_POINT : EVENT_BIFURCATION;
    const outcome_continuation *p = outcome_continuation_of(o);
    int order = 0;
    for (int i = 0; i < (p->undecided ? p->decided_events : c->result->events); i++) {
        const path_event *e = &c->result->event[i];
        if (e->analysis != q->analysis || e->kind != kind)
            continue;
        order += result_event_multiplicity(e);
        if (order <= what->order)
            continue;
        r->value = quantity_scaled(q, what->ordinate == SCENE_LOAD_FACTOR ? e->factor : e->control);
        r->x = quantity_abscissa(q, e->control);
        return;
    }
    if (o->status != STATUS_OK)
        quantity_no_value(r, o->status, o->reason);
    else if (p->undecided) {
        char reason[FAULT_TEXT];
        snprintf(
            reason, sizeof reason,
            "undecided: between load factors %.6g and %.6g an eigenvalue of the tangent comes too "
            "near to zero to decide whether it passes it; use smaller steps, or a load that "
            "differs a "
            "little",
            p->undecided_from, p->undecided_to);
        quantity_no_value(r, STATUS_NOT_CONVERGED, reason);
    } else
        quantity_no_value(r, o->status, "no such point on the path");
}

int continuation_extract(const analysis_context *c, const scene_quantity *q,
                         const analysis_outcome *o, quantity_result *r)
{
    if (q->what.kind == SCENE_CRITICAL_POINT)
        take_critical(c, q, o, r);
    else if (q->reduction == SCENE_CURVE &&
             (q->what.kind == SCENE_FACTOR_AT || q->what.kind == SCENE_COORDINATE))
        take_curve(c, q, o, r);
    else
        return 0;
    return 1;
}
