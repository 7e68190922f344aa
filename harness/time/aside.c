#include "harness/time/aside.h"

#include "harness/newton/newton.h"

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
