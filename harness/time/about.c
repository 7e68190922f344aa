#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

/* Distance to the end of a step, relative to the step size, below which a time counts as this
 * end. */
static const double same_instant = 1e-9;

static int by_time(const void *a, const void *b)
{
    const outcome_about *x = a, *y = b;
    return (x->time > y->time) - (x->time < y->time);
}

/* Returns the time at which an analysis needs the state [s]; NAN: it needs no state of this
 * motion. */
static double instant_of(const abouts *a, int analysis)
{
    const scene *s = a->c->scene;
    return s->analysis[analysis].follows == a->analysis && context_runs(a->c, analysis)
               ? scene_instant_of(s, analysis)
               : NAN;
}

static int is_listed(const outcome_motion *o, double time)
{
    for (int i = 0; i < o->abouts; i++)
        if (o->about[i].time == time)
            return 1;
    return 0;
}

status abouts_alloc(abouts *a, fault *f)
{
    outcome_motion *o = a->out;
    o->about = calloc((size_t)a->c->scene->analyses + 1, sizeof *o->about);
    if (o->about == NULL)
        return fault_memory(f, "states of a motion");
    for (int i = a->analysis + 1; i < a->c->scene->analyses; i++) {
        const double time = instant_of(a, i);
        if (!isnan(time) && !is_listed(o, time))
            o->about[o->abouts++].time = time;
    }
    if (o->abouts == 0)
        return STATUS_OK;
    qsort(o->about, (size_t)o->abouts, sizeof *o->about, by_time);
    TRY(motion_state_alloc(a->c->model, &a->at, f));
    return motion_state_alloc(a->c->model, &a->room, f);
}

void abouts_free(abouts *a)
{
    motion_state_free(&a->at);
    motion_state_free(&a->room);
}

static double next_of(const abouts *a)
{
    return a->next < a->out->abouts ? a->out->about[a->next].time : INFINITY;
}

static status take(abouts *a, fault *f)
{
    const model *m = a->c->model;
    outcome_about *to = &a->out->about[a->next++];
    if (a->how->scheme == SCENE_CONSERVING)
        TRY(consistent_restart(a->c, a->masses, a->how, &a->at, &a->room, f));
    TRY(small_motions_of(&a->c->eq, a->masses, &a->at, to, f));
    const size_t count = (size_t)model_all_coordinates(m);
    to->rate = malloc((2 * count + 1) * sizeof *to->rate);
    if (to->rate == NULL)
        return fault_memory(f, "a state of a motion");
    to->acceleration = to->rate + count;
    memcpy(to->rate, a->at.v, count * sizeof *to->rate);
    memcpy(to->acceleration, a->at.a, count * sizeof *to->rate);
    TRY(kinematics_state_alloc(m, &to->state, f));
    kinematics_state_copy(m, a->at.state, to->state);
    return STATUS_OK;
}

status abouts_inside(abouts *a, const motion_state *from, const motion_state *to, fault *f)
{
    a->near = same_instant * (to->time - from->time);
    while (next_of(a) < to->time - a->near) {
        TRY(probe_step(a->c, a->scheme, from, next_of(a), &a->at, f));
        TRY(take(a, f));
    }
    return STATUS_OK;
}

status abouts_here(abouts *a, const motion_state *now, fault *f)
{
    while (next_of(a) <= now->time + a->near) {
        if (next_of(a) < now->time - a->near)
            return fault_set(f, STATUS_REFUSED,
                             "an analysis is about the state at %g s, but the motion continues "
                             "from %g s; give a later time, or run the motion from its start",
                             next_of(a), now->time);
        motion_state_copy(a->c->model, now, &a->at);
        TRY(take(a, f));
    }
    return STATUS_OK;
}
