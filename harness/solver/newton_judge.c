/* Whether a step has ended, goes on or leads nowhere. */
#include "harness/model/kinematics.h"
#include "harness/solver/newton.h"

/* A formulation whose strains are sines of the turn can converge to a state it cannot tell from the
 * right one. */
static status judge_turns(const newton *n, double path, fault *f)
{
    const double quarter = 1.57079632679489661923;
    int element = 0;
    if (!(model_limits(n->c->model) & LIMIT_QUARTER_TURN) ||
        kinematics_largest_turn(n->c->model, n->state, &element) < quarter)
        return STATUS_OK;
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d is turned by more than a quarter turn at path %g: use more "
                     "elements or smaller steps",
                     element, path);
}

status newton_judge(const newton *n, newton_watch *w, double path, double correction, int *done,
                    fault *f)
{
    const double wild = 4; /* a correction of several radians or lengths leads nowhere */
    *done = arrival_reached(&n->arrival);
    if (*done)
        return judge_turns(n, path, f);
    w->growing = correction > w->last && w->iteration > 1 ? w->growing + 1 : 0;
    w->last = correction;
    w->iteration++;
    if (correction > wild * 4 || (w->iteration > 3 && correction > wild) || w->growing >= 4)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "Newton diverged at path %g: correction %.1e in iteration %d", path,
                         correction, w->iteration);
    if (w->iteration == n->max_iterations)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "Newton did not converge in %d iterations at path %g: correction %.1e",
                         n->max_iterations, path, correction);
    return STATUS_OK;
}
