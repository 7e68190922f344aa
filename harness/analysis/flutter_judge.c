#include "harness/analysis/flutter_judge.h"

#include <math.h>
#include <string.h>

#include "harness/analysis/flutter_left.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { MOTIONS = 8 };                  /* least ones that are looked at */
static const double most_error = 1e-2; /* beyond it nothing is known of a motion */
static const double real_part = 1e-6;  /* beside which an imaginary one is rounding */

status flutter_judge_begin(flutter_judge *j, analysis_context *c, fault *f)
{
    if (j->begun)
        return STATUS_OK;
    j->begun = 1;
    return newton_alloc(c, 0, &j->n, f);
}

/* An odd number of negative eigenvalues of K is a divergence, wherever they are. */
static step_stability by_motions(const flutter_judge *j, const unsymmetric_result *r)
{
    int mode = 0;
    if (factor_count(j->n.factor).determinant < 0)
        return STEP_GROWS;
    for (int i = 0; i < r->count; i++)
        if (!(r->error[i] <= most_error))
            return STEP_OPEN;
    if (r->count == 0)
        return STEP_OPEN;
    return flutter_of(&j->of, r, &mode) == FLUTTER_NONE ? STEP_STABLE : STEP_GROWS;
}

static status ask_motions(flutter_judge *j, step_record *record, fault *f)
{
    unsymmetric_result r = {0};
    fault why = {""};
    const status outcome = flutter_motions(&j->n, &j->of, MOTIONS, 1, &r, &why);
    if (outcome == STATUS_OK)
        record->judged = by_motions(j, &r);
    unsymmetric_free(&r);
    return outcome == STATUS_FAULT ? fault_set(f, outcome, "%s", why.text) : STATUS_OK;
}

/* Two of them are known to have passed zero where they are real: a pair may have passed beside. */
static status count_passed(flutter_judge *j, step_record *record, fault *f)
{
    left_of_axis left;
    int pairs = 0;
    TRY(left_count(j->n.factor, j->n.free, j->n.weight, &left, f));
    j->n.c->run->counters.solutions += left.solutions;
    for (int i = 0; i < left.nearest; i++)
        pairs += creal(left.mu[i]) < 0 && fabs(cimag(left.mu[i])) > real_part * cabs(left.mu[i]);
    record->by_eigenvalues = left.count >= 0 && (pairs == 0 || left.count % 2 != 0);
    record->passed = left.count;
    return STATUS_OK;
}

status flutter_judge_here(flutter_judge *j, step_record *record, fault *f)
{
    step_record at = {0};
    fault why = {""};
    const status factored = newton_direction(&j->n, kinematics_state_path(j->n.state), &at, &why);
    record->negative_pivots = -1;
    if (factored == STATUS_FAULT)
        return fault_set(f, factored, "%s", why.text);
    if (factored != STATUS_OK) /* singular: nothing is decided */
        return STATUS_OK;
    record->negative_pivots = at.negative_pivots;
    if (at.negative_pivots >= 0)
        return STATUS_OK;
    if (j->of.M.value == NULL)
        TRY(flutter_system_alloc(&j->n, &j->of, f));
    if (!j->of.massless)
        return ask_motions(j, record, f);
    return record->by_eigenvalues ? STATUS_OK : count_passed(j, record, f);
}

status flutter_judge_state(flutter_judge *j, analysis_context *c, const model_state *state,
                           step_record *record, fault *f)
{
    const counters work = c->run->counters;
    const int singular = c->work->singular;
    TRY(flutter_judge_begin(j, c, f));
    kinematics_state_copy(c->model, state, j->n.state);
    const status outcome = flutter_judge_here(j, record, f);
    c->work->singular = singular;
    c->run->counters = work;
    return outcome;
}

void flutter_judge_free(flutter_judge *j)
{
    if (!j->begun)
        return;
    flutter_system_free(&j->of);
    newton_free(&j->n);
}
