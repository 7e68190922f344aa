/* Critical points within a step: points with a singular tangent stiffness. The null vector phi of
 * the stiffness gives the kind of the point. Along a path K x' = f' l', so at a critical point 0 =
 * phi . K x' = (phi . f') l'. Either the load has an extremum (limit point), or the work of f' on
 * phi is zero (bifurcation). K need not be symmetric, and phi is its left null vector. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

enum { MOST_TRIALS = 60, INVERSE_ITERATIONS = 12, PARTS = 6, CORRECTIONS = 2 };
static const double least_load_work = 1e-5; /* smallest |phi . f'|/(|phi| |f'|) at a limit point */
/* width of the interval, relative to the step, and eigenvalue or rate, relative to its largest
 * value, at which the search ends */
static const double closeness = 1e-10;
/* eigenvalue that counts as zero, relative to its earlier values */
static const double near = 1e-3;
static const double one_point =
    1e-6; /* distance, relative to the step, below which two points count as one point */
static const double touches =
    0.02; /* smallest value of an indicator that counts as zero, relative to its neighbours */
static const double aside =
    1e-3; /* largest relative real part of a pair that crosses the imaginary axis near zero */

typedef struct bound {
    double at, value; /* fraction of the step, and value of the test function (NAN: unknown) */
} bound;

/* Returns the eigenvalue of K nearest to zero, and sets p->mode to its left eigenvector. K must be
 * factored in the current state. */
static double least_eigenvalue(continuation *p)
{
    double *x = p->mode, eigenvalue = NAN;
    unsigned seed = 12345;
    for (int k = 0; k < p->n.free; k++) {
        seed = seed * 1103515245u + 12345u;
        x[k] = 0.5 + (double)(seed >> 8 & 0xffff) / 65536;
    }
    for (int i = 0; i < INVERSE_ITERATIONS; i++) {
        double square = 0, product = 0;
        for (int k = 0; k < p->n.free; k++)
            square += x[k] * x[k];
        const double length = sqrt(square);
        for (int k = 0; k < p->n.free; k++)
            x[k] = p->moved[k] = x[k] / length;
        factor_solve_transposed(p->n.factor, x);
        for (int k = 0; k < p->n.free; k++)
            product += x[k] * p->moved[k];
        eigenvalue = 1 / product;
    }
    return eigenvalue;
}

/* Returns the eigenvalue of K nearest to zero at the point where K is factored, or its real part if
 * K is not symmetric. */
static double least_of(continuation *p, const path_point *at)
{
    return at->symmetric ? least_eigenvalue(p) : at->least;
}

static int is_aside(const path_point *at)
{
    return !at->symmetric && at->nearest > 0 && fabs(creal(at->mu[0])) < aside * cabs(at->mu[0]);
}

static double load_work(continuation *p)
{
    const double *load = p->load;
    double product = 0, square = 0;
    for (int k = 0; k < p->n.free; k++) {
        product += p->mode[k] * load[k];
        square += load[k] != 0 && p->weight[k] > 0 ? load[k] * load[k] / p->weight[k] : 0;
    }
    return fabs(product) / sqrt(square * continuation_step_dot(p, p->mode, p->mode));
}

static path_goal part_of(const continuation *p, path_goal goal, double part)
{
    const double from = goal.by_arc ? 0 : p->here.control;
    return (path_goal){goal.by_arc, from + part * (goal.value - from)};
}

/* Target of the search: the first point after `from` at which the indicator changes: the sign of
 * the rate (by_rate 1), or the number of negative pivots. */
typedef struct sought {
    int by_rate;
    double from;  /* fraction of the step */
    int negative; /* number of negative pivots at `from` */
} sought;

static int is_before(const continuation *p, const sought *s)
{
    if (s->by_rate)
        return (p->trial.rate < 0) == (p->here.rate < 0);
    if (p->here.negative < 0 || p->trial.negative < 0)
        return p->trial.determinant == p->here.determinant;
    return p->trial.negative == s->negative;
}

/* State away from the critical point, from which the slope of the eigenvalue follows. */
typedef struct apart {
    double eigenvalue, factor, control; /* eigenvalue NAN: none */
} apart;

