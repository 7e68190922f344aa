#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>

static int extrema_includes(const extrema *s, const scene_quantity *q)
{
    return q->analysis == s->analysis && scene_is_passed(q, SCENE_MOTION) &&
           scene_is_extreme(q->reduction) && !reading_is_kinematic(q);
}

static void begin(const extrema *s, extremum *one, const scene_quantity *q)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    const double end = path->value[path->stations - 1];
    *one = (extremum){.q = q,
                      .out = &s->out->passing[q - s->c->scene->quantity],
                      .sign = scene_extreme_sign(q),
                      .from = q->passing.from,
                      .until = q->passing.until > 0 ? fmin(q->passing.until, end) : end};
}

status extrema_alloc(extrema *s, fault *f)
{
    const scene *what = s->c->scene;
    for (int i = 0; i < what->quantities; i++)
        s->count += extrema_includes(s, &what->quantity[i]);
    if (s->count == 0)
        return STATUS_OK;
    s->one = calloc((size_t)s->count, sizeof *s->one);
    if (s->one == NULL)
        return fault_memory(f, "the extremes of a motion");
    for (int i = 0, k = 0; i < what->quantities; i++)
        if (extrema_includes(s, &what->quantity[i]))
            begin(s, &s->one[k++], &what->quantity[i]);
    for (int i = 0; i < EXTREMA_ENDS; i++)
        TRY(motion_state_alloc(s->c->model, &s->last[i], f));
    return motion_state_alloc(s->c->model, &s->at, f);
}

void extrema_free(extrema *s)
{
    if (s->count == 0)
        return;
    for (int i = 0; i < EXTREMA_ENDS; i++)
        motion_state_free(&s->last[i]);
    motion_state_free(&s->at);
    free(s->one);
}

static void take(extremum *one, double value, double time, double error)
{
    if (time < one->from || time > one->until)
        return;
    if (!one->out->known || one->sign * value > one->sign * one->out->value)
        *one->out = (outcome_passing){1, value, time, error};
}

/* Computes the value at a time inside the step that starts at `from`, by a probe step. *known 0:
 * the probe step or the reading failed. */
static status beside(extrema *s, const scene_quantity *q, const motion_state *from, double time,
                     double *value, int *known, fault *f)
{
    fault why = {""};
    status outcome = probe_step(s->c, s->scheme, from, time, &s->at, &why);
    if (outcome == STATUS_OK)
        outcome = probe_read(s->c, s->masses, s->out, q, &(probe_point){.at = &s->at}, value, &why);
    *known = outcome == STATUS_OK;
    return outcome == STATUS_FAULT ? fault_set(f, outcome, "%s", why.text) : STATUS_OK;
}

/* Returns the value at a time of the cubic through the values at the last four ends of steps
 * (Neville's algorithm). */
static double cubic(const extrema *s, const extremum *one, double time)
{
    double p[EXTREMA_ENDS];
    for (int i = 0; i < EXTREMA_ENDS; i++)
        p[i] = one->value[i];
    for (int k = 1; k < EXTREMA_ENDS; k++)
        for (int i = 0; i + k < EXTREMA_ENDS; i++) {
            const double a = s->last[i].time, b = s->last[i + k].time;
            p[i] = ((b - time) * p[i] + (time - a) * p[i + 1]) / (b - a);
        }
    return p[0];
}

/* Returns the time between a and b at which the cubic is largest (sign 1) or smallest (sign -1),
 * found by golden-section search. */
static double top_of(const extrema *s, const extremum *one, double a, double b)
{
    const double golden = (sqrt(5) - 1) / 2;
    for (int i = 0; i < 60; i++) {
        const double c = b - golden * (b - a), d = a + golden * (b - a);
        if (one->sign * cubic(s, one, c) > one->sign * cubic(s, one, d))
            b = d;
        else
            a = c;
    }
    return (a + b) / 2;
}

static status look_between(extrema *s, extremum *one, int i, fault *f)
{
    const double a = fmax(s->last[i].time, one->from), b = fmin(s->last[i + 1].time, one->until);
    const double ends = fmax(one->sign * one->value[i], one->sign * one->value[i + 1]);
    if (!(b > a))
        return STATUS_OK;
    const double time = top_of(s, one, a, b), top = cubic(s, one, time),
                 adds = one->sign * top - ends;
    if (!(adds > 1e-12 * fabs(ends)) ||
        (one->out->known && one->sign * top <= one->sign * one->out->value))
        return STATUS_OK;
    double there = 0;
    int known;
    TRY(beside(s, one->q, &s->last[i], time, &there, &known, f));
    if (known && fabs(there - top) < adds)
        take(one, top, time, fabs(there - top));
    return STATUS_OK;
}

static status look_at_edges(extrema *s, extremum *one, fault *f)
{
    const motion_state *from = &s->last[EXTREMA_ENDS - 2], *to = &s->last[EXTREMA_ENDS - 1];
    const double edge[] = {one->from, one->until};
    for (int i = 0; i < 2; i++) {
        double value;
        int known;
        if (!(edge[i] > from->time && edge[i] < to->time))
            continue;
        TRY(beside(s, one->q, from, edge[i], &value, &known, f));
        if (known)
            take(one, value, edge[i], 0);
    }
    return STATUS_OK;
}

static void shift(extrema *s)
{
    const motion_state first = s->last[0];
    for (int i = 0; i + 1 < EXTREMA_ENDS; i++)
        s->last[i] = s->last[i + 1];
    s->last[EXTREMA_ENDS - 1] = first;
    for (int k = 0; k < s->count; k++)
        for (int i = 0; i + 1 < EXTREMA_ENDS; i++)
            s->one[k].value[i] = s->one[k].value[i + 1];
}

status extrema_here(extrema *s, const motion_state *now, const double balance[SCENE_BALANCES],
                    int last, fault *f)
{
    if (s->count == 0)
        return STATUS_OK;
    shift(s);
    s->ends++;
    motion_state_copy(s->c->model, now, &s->last[EXTREMA_ENDS - 1]);
    for (int k = 0; k < s->count; k++) {
        extremum *one = &s->one[k];
        double *value = &one->value[EXTREMA_ENDS - 1];
        TRY(probe_read(s->c, s->masses, s->out, one->q, &(probe_point){now, balance, last}, value,
                       f));
        take(one, *value, now->time, 0);
        if (s->ends > 1)
            TRY(look_at_edges(s, one, f));
        if (s->ends == EXTREMA_ENDS)
            TRY(look_between(s, one, 0, f));
        if (s->ends >= EXTREMA_ENDS)
            TRY(look_between(s, one, 1, f));
        if (s->ends >= EXTREMA_ENDS && last)
            TRY(look_between(s, one, 2, f));
    }
    return STATUS_OK;
}

void extrema_jump(extrema *s)
{
    s->ends = 0;
}

void extrema_end(extrema *s)
{
    for (int k = 0; k < s->count && s->one != NULL; k++) {
        outcome_passing *out = s->one[k].out;
        const scene_reduction how = s->one[k].q->reduction;
        if (how == SCENE_MAX_TIME || how == SCENE_MIN_TIME)
            *out = (outcome_passing){out->known, out->time, out->time, 0};
    }
}
