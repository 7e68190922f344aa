/* Continuation of an equilibrium path with displacement or arc length control. A step is repeated
 * in smaller steps if the path rotates too far in the step, or if the change of the tangent
 * stiffness indicates more than one critical point. If the smaller steps end at a different point,
 * the first step has jumped to another branch. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>

#include "harness/model/model.h"

/* Returns the reason why the step from `here` to `next` is too long or led to another branch; NULL:
 * the step is valid. *swing: rotation of the path relative to its limit. last_resort: 1 if the step
 * cannot be shorter, so it may contain several critical points. */
static const char *continuation_step_defect(const continuation *, int last_resort, double *swing);
/* Reports a jump: the step that started at the control coordinate `from` led to another branch, but
 * the path leads to `here`. If the steps are constant, the path ends at `here`. */
static status continuation_report_jump(continuation *, const other_branch *, double from, fault *);

enum { MOST_POINTS = 20000, MANY_ITERATIONS = 9, HALVINGS = 14 };
/* Target rotation of the next step relative to its limit. */
static const double aim = 0.7;

typedef struct attempt {
    const char *reason; /* reason why the step may be invalid; NULL: the step is valid */
    double swing;
    step_record record;
} attempt;

static status add_point(continuation *p, fault *f)
{
    outcome_continuation *o = p->o;
    if (o->points == p->room) {
        const int room = p->room > 0 ? 2 * p->room : 64;
        double *factors = realloc(o->factor, (size_t)room * sizeof *factors);
        if (factors != NULL)
            o->factor = factors;
        double *controls = realloc(o->control, (size_t)room * sizeof *controls);
        if (controls != NULL)
            o->control = controls;
        model_state **states =
            p->keeps_states ? realloc(o->state, (size_t)room * sizeof(model_state *)) : NULL;
        if (states != NULL)
            o->state = states;
        if (factors == NULL || controls == NULL || (p->keeps_states && states == NULL))
            return fault_memory(f, "a path");
        p->room = room;
    }
    if (p->keeps_states) {
        TRY(kinematics_nodes_alloc(p->c->model, p->n.state, &o->state[o->points], f));
    }
    o->factor[o->points] = p->here.factor;
    o->control[o->points++] = p->here.control;
    return STATUS_OK;
}

/* Records if the critical points of the step from `before` to `here` are known, and the number of
 * eigenvalues that have passed zero. This number decides the stability only if K is unsymmetric and
 * all critical points so far are known. */
static void evaluate_step(continuation *p, const path_point *before, step_record *record)
{
    outcome_continuation *o = p->o;
    if ((p->here.negative < 0 || p->is_uncertain) && !o->undecided) {
        o->undecided = 1;
        o->decided_events = p->c->result->events;
        o->undecided_from = before->factor;
        o->undecided_to = p->here.factor;
    }
    record->passed = p->first;
    for (int i = 0; i < p->c->result->events; i++) {
        const path_event *e = &p->c->result->event[i];
        if (e->analysis == p->analysis && e->kind != EVENT_BRANCH_JUMP)
            record->passed += e->negative_after - e->negative_before;
    }
    record->by_eigenvalues = !p->here.symmetric && !o->undecided && p->first >= 0;
}

static status accept(continuation *p, step_record *record, fault *f)
{
    const path_point before = p->here;
    p->here = p->next;
    p->next = before;
    record->path = p->here.factor;
    record->increment = p->here.factor - before.factor;
    record->negative_pivots = p->here.symmetric ? p->here.negative : -1;
    evaluate_step(p, &before, record);
    if (!p->here.symmetric && scene_has_mass(p->c->scene))
        TRY(flutter_check_state(&p->flutter, p->c, p->n.state, record, f));
    p->c->run->counters.steps++;
    TRY(add_point(p, f));
    return history_add_step(p->c->result, record, f);
}

/* Reverses the tangent at the start of the path if the first step, which changes the control
 * coordinate, has moved against this tangent. */
static void turn_start(continuation *p)
{
    if (p->o->points > 1 || continuation_step_dot(p, p->here.tangent, p->moved) >= 0)
        return;
    p->here.rate = -p->here.rate;
    for (int k = 0; k < p->n.all; k++)
        p->here.tangent[k] = -p->here.tangent[k];
}

/* If the attempt is uncertain, the state may be on another branch. A step along the arc that would
 * pass the station ends at the station. */