static double control_of(const continuation *p)
{
    return kinematics_component(p->c->model, p->n.state, p->by->node, p->by->component);
}

static void keep_apart(continuation *p, int by_rate, double eigenvalue, apart *a)
{
    if (by_rate && isnan(a->eigenvalue) && p->trial.symmetric)
        eigenvalue = least_eigenvalue(p);
    if (isfinite(eigenvalue) && !(fabs(eigenvalue) <= fabs(a->eigenvalue)))
        *a = (apart){eigenvalue, kinematics_state_path(p->n.state), control_of(p)};
}

/* Evaluates the point at the fraction b->at of the step. *before: 1 if this point lies before the
 * critical point. */
static status try_at(continuation *p, path_goal goal, const sought *s, bound *b, int *before,
                     fault *f)
{
    step_record record = {0};
    continuation_step_go_back(p);
    const status corrected = continuation_step_correct(p, part_of(p, goal, b->at), &record, f);
    history_drop_step(p->c->result, &record);
    TRY(corrected);
    TRY(continuation_step_look(p, p->moved, &p->trial, &record, f));
    *before = is_before(p, s);
    b->value = s->by_rate ? p->trial.rate : least_of(p, &p->trial);
    const int falls =
        p->here.negative < 0 ? p->here.determinant > 0 : p->next.negative > s->negative;
    if (!s->by_rate && (b->value > 0) != (*before == falls))
        b->value = NAN;
    return STATUS_OK;
}

static double next_part(const bound *low, const bound *high)
{
    const double width = high->at - low->at;
    const double secant = low->at + width * low->value / (low->value - high->value);
    return isfinite(secant) && secant > low->at && secant < high->at ? secant : low->at + width / 2;
}

/* Narrows the interval. The final state is the critical point, apart from rounding. *is_absent: 1
 * if the test function has no zero. *behind: fraction of the step immediately after the point.
 * *away: a state before or after the point. */
static status locate(continuation *p, path_goal goal, const sought *s, int *is_absent,
                     double *behind, apart *away, fault *f)
{
    const int by_rate = s->by_rate;
    bound low = {s->from, by_rate ? p->here.rate : NAN}, high = {1, by_rate ? p->next.rate : NAN};
    double at = s->from, scale = by_rate ? fmax(fabs(low.value), fabs(high.value)) : 0,
           value = scale, best = by_rate ? scale : NAN;
    int last = 0;
    for (int i = 0; i < MOST_TRIALS && high.at - low.at > closeness; i++) {
        bound trial = {i % 8 == 7 ? (low.at + high.at) / 2 : next_part(&low, &high), NAN};
        int before = 0;
        const status outcome = try_at(p, goal, s, &trial, &before, f);
        at = trial.at;
        const int at_it =
            i > 0 && value <= near * scale; /* here, corrections are rounding errors */
        if (outcome == STATUS_SINGULAR || (outcome == STATUS_NOT_CONVERGED && at_it))
            break;
        TRY(outcome);
        keep_apart(p, by_rate, by_rate ? NAN : trial.value, away);
        const int whole = by_rate || p->trial.symmetric || p->trial.nearest == 0;
        value = whole ? fabs(trial.value) : cabs(p->trial.mu[0]);
        scale = fmax(scale, isfinite(value) ? value : 0);
        best = p->trial.lost ? 0 : fmin(best, value);
        if (value <= closeness * scale || (!by_rate && is_aside(&p->trial)))
            break;
        if (i > 0 && before == last) {
            if (before)
                high.value /= 2;
            else
                low.value /= 2;
        }
        last = before;
        *(before ? &low : &high) = trial;
    }
    *is_absent = best > near * scale;
    p->narrow = is_aside(&p->trial) || high.at - low.at <= closeness;
    if (!by_rate && !*is_absent && is_aside(&p->trial) && value > one_point * scale)
        p->is_uncertain = 1; /* a pair near zero, or a double eigenvalue at zero */
    *behind = fmax(high.at < 1 ? high.at : at, at);
    return STATUS_OK;
}

/* Counts the negative pivots after the point, where all eigenvalues that vanish at the point have
 * passed zero. *at: fraction of the step at which the pivots are counted. */
