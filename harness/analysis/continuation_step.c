#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"

static int continuation_extract_keeps_states(const scene *, int analysis);

status continuation_step_alloc(analysis_context *c, int analysis, outcome_continuation *o,
                               continuation *p, fault *f)
{
    memset(p, 0, sizeof *p);
    p->c = c;
    p->by = &scene_continuation_of(&c->scene->analysis[analysis])->control;
    p->path = scene_path_of(&c->scene->analysis[analysis]);
    p->o = o;
    p->analysis = analysis;
    p->keeps_states = continuation_extract_keeps_states(c->scene, analysis);
    for (int i = 0; i < c->scene->quantities; i++)
        p->needs_critical |= scene_requests(&c->scene->quantity[i], analysis, SCENE_CRITICAL_POINT);
    if (c->options->newton == NEWTON_DENSE)
        return fault_set(
            f, STATUS_REFUSED,
            "continuation requires a factorised tangent; give newton=mixed or newton=displacement");
    TRY(newton_alloc(c, 1, &p->n, f));
    TRY(outcome_stations(&o->path, p->path->stations, f));
    TRY(kinematics_state_alloc(c->model, &p->end, f));
    double **const vector[] = {&p->weight, &p->load,         &p->response,     &p->moved,
                               &p->mode,   &p->here.tangent, &p->next.tangent, &p->trial.tangent};
    for (size_t i = 0; i < sizeof vector / sizeof vector[0]; i++)
        if ((*vector[i] = calloc((size_t)p->n.all + 1, sizeof(double))) == NULL)
            return fault_memory(f, "a path");
    metric_of(c->model, p->weight);
    return STATUS_OK;
}

void continuation_step_free(continuation *p)
{
    newton_free(&p->n);
    flutter_check_free(&p->flutter);
    kinematics_state_free(p->end);
    free(p->weight);
    free(p->load);
    free(p->response);
    free(p->moved);
    free(p->mode);
    free(p->here.tangent);
    free(p->next.tangent);
    free(p->trial.tangent);
}

double continuation_step_dot(const continuation *p, const double a[], const double b[])
{
    double sum = 0;
    for (int k = 0; k < p->n.free; k++)
        sum += p->weight[k] * a[k] * b[k];
    return sum;
}

/* Computes n.dx = K^-1 r and response = K^-1 f' in the current state. */
static status directions(continuation *p, step_record *record, fault *f)
{
    const double load = kinematics_state_path(p->n.state);
    if (p->looked)
        return STATUS_OK;
    TRY(newton_direction(&p->n, load, record, f));
    loads_rate(&p->c->eq, p->n.state, load, p->load);
    memset(p->response, 0, (size_t)p->n.all * sizeof *p->response);
    memcpy(p->response, p->load, (size_t)p->n.free * sizeof *p->response);
    factor_solve(p->n.factor, p->response);
    return STATUS_OK;
}

static double control_value(const continuation *p)
{
    return kinematics_component(p->c->model, p->n.state, p->by->node, p->by->component);
}

static double residual_of(const continuation *p, path_goal goal)
{
    return goal.value -
           (goal.by_arc ? continuation_step_dot(p, p->here.tangent, p->moved) : control_value(p));
}

static double change_of(const continuation *p, path_goal goal, const double dx[])
{
    if (goal.by_arc)
        return continuation_step_dot(p, p->here.tangent, dx);
    int index[6];
    double T[36], sum = 0;
    const int n = kinematics_node_jacobian(p->c->model, p->n.state, p->by->node, 6, index, T);
    for (int k = 0; k < n; k++)
        sum += T[p->by->component * n + k] * dx[index[k]];
    return sum;
}

status continuation_step_correct(continuation *p, path_goal goal, step_record *record, fault *f)
{
    memset(p->moved, 0, (size_t)p->n.all * sizeof *p->moved);
    return continuation_step_go_on(p, goal, record, f);
}

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    continuation *p = of;
    newton_run *n = &p->n;
    (void)iteration;
    TRY(directions(p, record, f));
    const double change = change_of(p, p->goal, p->response);
    const double more = (residual_of(p, p->goal) - change_of(p, p->goal, n->dx)) / change;
    if (!isfinite(more))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "the load does not move the control coordinate at factor %g%s",
                         kinematics_state_path(n->state),
                         along_path_end(n->c->scene, n->c->eq.loading.acting).text);
    double energy = 0;
    for (int k = 0; k < n->free; k++) {
        n->dx[k] += more * p->response[k];
        p->moved[k] += n->dx[k];
        energy += n->dx[k] * (n->residual[k] + more * p->load[k]);
    }
    n->energy = fabs(energy);
    p->looked = 0;
    newton_advance(n, kinematics_state_path(n->state) + more, out);
    return STATUS_OK;
}

