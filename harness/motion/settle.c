/* Newton on the motions without inertia alone: forces and increments are projected onto them
 * (massless.h), and the tangent holds the others by their masses. */
#include "harness/motion/settle.h"

#include <math.h>
#include <string.h>

#include "harness/equations/advance.h"
#include "harness/equations/linearise.h"
#include "harness/model/model_impl.h"
#include "harness/scheme/massless.h"
#include "harness/scheme/stage.h"

/* Stiffness that holds what has inertia, in parts of the largest of its own: no more is lost of
 * that of the rest, no more of Newton's order is either. */
static const double firm = 1e6;

static double *diagonal_of(const sparse *S, double out[])
{
    for (int c = 0; c < S->n; c++) {
        out[c] = 0;
        for (int k = S->column[c]; k < S->column[c + 1]; k++)
            out[c] += S->row[k] == c ? S->value[k] : 0;
    }
    return out;
}

/* What acts, at the accelerations that are known; K: NULL: not wanted. */
static status forces(stage *s, instant *now, sparse *K, fault *f)
{
    model *m = s->c->model;
    model_linearisation lin = {.path = now->time, .K = K, .residual = s->residual};
    if (s->c->options->newton == SOLVE_DISPLACEMENT)
        TRY(linearise_make_compatible(m, now->state, f));
    TRY(linearise_state(m, now->state, &lin, f));
    inertia_subtract(m, s->masses, now->state, now->v, now->a, s->residual);
    return STATUS_OK;
}

static status improve(stage *s, const double zero[], instant *now, double *b,
                      advance_stress *stress, double *correction, fault *f)
{
    model *m = s->c->model;
    TRY(forces(s, now, &s->S, f));
    if (*b == 0) {
        TRY(massless_stiffest(m, s->masses, now->state, diagonal_of(&s->S, s->dx), b, f));
        *b *= firm;
    }
    const inertia_relation with = {*b, 0, zero};
    inertia_add_tangent(m, s->masses, now->state, now->v, now->a, &with, &s->S);
    TRY(massless_forces(m, s->masses, now->state, s->residual, f));
    TRY(stage_direction(s, 1, f));
    TRY(massless_motion(m, s->masses, now->state, s->dx, f));
    *correction = advance_state(m, now->state, s->dx, now->time, stress);
    m->counters.iterations++;
    return STATUS_OK;
}

static status balance(stage *s, const double zero[], instant *now, fault *f)
{
    const double wild = 4;
    double b = 0, correction;
    instant_recall(now, &s->arrival);
    for (int iteration = 1;; iteration++) {
        advance_stress stress;
        TRY(improve(s, zero, now, &b, &stress, &correction, f));
        arrival_take(correction, &stress, iteration == 1, &s->arrival);
        if (arrival_reached(&s->arrival))
            break;
        if (!(correction < wild) || iteration == s->max_iterations)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "at %g s what has no inertia comes into no balance with loads and "
                             "gyroscopic moments (correction %.1e in iteration %d): give it "
                             "inertia, or less spin",
                             now->time, correction, iteration);
    }
    instant_remember(&s->arrival, now);
    return STATUS_OK;
}

status settle(stage *s, const double zero[], instant *now, fault *f)
{
    model *m = s->c->model;
    memset(now->a, 0, (size_t)s->free * sizeof *now->a);
    TRY(balance(s, zero, now, f));
    TRY(forces(s, now, NULL, f));
    TRY(massless_accelerate(m, s->masses, now->state, s->residual, now->a, f));
    memcpy(now->algorithm, now->a, (size_t)s->all * sizeof *now->a);
    return STATUS_OK;
}