static status count_behind(continuation *p, path_goal goal, const sought *s, double *at,
                           int *negative, fault *f)
{
    *at += one_point;
    *negative = p->next.negative;
    if (*at >= 1)
        return STATUS_OK;
    int before = 0;
    bound trial = {*at, NAN};
    TRY(try_at(p, goal, s, &trial, &before, f));
    *negative = p->trial.negative;
    return STATUS_OK;
}

/* Returns 1 if the count changes although no eigenvalue passes zero. A pair then crosses the
 * imaginary axis away from zero, and no branch starts. */
static int is_pair(const continuation *p, const sought *s)
{
    return !s->by_rate && !p->next.symmetric && p->narrow && s->negative >= 0 &&
           p->next.negative >= 0;
}

/* Returns 1 if a node is fixed about some axes and free about others. */
static int holds_some_turns(const model *m)
{
    const scene *s = model_scene(m);
    for (int i = 0; i < s->nodes; i++) {
        int free = 0;
        for (int k = 0; k < 3; k++)
            free += s->node[i].angle[k] == SCENE_FREE;
        if (free == 1 || free == 2)
            return 1;
    }
    return 0;
}

static status pass_pair(continuation *p, path_goal goal, sought *s, double behind, int *jump,
                        fault *f)
{
    const int before = s->negative;
    s->from = behind;
    TRY(count_behind(p, goal, s, &s->from, &s->negative, f));
    *jump = s->negative == before || (s->negative - before) % 2 != 0;
    return STATUS_OK;
}

/* Estimates the rounding errors of a critical point: the tangent is singular where its eigenvalue
 * is within rounding of zero. The slope of the eigenvalue is known from the state *away. At a limit
 * point, the error of the load factor is of second order. */
static void estimate_rounding(continuation *p, const apart *away, path_event *e)
{
    double square = 0;
    if (isnan(away->eigenvalue))
        return;
    for (int k = 0; k < p->n.free; k++)
        square += p->mode[k] * p->mode[k];
    memset(p->mode + p->n.free, 0, (size_t)(p->n.all - p->n.free) * sizeof *p->mode);
    const double error = stiffness_parts_assembled_rounding(p->c->model, &p->c->run->memory,
                                                            p->n.state, p->mode) /
                         square,
                 part = error / fabs(away->eigenvalue);
    e->control_error = part * fabs(away->control - e->control);
    e->factor_error =
        (e->kind == EVENT_LIMIT_POINT ? part * part : part) * fabs(away->factor - e->factor);
}

static status report_critical(continuation *p, path_goal goal, sought *s, int *jump, fault *f)
{
    double behind = 1;
    apart away = {.eigenvalue = NAN};
    TRY(locate(p, goal, s, jump, &behind, &away, f));
    if (*jump && is_pair(p, s) && !holds_some_turns(p->c->model))
        return pass_pair(p, goal, s, behind, jump, f);
    if (*jump)
        return STATUS_OK;
    path_event event = {.kind = s->by_rate ? EVENT_LIMIT_POINT : EVENT_BIFURCATION,
                        .analysis = p->analysis,
                        .negative_before = s->negative,
                        .factor = kinematics_state_path(p->n.state),
                        .control = control_of(p),
                        .other_factor = NAN};
    least_eigenvalue(p);
    event.measure = load_work(p);
    estimate_rounding(p, &away, &event);
    *jump = !s->by_rate && event.measure > least_load_work;
    if (*jump)
        return STATUS_OK;
    s->from = 1;
    if (s->by_rate || s->negative < 0 || abs(p->next.negative - s->negative) == 1)
        s->negative = p->next.negative;
    else {
        s->from = behind;
        TRY(count_behind(p, goal, s, &s->from, &s->negative, f));
    }
    event.negative_after = s->negative;
    *jump =
        !s->by_rate && event.negative_before >= 0 && event.negative_after == event.negative_before;
    return *jump ? STATUS_OK : history_add_event(p->c->result, &event, f);
}

static status report_all(continuation *p, path_goal goal, int by_rate, int *jump, fault *f)
{
    sought s = {by_rate, 0, p->here.negative};
    do
        TRY(report_critical(p, goal, &s, jump, f));
    while (!*jump && s.from < 1 && s.negative != p->next.negative);
    return STATUS_OK;
}

