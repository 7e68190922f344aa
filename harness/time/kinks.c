#include "harness/time/kinks.h"

#include <math.h>

static double first_behind(const scene_function *f, double time)
{
    double next = INFINITY;
    for (int i = 0; i < f->pieces - 1; i++)
        if (f->piece[i].until > time && f->piece[i].until < next)
            next = f->piece[i].until;
    return next;
}

double kinks_next(const model *m, double time)
{
    const scene *s = model_scene(m);
    double next = INFINITY;
    for (int i = 0; i < s->loads; i++)
        next = fmin(next, first_behind(&s->load[i].function, time));
    for (int i = 0; i < s->drivers; i++)
        next = fmin(next, first_behind(&s->driver[i].function, time));
    return next;
}

double kinks_before(const model *m, double time)
{
    const double before = nextafter(time, -INFINITY);
    return kinks_next(m, before) == time ? before : time;
}
