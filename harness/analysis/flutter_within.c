#include "harness/analysis/flutter_within.h"

#include <math.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { PARTS = 6 };
static const double near_enough = 1e-5; /* correction that ends at a state that is looked at only */

/* How unstable the present state is: negative eigenvalues, or 1 where a motion grows; -1: not
 * known. */
static status look(flutter_judge *j, int *unstable, fault *f)
{
    step_record record = {0};
    TRY(flutter_judge_here(j, &record, f));
    *unstable = record.negative_pivots;
    if (record.by_eigenvalues)
        *unstable = record.passed;
    else if (record.judged != STEP_OPEN)
        *unstable = record.judged != STEP_STABLE;
    return STATUS_OK;
}

/* *reached 0: Newton does not converge. */
static status go_to(newton_run *n, double path, int *reached, fault *f)
{
    step_record record = {0};
    fault why = {""};
    kinematics_state_copy(n->c->model, n->state, n->backup);
    const status outcome = newton_to(n, path, &record, &why);
    history_drop_step(n->c->result, &record);
    *reached = outcome == STATUS_OK;
    return outcome == STATUS_FAULT ? fault_set(f, outcome, "%s", why.text) : STATUS_OK;
}

static status look_at_parts(flutter_judge *j, const model_state *from, const model_state *to,
                            double *found, fault *f)
{
    const model *m = j->n.c->model;
    const double begin = kinematics_state_path(from), end = kinematics_state_path(to);
    int first = -1, last = -1, here = -1, reached = 1;
    kinematics_state_copy(m, to, j->n.state);
    TRY(look(j, &last, f));
    kinematics_state_copy(m, from, j->n.state);
    TRY(look(j, &first, f));
    for (int i = 1; i < PARTS && first >= 0 && last >= 0; i++) {
        const double path = begin + (end - begin) * i / PARTS;
        TRY(go_to(&j->n, path, &reached, f));
        if (!reached)
            return STATUS_OK;
        TRY(look(j, &here, f));
        if (here < 0 || (here >= fmin(first, last) && here <= fmax(first, last)))
            continue;
        *found = path;
        return STATUS_OK;
    }
    return STATUS_OK;
}

status within_step(flutter_judge *j, analysis_context *c, const model_state *from,
                   const model_state *to, double *found, fault *f)
{
    const counters work = c->run->counters;
    const int singular = c->work->singular;
    *found = INFINITY;
    TRY(flutter_judge_begin(j, c, f));
    j->n.arrival.criterion = fmax(near_enough, c->options->criterion);
    const status outcome = look_at_parts(j, from, to, found, f);
    c->work->singular = singular;
    c->run->counters = work;
    return outcome;
}