static status try_step(continuation *p, path_goal goal, double station, int last_resort, attempt *t,
                       fault *f)
{
    kinematics_commit(p->c->model, p->n.state);
    kinematics_state_copy(p->c->model, p->n.state, p->n.backup);
    TRY(continuation_step_correct(p, goal, &t->record, f));
    TRY(continuation_step_end(p, &p->next, &t->record, f));
    if (goal.by_arc && (p->here.control < station) != (p->next.control < station)) {
        continuation_step_go_back(p);
        history_drop_step(p->c->result, &t->record);
        t->record = (step_record){.rejected = t->record.rejected};
        return try_step(p, (path_goal){0, station}, station, last_resort, t, f);
    }
    if (!goal.by_arc)
        p->next.control = goal.value;
    turn_start(p);
    t->reason = continuation_step_defect(p, last_resort, &t->swing);
    int jump = 0, hidden = 0;
    p->is_uncertain = 0;
    if (t->reason == NULL)
        TRY(continuation_critical_within(p, goal, &hidden, f));
    if (last_resort && hidden) {
        p->is_uncertain = 1;
        hidden = 0;
    }
    if (t->reason == NULL && !hidden)
        TRY(continuation_critical(p, goal, &jump, f));
    if (hidden)
        t->reason = "stability changes and changes back within the step";
    if (jump)
        t->reason = "the pivots of the tangent stiffness change without a critical point";
    return STATUS_OK;
}

static void reject(continuation *p, const attempt *t)
{
    continuation_step_go_back(p);
    history_drop_step(p->c->result, &t->record);
    p->c->run->counters.rejected_steps++;
}

static double next_size(const continuation *p, double size, double length, const attempt *t)
{
    const double wanted = length * fmin(2, fmax(0.5, aim / t->swing)) *
                          (t->record.iterations > MANY_ITERATIONS ? 0.5 : 1);
    return fmin(p->by->step_max, wanted < length ? wanted : fmax(size, wanted));
}

static double length_left(const continuation *p, path_goal goal, double travelled)
{
    return goal.by_arc ? goal.value - travelled : fabs(goal.value - p->here.control);
}

static int arrived(const continuation *p, path_goal goal, double station, const other_branch *r,
                   double travelled, double nearest)
{
    if (p->here.control == station)
        return 1;
    return length_left(p, goal, travelled) <= 0 &&
           (!goal.by_arc || r->state == NULL || nearest <= goal.value / 2 ||
            travelled >= 3 * goal.value);
}

/* Returns the goal of the next part of the step that leads from the control coordinate `from` to
 * the goal. */
static path_goal part_of(const continuation *p, path_goal goal, double from, double length,
                         int last)
{
    if (goal.by_arc)
        return (path_goal){goal.by_arc, length};
    if (last)
        return goal;
    const double way = goal.value > from ? 1 : -1;
    return (path_goal){0, from + way * (fabs(p->here.control - from) + length)};
}

static status retrace(continuation *p, path_goal goal, double station, const other_branch *r,
                      double *size, fault *f)
{
    const double from = p->here.control, smallest = ldexp(p->by->step, -HALVINGS);
    double travelled = 0, nearest = INFINITY;
    int rejected = 1;
    while (!arrived(p, goal, station, r, travelled, nearest)) {
        const double left = length_left(p, goal, travelled);
        const int last = left > 0 && *size * (1 + 1e-9) >= left;
        const double longest = goal.by_arc ? fmin(*size, goal.value / 2) : *size;
        const double length = last ? left : longest;
        const path_goal part = part_of(p, goal, from, length, last);
        attempt t = {.record = {.rejected = rejected}};
        fault why = {""};
        const status outcome = try_step(p, part, station, length <= smallest, &t, &why);
        if (outcome == STATUS_FAULT)
            return fault_set(f, outcome, "%s", why.text);
        if (outcome != STATUS_OK || t.reason != NULL) {
            reject(p, &t);
            rejected++;
            if (length <= smallest)
                return fault_set(
                    f, STATUS_NOT_CONVERGED,
                    "the path cannot be followed beyond the value %g m of the control coordinate, "
                    "at load factor %g: %s",
                    p->here.control, p->here.factor, t.reason != NULL ? t.reason : why.text);
            *size = length / 2;
            continue;
        }
        rejected = 0;
        travelled += length;
        TRY(accept(p, &t.record, f));
        *size = next_size(p, *size, length, &t);
        const double distance =
            r->state == NULL ? 0 : metric_distance(p->c->model, p->n.state, r->state, NULL);
        nearest = goal.by_arc ? fmin(nearest, distance) : distance;
    }
    const double same = goal.by_arc ? goal.value / 2 : 1e-5;
    return r->state != NULL && nearest > same ? continuation_report_jump(p, r, from, f) : STATUS_OK;
}

static status other_branch_alloc(const continuation *p, other_branch *r, fault *f)
{
    TRY(kinematics_state_alloc(p->c->model, &r->state, f));
    r->factor = kinematics_state_path(p->n.state);
    kinematics_state_copy(p->c->model, p->n.state, r->state);
    return STATUS_OK;
}

static status try_again(continuation *p, path_goal goal, double station, const attempt *t,
                        int is_uncertain, other_branch *r, double *size, fault *f)
{
    const status kept = is_uncertain ? other_branch_alloc(p, r, f) : STATUS_OK;
    reject(p, t);
    TRY(kept);
    return retrace(p, goal, station, r, size, f);
}

