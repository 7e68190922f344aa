#include "harness/time/time_impl.h"

#include <math.h>

#include "harness/numerics/numerics.h"

status probe_step(analysis_context *c, motion_scheme *s, const motion_state *from, double time,
                  motion_state *at, fault *f)
{
    step_record record = {.path = time, .increment = time - from->time};
    double error = 0;
    const status outcome = s->step(s, from, time - from->time, at, &error, &record, f);
    history_drop_step(c->result, &record);
    at->time = time;
    return outcome;
}

status probe_read(const analysis_context *c, const frame_masses *masses, const outcome_motion *of,
                  const scene_quantity *q, const probe_point *place, double *out, fault *f)
{
    const motion_state *at = place->at;
    double own[SCENE_BALANCES];
    reading from = {.eq = &c->eq,
                    .state = at->state,
                    .v = at->v,
                    .a = at->a,
                    .balance = place->balance,
                    .before = place->before};
    if (q->what.kind == SCENE_BALANCE && from.balance == NULL) {
        TRY(balance_of(&c->eq, masses, at, own, f));
        own[SCENE_DRIFT] -= of->origin;
        from.balance = own;
    }
    return reading_whole(&from, q, out, f);
}

status probe_steps_alloc(probe_steps *s, fault *f)
{
    for (int i = 0; i < PROBE_STEPS; i++)
        TRY(motion_state_alloc(s->c->model, &s->at[i], f));
    return STATUS_OK;
}

void probe_steps_free(probe_steps *s)
{
    for (int i = 0; i < PROBE_STEPS; i++)
        motion_state_free(&s->at[i]);
}

void probe_steps_set(probe_steps *s, const motion_state *from, const motion_state *to)
{
    s->from = from;
    s->to = to;
    s->made = 0;
    s->outcome = STATUS_OK;
}

static status state_at(probe_steps *s, double time, const motion_state **out, fault *f)
{
    *out = time == s->from->time ? s->from : time == s->to->time ? s->to : NULL;
    for (int i = 0; i < s->made && *out == NULL; i++)
        if (s->at[i].time == time)
            *out = &s->at[i];
    if (*out != NULL)
        return STATUS_OK;
    motion_state *at = &s->at[s->made < PROBE_STEPS ? s->made++ : PROBE_STEPS - 1];
    *out = at;
    const status outcome = probe_step(s->c, s->scheme, s->from, time, at, f);
    if (outcome != STATUS_OK)
        at->time = NAN;
    return outcome;
}

double probe_steps_reading(probe_steps *s, const scene_quantity *q, double time)
{
    const motion_state *at;
    double value = NAN;
    fault why = {""};
    status outcome = state_at(s, time, &at, &why);
    if (outcome == STATUS_OK)
        outcome = probe_read(s->c, s->masses, s->out, q,
                             &(probe_point){.at = at, .before = at == s->to}, &value, &why);
    if (outcome != STATUS_OK && s->outcome != STATUS_FAULT) {
        s->outcome = outcome;
        s->why = why;
    }
    return outcome == STATUS_OK ? value : NAN;
}
