/* Newton on the motions without inertia alone: forces and increments are projected onto them
 * (massless.h), and the tangent holds the others by their masses. */
#include "harness/time/settle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/damping.h"
#include "harness/time/massless.h"
#include "harness/time/stage.h"

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
static status forces(motion_stage *s, instant *now, sparse *K, fault *f)
{
    const model *m = s->c->model;
    model_linearisation lin = {.path = now->time, .K = K, .residual = s->residual};
    if (s->c->options->newton == NEWTON_DISPLACEMENT)
        TRY(linearise_make_compatible(&s->c->eq, now->state, f));
    TRY(linearise_state(&s->c->eq, &s->c->run->memory, now->state, &lin, f));
    inertia_subtract(m, s->masses, now->state, now->v, now->a, s->residual);
    return STATUS_OK;
}

/* What an iteration works on. */
typedef struct settle_solution {
    motion_stage *s;
    const double *zero;
    instant *now;
    double b, *moved;
} settle_solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    settle_solution *one = of;
    motion_stage *s = one->s;
    instant *now = one->now;
    const model *m = s->c->model;
    (void)iteration;
    (void)record;
    TRY(forces(s, now, &s->S, f));
    if (one->b == 0) {
        TRY(massless_stiffest(m, s->masses, now->state, diagonal_of(&s->S, s->dx), &one->b, f));
        one->b *= firm;
    }
    const inertia_relation with = {one->b, 0, one->zero};
    inertia_add_tangent(&s->c->eq, s->masses, now->state, now->v, now->a, &with, &s->S);
    TRY(massless_forces(m, s->masses, now->state, s->residual, f));
    TRY(stage_direction(s, 1, f));
    TRY(massless_motion(m, s->masses, now->state, s->dx, f));
    for (int c = 0; c < s->free; c++)
        one->moved[c] += s->dx[c];
    out->at = now->time;
    out->size =
        advance_state(&s->c->eq, &s->c->run->memory, now->state, s->dx, now->time, &out->stress);
    return STATUS_OK;
}

static status balance(motion_stage *s, const double zero[], instant *now, double moved[], fault *f)
{
    settle_solution one = {s, zero, now, 0, moved};
    step_record record = {.path = now->time};
    const newton_use use = newton_in_time(s->c, &one, correct, NULL);
    instant_recall(now, &s->arrival);
    const status outcome = newton_iterate(s->c, &use, &s->arrival, &record, f);
    history_drop_step(s->c->result, &record);
    if (outcome == STATUS_NOT_CONVERGED)
        return fault_set(f, outcome,
                         "at %g s what has no inertia comes into no balance with loads and "
                         "gyroscopic moments (correction %.1e in iteration %d): give it "
                         "inertia, or less spin",
                         now->time, record.correction, record.iterations);
    if (outcome == STATUS_OK)
        instant_remember(&s->arrival, now);
    return outcome;
}

/* Nodes of elements that are damped for long, against a step h: what of them has no inertia comes
 * to rest no sooner. of[free]: their coordinates; returns how many. */
static int creeping(const model *m, double h, unsigned char of[])
{
    const double part = 1e-3;
    int count = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        if (model_scene(m)->member[el->member].damping < part * h)
            continue;
        for (int c = 0; c < el->columns; c++)
            if (el->index[c] != NONE && el->index[c] < model_unknowns(m)) {
                count += !of[el->index[c]];
                of[el->index[c]] = 1;
            }
    }
    return count;
}

/* Balance where positions that damping holds give way by a part of what they move in h. */
static status give_way(motion_stage *s, const double zero[], double h, double softness,
                       instant *now, double moved[], fault *f)
{
    const model *m = s->c->model;
    memcpy(now->strain2, now->state->e,
           (size_t)(model_elements(m) * model_strains(m)) * sizeof *now->strain2);
    damping_follow(&s->c->eq, 1 / (softness * h), now->strain, now->strain2);
    return balance(s, zero, now, moved, f);
}

/* First the rates, which a way tells that is long enough to have digits, and as if nothing had been
 * moved the balance of what no damping holds. What iterations had left between D(x) and e would be
 * a way, too. */
static status creep(motion_stage *s, const double zero[], double h, instant *now, double moved[],
                    const unsigned char of[], fault *f)
{
    const double telling = 1e-6, nothing = 1e-9;
    const model *m = s->c->model;
    model_state *before = NULL;
    TRY(linearise_make_compatible(&s->c->eq, now->state, f));
    status outcome = kinematics_state_alloc(m, &before, f);
    if (outcome == STATUS_OK) {
        kinematics_state_copy(m, now->state, before);
        outcome = give_way(s, zero, h, telling, now, moved, f);
    }
    if (outcome == STATUS_OK) {
        massless_own_axes(m, now->state, moved);
        for (int c = 0; c < s->free; c++)
            now->v[c] += of[c] ? moved[c] / (telling * h) : 0;
        kinematics_state_copy(m, before, now->state);
        outcome = damping_now(&s->c->eq, now, f);
    }
    kinematics_state_free(before);
    TRY(outcome);
    TRY(give_way(s, zero, h, nothing, now, moved, f));
    return damping_now(&s->c->eq, now, f);
}

static status find_balance(motion_stage *s, const double zero[], double h, instant *now, fault *f)
{
    const model *m = s->c->model;
    double *moved = calloc((size_t)s->free + 1, sizeof *moved);
    unsigned char *of = calloc((size_t)s->free + 1, 1);
    status outcome = fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    if (moved != NULL && of != NULL)
        outcome = s->c->run->damping != NULL && creeping(m, h, of) > 0
                      ? creep(s, zero, h, now, moved, of, f)
                      : balance(s, zero, now, moved, f);
    free(moved);
    free(of);
    return outcome;
}

status settle(motion_stage *s, const double zero[], double h, instant *now, fault *f)
{
    const model *m = s->c->model;
    memset(now->a, 0, (size_t)s->free * sizeof *now->a);
    TRY(find_balance(s, zero, h, now, f));
    TRY(forces(s, now, NULL, f));
    TRY(massless_accelerate(m, s->masses, now->state, s->residual, now->a, f));
    memcpy(now->algorithm, now->a, (size_t)s->all * sizeof *now->a);
    return STATUS_OK;
}