static status reach(continuation *p, path_goal goal, double station, double *size, fault *f)
{
    attempt t = {0};
    other_branch r = {NULL, 0};
    const double length = length_left(p, goal, 0);
    const status tried = try_step(p, goal, station, 0, &t, f);
    if (tried == STATUS_OK && t.reason == NULL) {
        *size = next_size(p, *size, length, &t);
        return accept(p, &t.record, f);
    }
    if (tried == STATUS_FAULT)
        return tried;
    *size = length / 2;
    const status outcome = try_again(p, goal, station, &t, tried == STATUS_OK, &r, size, f);
    kinematics_state_free(r.state);
    return outcome;
}

static path_goal next_goal(const continuation *p, double station, double length)
{
    const double left = station - p->here.control;
    if (p->by->by_arc)
        return (path_goal){p->by->by_arc, length};
    if (length * (1 + 1e-9) >= fabs(left))
        return (path_goal){0, station};
    return (path_goal){0, p->here.control + copysign(length, left)};
}

static status walk_to(continuation *p, double station, double *size, fault *f)
{
    while (p->here.control != station) {
        if (p->o->points >= MOST_POINTS)
            return fault_set(
                f, STATUS_NOT_CONVERGED,
                "the path has %d points, but none of them is at %g m; use larger steps",
                MOST_POINTS, station);
        const double length = p->by->constant_steps ? p->by->step : *size;
        TRY(reach(p, next_goal(p, station, length), station, size, f));
    }
    return STATUS_OK;
}

static status start(continuation *p, fault *f)
{
    step_record record = {0};
    TRY(newton_to(&p->n, 0, &record, f));
    TRY(continuation_step_look(p, NULL, &p->here, &record, f));
    p->n.constrained = 1;
    p->first = p->here.negative;
    return add_point(p, f);
}

static status walk(analysis_context *c, int analysis, outcome_continuation *o, continuation *p,
                   fault *f)
{
    TRY(continuation_step_alloc(c, analysis, o, p, f));
    double size = p->by->step;
    TRY(start(p, f));
    for (int i = 0; i < p->path->stations; i++) {
        TRY(walk_to(p, p->path->value[i], &size, f));
        TRY(outcome_keep(&p->o->path, p->c->model, p->n.state, extract_path_whole(c, analysis, i),
                         p->path->value[i], f));
    }
    return STATUS_OK;
}

status continuation_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    continuation p;
    const status result = walk(c, analysis, &o->left.continuation, &p, f);
    continuation_step_free(&p);
    return result;
}

/* Limit of the angle [rad] between the tangent and the secant in the metric, which is the relative
 * error of the tangent over a step. This limit controls the step size. */
static const double largest_swing = 0.3;
/* Largest rotation [rad] of a node in one step, for paths on which few nodes rotate. Steps with a
 * tenth of both limits lead to the same states and events in all runs of `verify`. */
static const double largest_turn = 0.5;

static double angle_to_secant(const continuation *p, const double tangent[], double length)
{
    return acos(fmin(1, fmax(-1, continuation_step_dot(p, tangent, p->moved) / length)));
}

static const char *continuation_step_defect(const continuation *p, int last_resort, double *swing)
{
    const path_point *a = &p->here, *b = &p->next;
    const double length = sqrt(continuation_step_dot(p, p->moved, p->moved));
    const double before = angle_to_secant(p, a->tangent, length),
                 after = angle_to_secant(p, b->tangent, length);
    const double turned = metric_turn_between(p->c->model, p->n.backup, p->n.state);
    *swing = fmax(fmax(before, after) / largest_swing, turned / largest_turn);
    if (!(before <= largest_swing) || !(after <= largest_swing))
        return "the direction of the path changes too much";
    if (!(turned <= largest_turn))
        return "a node rotates too far";
    /* At a limit point, the rate changes its sign, and one pivot changes the sign of the
     * determinant. At a bifurcation, only the determinant changes its sign. Several bifurcations
     * may coincide. */
    const int reversed = (a->rate < 0) != (b->rate < 0), pivots = abs(b->negative - a->negative);
    if (!last_resort && reversed && (pivots > 1 || a->determinant == b->determinant))
        return "the pivots of the tangent stiffness change by more than one critical point "
               "explains";
    return NULL;
}

static status continuation_report_jump(continuation *p, const other_branch *r, double from,
                                       fault *f)
{
    const path_event event = {.kind = EVENT_BRANCH_JUMP,
                              .analysis = p->analysis,
                              .negative_before = p->here.negative,
                              .negative_after = p->here.negative,
                              .factor = p->here.factor,
                              .control = p->here.control,
                              .other_factor = r->factor,
                              .measure = metric_distance(p->c->model, p->n.state, r->state, NULL)};
    TRY(history_add_event(p->c->result, &event, f));
    if (p->by->constant_steps)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "the step from %g to %g m jumps to another branch (load factor %g instead "
                         "of %g); use smaller steps",
                         from, p->here.control, r->factor, p->here.factor);
    return STATUS_OK;
}