status continuation_step_go_on(continuation *p, path_goal goal, step_record *record, fault *f)
{
    const newton_use use = newton_on_path(&p->n, p, correct);
    p->goal = goal;
    return newton_iterate(p->c, &use, &p->n.newton_convergence, record, f);
}

/* Counts the eigenvalues to the left of the imaginary axis for an unsymmetric tangent, to which
 * Sylvester's law of inertia does not apply. */
static status index_of(continuation *p, path_point *out, fault *f)
{
    left_of_axis left;
    TRY(left_count(p->n.factor, p->n.free, p->weight, &left, f));
    out->negative = left.count;
    out->nearest = left.nearest;
    for (int i = 0; i < left.nearest; i++)
        out->mu[i] = left.mu[i];
    out->least = left.nearest > 0 ? creal(left.mu[0]) : NAN;
    return STATUS_OK;
}

static status point_of(continuation *p, const double along[], path_point *out,
                       const step_record *record, fault *f)
{
    const double length = sqrt(continuation_step_dot(p, p->response, p->response));
    if (!(length > 0) || !isfinite(length))
        return fault_set(f, STATUS_SINGULAR,
                         "the loads cause no displacement; apply a load along a free coordinate");
    const double sign = along != NULL && continuation_step_dot(p, along, p->response) < 0 ? -1 : 1;
    for (int k = 0; k < p->n.all; k++)
        out->tangent[k] = sign * p->response[k] / length;
    out->rate = sign / length;
    out->factor = kinematics_state_path(p->n.state);
    out->control = control_value(p);
    out->negative = record->negative_pivots;
    out->symmetric = out->negative >= 0;
    const factor_counts counts = factor_count(p->n.factor);
    out->determinant = counts.determinant;
    out->lost = counts.lost;
    out->least = NAN;
    out->nearest = 0;
    p->looked = 1;
    return out->symmetric ? STATUS_OK : index_of(p, out, f);
}

status continuation_step_look(continuation *p, const double along[], path_point *out,
                              step_record *record, fault *f)
{
    p->looked = 0;
    TRY(directions(p, record, f));
    return point_of(p, along, out, record, f);
}

status continuation_step_check(const path_point *at, fault *f)
{
    return at->lost ? factor_report_singular(f) : STATUS_OK;
}

status continuation_step_end(continuation *p, path_point *out, const step_record *record, fault *f)
{
    memset(p->n.dx, 0, (size_t)p->n.all * sizeof *p->n.dx);
    memset(p->n.residual, 0, (size_t)p->n.all * sizeof *p->n.residual);
    advance_settle(p->c->model, &p->c->run->memory, p->n.state);
    TRY(point_of(p, p->moved, out, record, f));
    return continuation_step_check(out, f);
}

void continuation_step_go_back(continuation *p)
{
    kinematics_state_copy(p->c->model, p->n.backup, p->n.state);
    p->looked = 0;
}

static int continuation_extract_keeps_states(const scene *s, int analysis)
{
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        if (scene_requests(q, analysis, SCENE_COORDINATE) && q->reduction == SCENE_CURVE)
            return 1;
    }
    return 0;
}

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
        const int is_load = what->ordinate == SCENE_LOAD_FACTOR;
        const double value = is_load ? e->factor : e->control,
                     error = is_load ? e->factor_error : e->control_error;
        r->value = quantity_scaled(q, value);
        r->rounding = error > 0 ? fabs(q->factor * error / r->value) : 0;
        r->x = quantity_abscissa(q, e->control);
        return;
    }
    if (o->status != STATUS_OK)
        quantity_no_value(r, o->status, o->reason);
    else if (p->undecided) {
        char reason[FAULT_TEXT];
        snprintf(
            reason, sizeof reason,
            "undecided: between load factors %.6g and %.6g an eigenvalue of the tangent is "
            "too close to zero "
            "to decide whether it changes sign; use smaller steps, or a slightly different load",
            p->undecided_from, p->undecided_to);
        quantity_no_value(r, STATUS_NOT_CONVERGED, reason);
    } else
        quantity_no_value(
            r, o->status,
            "the path has too few critical points of this kind; follow the path further "
            "('to'), or request a lower index ('which')");
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
