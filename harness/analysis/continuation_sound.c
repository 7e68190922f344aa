/* Whether a step stayed on its branch, and what is said when it did not. */
#include <math.h>
#include <stdlib.h>

#include "harness/analysis/continuation_impl.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* Between a tangent and the secant, in the metric [rad]: what the tangent misses of a step, as part
 * of it. Steps are chosen by it. */
static const double largest_swing = 0.3;
/* Of any node in one step [rad]: a guard, where few nodes turn. Steps of a tenth of both lead to
 * the same states and events in all cells of `verify`. */
static const double largest_turn = 0.5;

static double angle_to_secant(const continuation *p, const double tangent[], double length)
{
    return acos(fmin(1, fmax(-1, continuation_step_dot(p, tangent, p->moved) / length)));
}

const char *continuation_sound_doubt(const continuation *p, int last_resort, double *swing)
{
    const path_point *a = &p->here, *b = &p->next;
    const double length = sqrt(continuation_step_dot(p, p->moved, p->moved));
    const double before = angle_to_secant(p, a->tangent, length),
                 after = angle_to_secant(p, b->tangent, length);
    const double turned = metric_turn_between(p->c->model, p->n.backup, p->n.state);
    *swing = fmax(fmax(before, after) / largest_swing, turned / largest_turn);
    if (!(before <= largest_swing) || !(after <= largest_swing))
        return "its direction changes too much";
    if (!(turned <= largest_turn))
        return "a node turns too far";
    /* A limit point changes the sign of the rate and of the determinant by one pivot; bifurcations
     * only the latter, and may be several at one point. */
    const int reversed = (a->rate < 0) != (b->rate < 0), pivots = abs(b->negative - a->negative);
    if (!last_resort && reversed && (pivots > 1 || a->determinant == b->determinant))
        return "the pivots of its tangent stiffness change by more than one critical point "
               "explains";
    return NULL;
}

status continuation_sound_report_jump(continuation *p, const rival *r, double from, fault *f)
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
                         "the step from %g to %g m jumps to another branch (load factor %g, on "
                         "this one %g): use smaller steps",
                         from, p->here.control, r->factor, p->here.factor);
    return STATUS_OK;
}
