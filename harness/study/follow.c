#include "harness/study/follow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/study/follow_impl.h"

enum { HALVINGS = 20 };

/* The shapes become the walk's, also after a failure. */
static status keep_sample(follow_walk *w, double value, int asked, follow_shapes *s, fault *f)
{
    follow_curves *c = w->out;
    const size_t modes = (size_t)c->modes;
    if (c->samples == w->room) {
        const int room = 2 * w->room + 64;
        follow_sample *more = realloc(c->sample, (size_t)room * sizeof *more);
        c->sample = more != NULL ? more : c->sample;
        follow_shapes *kept = realloc(w->shapes, (size_t)room * sizeof *kept);
        w->shapes = kept != NULL ? kept : w->shapes;
        if (more == NULL || kept == NULL) {
            follow_match_free(s);
            fault_set(f, STATUS_FAULT, "out of memory for curves of modes");
            return STATUS_FAULT;
        }
        w->room = room;
    }
    w->shapes[c->samples] = *s;
    follow_sample *out = &c->sample[c->samples++];
    *out = (follow_sample){.value = value, .asked = asked};
    out->frequency = calloc(2 * modes + 1, sizeof *out->frequency);
    if (out->frequency == NULL) {
        fault_set(f, STATUS_FAULT, "out of memory for curves of modes");
        return STATUS_FAULT;
    }
    out->match = out->frequency + modes;
    for (size_t i = 0; i < modes; i++) {
        out->frequency[i] = s->frequency[i] / (2 * PI);
        out->match[i] = s->match[i];
    }
    return STATUS_OK;
}

static void drop_sample(follow_walk *w)
{
    const int last = --w->out->samples;
    free(w->out->sample[last].frequency);
    follow_match_free(&w->shapes[last]);
}

/* One step from the last sample; *least < follow_sure: it was too long, and nothing is kept. */
static status try_step(follow_walk *w, double target, int asked, double *least, fault *f)
{
    follow_shapes next;
    const int events = w->out->events;
    const status outcome =
        follow_solve(w, target, &w->shapes[w->out->samples - 1], &next, least, f);
    if (outcome != STATUS_OK || *least < follow_sure) {
        follow_match_free(&next);
        return outcome;
    }
    TRY(keep_sample(w, target, asked, &next, f));
    TRY(follow_events_step(w, least, f));
    if (*least < follow_sure) {
        drop_sample(w);
        w->out->events = events;
    }
    return STATUS_OK;
}

/* From the last sample to `to`, in as many steps as it takes. */
static status step_to(follow_walk *w, double to, fault *f)
{
    const follow_curves *c = w->out;
    double target = to, at = c->sample[c->samples - 1].value;
    const double least_step = ldexp(fabs(to - at), -HALVINGS);
    while (at != to) {
        double least = 1;
        TRY(try_step(w, target, target == to, &least, f));
        at = c->sample[c->samples - 1].value;
        target = least >= follow_sure ? to : at + (target - at) / 2;
        if (fabs(target - at) < least_step && at != to)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "a mode is lost behind %.6g: of some shape only %.2f is in the modes "
                             "there; begin elsewhere, or ask for more frequencies",
                             at, least);
    }
    return STATUS_OK;
}

static status walk_along(follow_walk *w, fault *f)
{
    const follow_request *r = w->of;
    follow_shapes first;
    double least;
    const status begun = follow_solve(w, r->from, NULL, &first, &least, f);
    if (begun != STATUS_OK)
        follow_match_free(&first);
    TRY(begun);
    TRY(keep_sample(w, r->from, 1, &first, f));
    for (int i = 1; i <= r->parts; i++)
        TRY(step_to(w, i == r->parts ? r->to : r->from + (r->to - r->from) * i / r->parts, f));
    return STATUS_OK;
}

static status follow(follow_walk *w, fault *f)
{
    TRY(walk_along(w, f));
    return follow_events_rest(w, f);
}

status follow_run(const follow_request *r, follow_curves *out, fault *f)
{
    follow_walk w = {.of = r, .out = out};
    memset(out, 0, sizeof *out);
    const status outcome = follow(&w, f);
    for (int i = 0; i < out->samples; i++)
        follow_match_free(&w.shapes[i]);
    free(w.shapes);
    if (outcome != STATUS_OK)
        follow_free(out);
    return outcome;
}

void follow_free(follow_curves *c)
{
    for (int i = 0; i < c->samples; i++)
        free(c->sample[i].frequency);
    free(c->sample);
    free(c->event);
    memset(c, 0, sizeof *c);
}
