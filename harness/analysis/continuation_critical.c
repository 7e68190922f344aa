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

/* Is what changes at the critical point still as it is at `here`? */
static int is_before(const continuation *p, int by_rate)
{
    if (by_rate)
        return (p->trial.rate < 0) == (p->here.rate < 0);
    if (p->here.negative < 0)
        return p->trial.determinant == p->here.determinant;
    return p->trial.negative == p->here.negative;
}

/* The point at that part of the step; *before: 1 when it lies before the critical one. */
static status try_at(continuation *p, path_goal goal, int by_rate, bound *b, int *before, fault *f)
{
    step_record record = {0};
    continuation_step_go_back(p);
    const status corrected = continuation_step_correct(p, part_of(p, goal, b->at), &record, f);
    history_drop_step(p->c->result, &record);
    TRY(corrected);
    TRY(continuation_step_look(p, p->moved, &p->trial, &record, f));
    *before = is_before(p, by_rate);
    b->value = by_rate ? p->trial.rate : least_eigenvalue(p);
    /* Another eigenvalue may be the least one: its sign tells nothing of this point. */
    const int falls =
        p->here.negative < 0 ? p->here.determinant > 0 : p->next.negative > p->here.negative;
    if (!by_rate && (b->value > 0) != (*before == falls))
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
 * test function has no zero. */
static status locate(continuation *p, path_goal goal, int by_rate, int *gone, fault *f)
{
    bound low = {0, by_rate ? p->here.rate : NAN}, high = {1, by_rate ? p->next.rate : NAN};
    double scale = by_rate ? fmax(fabs(low.value), fabs(high.value)) : 0, value = scale;
    int last = 0;
    for (int i = 0; i < MOST_TRIALS && high.at - low.at > closeness; i++) {
        bound trial = {i % 8 == 7 ? (low.at + high.at) / 2 : next_part(&low, &high), NAN};
        int before = 0;
        const status outcome = try_at(p, goal, by_rate, &trial, &before, f);
        if (outcome == STATUS_SINGULAR)
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
    *gone = value > 1e-3 * scale;
    return STATUS_OK;
}

/* The critical point inside the step becomes an event. */
static status report_critical(continuation *p, path_goal goal, int by_rate, int *jump, fault *f)
{
    TRY(locate(p, goal, by_rate, jump, f));
    if (*jump)
        return STATUS_OK;
    path_event event = {
        .kind = by_rate ? EVENT_LIMIT_POINT : EVENT_BIFURCATION,
        .analysis = p->analysis,
        .negative_before = p->here.negative,
        .negative_after = p->next.negative,
        .factor = kinematics_state_path(p->n.state),
        .control = kinematics_component(p->c->model, p->n.state, p->by->node, p->by->component),
        .other_factor = NAN};
    least_eigenvalue(p);
    event.measure = load_work(p);
    *jump = !by_rate && event.measure > least_load_work;
    return *jump ? STATUS_OK : history_add_event(p->c->result, &event, f);
}

status continuation_critical(continuation *p, path_goal goal, int *jump, fault *f)
{
    const int by_rate = (p->here.rate < 0) != (p->next.rate < 0);
    *jump = 0;
    if (!by_rate && p->here.negative == p->next.negative &&
        p->here.determinant == p->next.determinant)
        return STATUS_OK;
    kinematics_state_copy(p->c->model, p->n.state, p->end);
    const status outcome = report_critical(p, goal, by_rate, jump, f);
    kinematics_state_copy(p->c->model, p->end, p->n.state);
    p->looked = 0;
    return outcome;
}
