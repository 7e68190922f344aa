#include "harness/time/stations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/time/aside.h"
#include "harness/time/balance.h"

/* Of a step: nearer than that to its end is at its end. */
static const double same_instant = 1e-9;

status stations_alloc(stations *s, fault *f)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    TRY(between_alloc(&s->c->eq, &s->inside, f));
    TRY(instant_alloc(s->c->model, &s->at, f));
    TRY(outcome_stations(&s->out->path, path->stations, f));
    s->out->instant = calloc((size_t)path->stations + 1, sizeof *s->out->instant);
    return s->out->instant != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for the instants of a motion");
}

void stations_free(stations *s)
{
    between_free(&s->inside);
    instant_free(&s->at);
}

/* The next one; infinite: there is none. */
static double next_of(const stations *s)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    const int next = s->out->path.reached;
    return next < path->stations ? path->value[next] : INFINITY;
}

static status keep(stations *s, const instant *at, const double balance[SCENE_BALANCES], fault *f)
{
    const model *m = s->c->model;
    const model_size size = model_sizes(m);
    const size_t bytes = (size_t)(size.free + size.driven + 1) * sizeof(double);
    outcome_instant *to = &s->out->instant[s->out->path.reached];
    to->rate = malloc(2 * bytes);
    if (to->rate == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for an instant of a motion");
    to->acceleration = to->rate + bytes / sizeof(double);
    memcpy(to->rate, at->v, bytes - sizeof(double));
    memcpy(to->acceleration, at->a, bytes - sizeof(double));
    memcpy(to->balance, balance, sizeof to->balance);
    return outcome_keep(&s->out->path, m, at->state, 1, next_of(s), f);
}

/* Is more read at this station than places and rates? */
static int reads_forces(const stations *s, double time)
{
    const scene *what = s->c->scene;
    for (int i = 0; i < what->quantities; i++) {
        const scene_quantity *q = &what->quantity[i];
        const scene_quantity_kind kind = q->what.kind;
        if (q->analysis == s->analysis &&
            (kind == SCENE_REACTION || kind == SCENE_INTERNAL || kind == SCENE_STRESS ||
             kind == SCENE_BALANCE) &&
            (q->reduction == SCENE_AT ? fabs(q->at - time) <= same_instant * fmax(1, fabs(time))
                                      : q->reduction == SCENE_CURVE))
            return 1;
    }
    return 0;
}

/* A step of its own from where the motion's began. */
static status step_to(stations *s, const instant *from, double time, fault *f)
{
    double balance[SCENE_BALANCES];
    TRY(aside_step(s->c, s->scheme, from, time, &s->at, f));
    TRY(balance_of(s->c->model, s->masses, &s->at, balance, f));
    balance[SCENE_DRIFT] -= s->out->origin;
    return keep(s, &s->at, balance, f);
}

status stations_inside(stations *s, const instant *from, const instant *to, fault *f)
{
    const double end = to->time - same_instant * (to->time - from->time);
    double none[SCENE_BALANCES];
    int taken = 0;
    for (int i = 0; i < SCENE_BALANCES; i++)
        none[i] = NAN;
    while (next_of(s) < end) {
        if (reads_forces(s, next_of(s))) {
            TRY(step_to(s, from, next_of(s), f));
            continue;
        }
        if (!taken++)
            between_take(&s->inside, s->scheme->degree, from, to);
        between_at(&s->inside, next_of(s), &s->at);
        TRY(keep(s, &s->at, none, f));
    }
    return STATUS_OK;
}

status stations_here(stations *s, const instant *now, const double balance[SCENE_BALANCES],
                     fault *f)
{
    const double tolerance =
        same_instant * scene_motion_of(&s->c->scene->analysis[s->analysis])->step;
    while (next_of(s) <= now->time + tolerance)
        TRY(keep(s, now, balance, f));
    return STATUS_OK;
}
