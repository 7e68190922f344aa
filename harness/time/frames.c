#include "harness/time/frames.h"

#include <math.h>

status frames_alloc(frames *p, int count, fault *f)
{
    TRY(between_alloc(p->eq, &p->inside, f));
    TRY(instant_alloc(p->m, &p->at, f));
    return outcome_stations(p->to, count, f);
}

void frames_free(frames *p)
{
    between_free(&p->inside);
    instant_free(&p->at);
}

/* Of the next frame; infinite: there is none. */
static double next_of(const frames *p)
{
    const int next = p->to->reached, last = p->to->stations - 1;
    if (next > last)
        return INFINITY;
    return next == last ? p->end : p->begin + next * (p->end - p->begin) / last;
}

status frames_begin(frames *p, const instant *now, fault *f)
{
    return p->to->stations > 0 ? outcome_keep(p->to, p->m, now->state, 1, now->time, f) : STATUS_OK;
}

status frames_step(frames *p, between_degree degree, const instant *from, const instant *to,
                   fault *f)
{
    if (next_of(p) <= to->time)
        between_take(&p->inside, degree, from, to);
    while (next_of(p) <= to->time) {
        const double time = next_of(p);
        const model_state *state = to->state;
        if (time < to->time) {
            between_at(&p->inside, time, &p->at);
            state = p->at.state;
        }
        TRY(outcome_keep(p->to, p->m, state, 1, time, f));
    }
    return STATUS_OK;
}
