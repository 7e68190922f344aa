#include "harness/scheme/kinks.h"

#include <math.h>

#include "harness/equations/loads.h"
#include "harness/model/model_impl.h"

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
    double next = INFINITY;
    for (int i = 0; i < m->scene->loads; i++)
        next = fmin(next, first_behind(&m->scene->load[i].function, time));
    for (int i = 0; i < m->scene->drivers; i++)
        next = fmin(next, first_behind(&m->scene->driver[i].function, time));
    return next;
}

double kinks_before(const model *m, double time)
{
    const double before = nextafter(time, -INFINITY);
    return kinks_next(m, before) == time ? before : time;
}

status kinks_check(const model *m, double end, fault *f)
{
    const double tolerance = 1e-9;
    for (int i = 0; i < m->scene->drivers; i++) {
        const scene_driver *d = &m->scene->driver[i];
        double t = first_behind(&d->function, 0);
        while (t < end) {
            double before[3], after[3];
            loads_driver_rates(m, d, nextafter(t, -INFINITY), before);
            loads_driver_rates(m, d, t, after);
            for (int k = 0; k < 2; k++)
                if (fabs(before[k] - after[k]) > tolerance * (1 + fabs(before[k])))
                    return fault_set(
                        f, STATUS_REFUSED,
                        "driver %s: its %s jumps at %g s, which is an impact; join its "
                        "pieces smoothly",
                        d->name, k == 0 ? "value" : "velocity", t);
            t = first_behind(&d->function, t);
        }
    }
    return STATUS_OK;
}