/* Computes the trial point at a fraction of the step. first 1: starts from `here`; 0: starts from
 * the previous trial point. */
static status look_at(continuation *p, path_goal goal, double part, int first, fault *f)
{
    const path_goal to = part_of(p, goal, part);
    if (first)
        continuation_step_go_back(p);
    for (int i = 0; i < CORRECTIONS; i++) {
        step_record record = {0};
        const status corrected = first && i == 0 ? continuation_step_correct(p, to, &record, f)
                                                 : continuation_step_go_on(p, to, &record, f);
        history_drop_step(p->c->result, &record);
        TRY(corrected);
    }
    step_record unused = {0};
    TRY(continuation_step_look(p, p->moved, &p->trial, &unused, f));
    return continuation_step_check(&p->trial, f);
}

/* Returns 1 if a parabola through three equidistant values of the same sign reaches or almost
 * reaches zero between them. */
static int dips(const double value[3])
{
    const double sign = value[1] > 0 ? 1 : -1, bend = value[0] - 2 * value[1] + value[2],
                 slope = (value[2] - value[0]) / 2;
    const int same = (value[0] > 0) == (value[1] > 0) && (value[1] > 0) == (value[2] > 0);
    return same && sign * bend > 0 && fabs(slope) < fabs(bend) &&
           sign * (value[1] - slope * slope / (2 * bend)) <
               touches * fmax(fabs(value[0]), fabs(value[2]));
}

/* Returns 1 if an indicator of a critical point changes between a and b and changes back in the
 * step, which ends at c. */
static int turns_back(const path_point *a, const path_point *b, const path_point *c)
{
    const int of_rate = (a->rate < 0) == (c->rate < 0) && (b->rate < 0) != (c->rate < 0);
    if (a->negative < 0 || b->negative < 0 || c->negative < 0)
        return of_rate || (a->determinant == c->determinant && b->determinant != c->determinant);
    return of_rate || b->negative < (a->negative < c->negative ? a : c)->negative ||
           b->negative > (a->negative > c->negative ? a : c)->negative;
}

static status look_within(continuation *p, path_goal goal, int *hidden, fault *f)
{
    double value[PARTS + 1] = {p->here.least, [PARTS] = p->next.least};
    path_point last = p->here;
    for (int i = 1; i < PARTS && !*hidden; i++) {
        TRY(look_at(p, goal, (double)i / PARTS, i == 1, f));
        value[i] = p->trial.least;
        *hidden = turns_back(&last, &p->trial, &p->next);
        last = p->trial;
    }
    for (int i = 0; i + 2 <= PARTS && !*hidden && !p->next.symmetric; i++)
        *hidden = dips(value + i);
    return STATUS_OK;
}

status continuation_critical_within(continuation *p, path_goal goal, int *hidden, fault *f)
{
    *hidden = 0;
    if (!p->needs_critical)
        return STATUS_OK;
    const newton_convergence before = p->n.newton_convergence;
    kinematics_state_copy(p->c->model, p->n.state, p->end);
    p->n.newton_convergence.criterion =
        INFINITY; /* Newton's method then makes one correction at a time */
    const status outcome = look_within(p, goal, hidden, f);
    p->n.newton_convergence = before;
    kinematics_state_copy(p->c->model, p->end, p->n.state);
    p->looked = 0;
    *hidden |= outcome == STATUS_SINGULAR;
    return outcome == STATUS_SINGULAR ? STATUS_OK : outcome;
}

status continuation_critical(continuation *p, path_goal goal, int *jump, fault *f)
{
    const int by_rate = (p->here.rate < 0) != (p->next.rate < 0), events = p->c->result->events;
    *jump = 0;
    if (!by_rate && p->here.negative == p->next.negative &&
        (p->here.negative >= 0 || p->here.determinant == p->next.determinant))
        return STATUS_OK;
    kinematics_state_copy(p->c->model, p->n.state, p->end);
    const status outcome = report_all(p, goal, by_rate, jump, f);
    if (*jump || outcome != STATUS_OK)
        p->c->result->events = events;
    kinematics_state_copy(p->c->model, p->end, p->n.state);
    p->looked = 0;
    return outcome;
}
