/* Whether a step stayed on its branch. */
#include <math.h>
#include <stdlib.h>

#include "harness/solve/continuation.h"

static const double largest_swing = 0.5; /* [rad] between a tangent and the secant, in the metric */
static const double largest_turn = 0.25; /* [rad] of any node in one step */

static double angle_to_secant(const continuation *p, const double tangent[], double length)
{
    return acos(fmin(1, fmax(-1, continuation_dot(p, tangent, p->moved) / length)));
}

const char *continuation_doubt(const continuation *p, int last_resort, double *swing)
{
    const path_point *a = &p->here, *b = &p->next;
    const double length = sqrt(continuation_dot(p, p->moved, p->moved));
    const double before = angle_to_secant(p, a->tangent, length), after = angle_to_secant(p, b->tangent, length);
    const double turned = model_turn_between(p->c->model, p->n.backup, p->n.state);
    *swing = fmax(fmax(before, after) / largest_swing, turned / largest_turn);
    if (!(before <= largest_swing) || !(after <= largest_swing))
        return "its direction changes too much";
    if (!(turned <= largest_turn))
        return "a node turns too far";
    /* A limit point changes the sign of the rate and of the determinant by one pivot, a simple bifurcation only the latter. */
    const int reversed = (a->rate < 0) != (b->rate < 0), pivots = abs(b->negative - a->negative);
    if (!last_resort && (pivots > 1 || (reversed && a->determinant == b->determinant)))
        return "the pivots of its tangent stiffness change by more than one critical point explains";
    return NULL;
}
