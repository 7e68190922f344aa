/* Critical points inside a step: where the tangent stiffness is singular, and what its null vector
 * phi says.
 *
 * Along a path K x' = f' l', so at a critical point 0 = phi . K x' = (phi . f') l': either the load
 * has an extremum (limit point) or its work on phi is zero (bifurcation). K need not be symmetric:
 * phi is its left null vector. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/analysis/continuation_impl.h"
#include "harness/model/kinematics.h"
#include "harness/solver/history.h"

enum { MOST_TRIALS = 60, INVERSE_ITERATIONS = 12 };
static const double least_load_work = 1e-5; /* of a null vector that is not across the load */
static const double closeness = 1e-10;      /* of a trial, relative to the step */
static const double near = 1e-3;            /* of a vanishing eigenvalue, beside those before */
static const double one_point = 1e-6;       /* nearer ones are one, relative to the step */

/* One end of the interval in which the critical point lies. */
typedef struct bound {
    double at, value; /* part of the step; test function, NAN: unknown */
} bound;

/* mode: left eigenvector of K with the eigenvalue of least size, which is returned; K is factored
 * in the present state. */
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
    model_counters(p->c->model)->solutions += INVERSE_ITERATIONS;
    return eigenvalue;
}

/* |phi . f'|/(|phi| |f'|), the lengths in the metric and in its dual. */
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

/* What is looked for: the first point behind `from` where something changes. */
typedef struct sought {
    int by_rate;
    double from;  /* part of the step */
    int negative; /* pivots there */
} sought;

/* Is what changes at the critical point still as it is at its beginning? */
static int is_before(const continuation *p, const sought *s)
{
    if (s->by_rate)
        return (p->trial.rate < 0) == (p->here.rate < 0);
    if (p->here.negative < 0 || p->trial.negative < 0)
        return p->trial.determinant == p->here.determinant;
    return p->trial.negative == s->negative;
}

/* The point at that part of the step; *before: 1 when it lies before the critical one. */
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
    b->value = s->by_rate ? p->trial.rate : least_eigenvalue(p);
    /* Another eigenvalue may be the least one: its sign tells nothing of this point. */
    const int falls =
        p->here.negative < 0 ? p->here.determinant > 0 : p->next.negative > s->negative;
    if (!s->by_rate && (b->value > 0) != (*before == falls))
        b->value = NAN;
    return STATUS_OK;
}

/* Secant with Illinois' weights where both values are known, else the middle. */
static double next_part(const bound *low, const bound *high)
{
    const double width = high->at - low->at;
    const double secant = low->at + width * low->value / (low->value - high->value);
    return isfinite(secant) && secant > low->at && secant < high->at ? secant : low->at + width / 2;
}

/* Narrows the interval; the state is then the critical point as near as it can be told. *gone: the
 * test function has no zero; *behind: part of the step at which the point was passed. */
static status locate(continuation *p, path_goal goal, const sought *s, int *gone, double *behind,
                     fault *f)
{
    const int by_rate = s->by_rate;
    bound low = {s->from, by_rate ? p->here.rate : NAN}, high = {1, by_rate ? p->next.rate : NAN};
    double at = s->from, scale = by_rate ? fmax(fabs(low.value), fabs(high.value)) : 0,
           value = scale;
    int last = 0;
    for (int i = 0; i < MOST_TRIALS && high.at - low.at > closeness; i++) {
        bound trial = {i % 8 == 7 ? (low.at + high.at) / 2 : next_part(&low, &high), NAN};
        int before = 0;
        const status outcome = try_at(p, goal, s, &trial, &before, f);
        at = trial.at;
        const int at_it = i > 0 && value <= near * scale; /* where corrections are noise */
        if (outcome == STATUS_SINGULAR || (outcome == STATUS_NOT_CONVERGED && at_it))
            break;
        TRY(outcome);
        value = fabs(trial.value);
        scale = fmax(scale, isfinite(value) ? value : 0);
        if (value <= closeness * scale)
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
    *gone = value > near * scale;
    *behind = fmax(high.at < 1 ? high.at : at, at);
    return STATUS_OK;
}

/* The pivots behind the point, where all eigenvalues that vanish at it have passed zero; *at: part
 * of the step there. */
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

/* The critical point inside the step becomes an event. *s goes on behind it. */
static status report_critical(continuation *p, path_goal goal, sought *s, int *jump, fault *f)
{
    double behind = 1;
    TRY(locate(p, goal, s, jump, &behind, f));
    if (*jump)
        return STATUS_OK;
    path_event event = {
        .kind = s->by_rate ? EVENT_LIMIT_POINT : EVENT_BIFURCATION,
        .analysis = p->analysis,
        .negative_before = s->negative,
        .factor = kinematics_state_path(p->n.state),
        .control = kinematics_component(p->c->model, p->n.state, p->by->node, p->by->component),
        .other_factor = NAN};
    least_eigenvalue(p);
    event.measure = load_work(p);
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

/* All of them, in their order. */
static status report_all(continuation *p, path_goal goal, int by_rate, int *jump, fault *f)
{
    sought s = {by_rate, 0, p->here.negative};
    do
        TRY(report_critical(p, goal, &s, jump, f));
    while (!*jump && s.from < 1 && s.negative != p->next.negative);
    return STATUS_OK;
}

/* Is the part of the step another than its ends: in pivots, or in where the load goes? */
static status look_at(continuation *p, path_goal goal, double part, int *differs, double *least,
                      fault *f)
{
    const sought s = {0, 0, p->here.negative};
    bound trial = {part, NAN};
    int before = 0;
    TRY(try_at(p, goal, &s, &trial, &before, f));
    *differs = !before || (p->trial.rate < 0) != (p->here.rate < 0);
    *least = least_eigenvalue(p);
    return STATUS_OK;
}

/* The middle, and the rest where a parabola through the least eigenvalues is not clear of zero. */
static status look_within(continuation *p, path_goal goal, int *hidden, fault *f)
{
    static const double part[] = {0.2, 0.4, 0.6, 0.8};
    const double clear = 0.5; /* of the least one: what it may change by from the ends */
    const double a = p->here.least, b = p->next.least;
    double middle;
    TRY(look_at(p, goal, 0.5, hidden, &middle, f));
    const double least = fmin(fmin(fabs(a), fabs(b)), fabs(middle));
    if (fabs(middle - a) < clear * least && fabs(middle - b) < clear * least)
        return STATUS_OK;
    for (int i = 0; i < 4 && !*hidden; i++)
        TRY(look_at(p, goal, part[i], hidden, &middle, f));
    return STATUS_OK;
}

status continuation_critical_within(continuation *p, path_goal goal, int *hidden, fault *f)
{
    *hidden = 0;
    if (!p->asks_critical)
        return STATUS_OK;
    p->next.least = least_eigenvalue(p);
    kinematics_state_copy(p->c->model, p->n.state, p->end);
    const status outcome = look_within(p, goal, hidden, f);
    kinematics_state_copy(p->c->model, p->end, p->n.state);
    p->looked = 0;
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
