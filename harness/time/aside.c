/* Side steps: the state of a motion at a time inside a step, with its forces and energies. */
#include "harness/time/time_impl.h"

#include <math.h>

#include "harness/numerics/numerics.h"

status aside_step(analysis_context *c, motion_scheme *s, const instant *from, double time,
                  instant *at, fault *f)
{
    step_record record = {.path = time, .increment = time - from->time};
    double error = 0;
    const status outcome = s->step(s, from, time - from->time, at, &error, &record, f);
    history_drop_step(c->result, &record);
    at->time = time;
    return outcome;
}

status aside_read(const analysis_context *c, const carried_masses *masses, const outcome_motion *of,
                  const scene_quantity *q, const aside_place *place, double *out, fault *f)
{
    const instant *at = place->at;
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

status asides_alloc(asides *s, fault *f)
{
    for (int i = 0; i < ASIDES; i++)
        TRY(instant_alloc(s->c->model, &s->at[i], f));
    return STATUS_OK;
}

void asides_free(asides *s)
{
    for (int i = 0; i < ASIDES; i++)
        instant_free(&s->at[i]);
}

void asides_take(asides *s, const instant *from, const instant *to)
{
    s->from = from;
    s->to = to;
    s->made = 0;
    s->outcome = STATUS_OK;
}

/* Finds the instant at a time of the step. Makes a side step if the instant is not stored. */
static status instant_at(asides *s, double time, const instant **out, fault *f)
{
    *out = time == s->from->time ? s->from : time == s->to->time ? s->to : NULL;
    for (int i = 0; i < s->made && *out == NULL; i++)
        if (s->at[i].time == time)
            *out = &s->at[i];
    if (*out != NULL)
        return STATUS_OK;
    instant *at = &s->at[s->made < ASIDES ? s->made++ : ASIDES - 1];
    *out = at;
    const status outcome = aside_step(s->c, s->scheme, s->from, time, at, f);
    if (outcome != STATUS_OK)
        at->time = NAN;
    return outcome;
}

double asides_reading(asides *s, const scene_quantity *q, double time)
{
    const instant *at;
    double value = NAN;
    fault why = {""};
    status outcome = instant_at(s, time, &at, &why);
    if (outcome == STATUS_OK)
        outcome = aside_read(s->c, s->masses, s->out, q,
                             &(aside_place){.at = at, .before = at == s->to}, &value, &why);
    if (outcome != STATUS_OK && s->outcome != STATUS_FAULT) {
        s->outcome = outcome;
        s->why = why;
    }
    return outcome == STATUS_OK ? value : NAN;
}
