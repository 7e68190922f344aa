#include <math.h>
#include <stdlib.h>

#include "elements/math/pi.h"
#include "harness/study/follow_impl.h"

enum { MOST_REFINEMENTS = 30 };
static const double equal = 1e-9;       /* frequencies, in parts of themselves */
static const double exact = 1e-12;      /* of a crossing's place, in parts of the step */
static const double close_enough = 0.1; /* gap of a veering that is told */

/* f_i - f_j at a value, the modes matched with those of sample k; *mean of both [Hz]. */
static status difference_at(follow_walk *w, int k, double value, const int mode[2],
                            double *difference, double *mean, double *least, fault *f)
{
    follow_shapes s;
    double match = 1;
    const status outcome = follow_solve(w, value, &w->shapes[k], &s, &match, f);
    *least = fmin(*least, match);
    if (outcome == STATUS_OK) {
        *difference = (s.frequency[mode[0]] - s.frequency[mode[1]]) / (2 * PI);
        *mean = (s.frequency[mode[0]] + s.frequency[mode[1]]) / (4 * PI);
    }
    follow_match_free(&s);
    return outcome;
}

static double difference_of(const follow_sample *s, const int mode[2])
{
    return s->frequency[mode[0]] - s->frequency[mode[1]];
}

/* Distance of the two in parts of their mean. */
static double gap_of(const follow_sample *s, const int mode[2])
{
    return 2 * fabs(difference_of(s, mode)) / (s->frequency[mode[0]] + s->frequency[mode[1]]);
}

/* Between samples a and b, of different sign: regula falsi that halves the value of an end that
 * stays (Illinois). */
static status find_crossing(follow_walk *w, int a, int b, follow_event *e, double *least, fault *f)
{
    const follow_sample *s = w->out->sample;
    double x[2] = {s[a].value, s[b].value},
           d[2] = {difference_of(&s[a], e->mode), difference_of(&s[b], e->mode)}, change;
    const double width = fabs(x[1] - x[0]);
    int kept = -1;
    e->value = x[0];
    for (int i = 0; i < MOST_REFINEMENTS; i++) {
        const double next = (x[0] * d[1] - x[1] * d[0]) / (d[1] - d[0]);
        double here;
        change = fabs(next - e->value);
        e->value = next;
        TRY(difference_at(w, a, next, e->mode, &here, &e->frequency, least, f));
        if (*least < follow_sure || fabs(here) <= equal * e->frequency || change <= exact * width)
            return STATUS_OK;
        const int side = (here > 0) == (d[1] > 0); /* the end that it replaces */
        x[side] = next;
        d[side] = here;
        d[!side] /= kept == !side ? 2 : 1;
        kept = !side;
    }
    return STATUS_OK;
}

static status add_event(follow_curves *c, const follow_event *e, fault *f)
{
    follow_event *more = realloc(c->event, ((size_t)c->events + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for curves of modes");
    c->event = more;
    more[c->events++] = *e;
    return STATUS_OK;
}

/* The last step again, where two modes change their order. */
status follow_events_step(follow_walk *w, double *least, fault *f)
{
    const int last = w->out->samples - 1;
    const follow_sample *s = w->out->sample;
    for (int i = 0; i < w->out->modes; i++)
        for (int j = i + 1; j < w->out->modes; j++) {
            follow_event e = {.crossing = 1, .mode = {i, j}};
            if (gap_of(&s[last - 1], e.mode) <= equal || gap_of(&s[last], e.mode) <= equal ||
                difference_of(&s[last - 1], e.mode) * difference_of(&s[last], e.mode) > 0)
                continue;
            TRY(find_crossing(w, last - 1, last, &e, least, f));
            TRY(add_event(w->out, &e, f));
        }
    return STATUS_OK;
}

/* Samples where the gap of two modes is least: they come close and part again. */
static status find_veerings(follow_walk *w, const int mode[2], fault *f)
{
    const follow_sample *s = w->out->sample;
    for (int k = 1; k + 1 < w->out->samples; k++) {
        const double gap = gap_of(&s[k], mode), d = difference_of(&s[k], mode);
        if (!(gap < close_enough && gap > equal && gap < gap_of(&s[k - 1], mode) &&
              gap <= gap_of(&s[k + 1], mode) && d * difference_of(&s[k - 1], mode) > 0 &&
              d * difference_of(&s[k + 1], mode) > 0))
            continue;
        const follow_event e = {
            0, {mode[0], mode[1]}, s[k].value, s[k].frequency[mode[0]] - d / 2, gap};
        TRY(add_event(w->out, &e, f));
    }
    return STATUS_OK;
}

/* Crossings at samples themselves; confirm has found the others. */
static status find_crossings(follow_walk *w, const int mode[2], fault *f)
{
    const follow_sample *s = w->out->sample;
    for (int k = 0, last = -1; k < w->out->samples; k++) {
        if (gap_of(&s[k], mode) <= equal)
            continue;
        if (last >= 0 && last < k - 1 &&
            difference_of(&s[last], mode) * difference_of(&s[k], mode) < 0) {
            follow_event e = {.crossing = 1, .mode = {mode[0], mode[1]}};
            double least = 1;
            TRY(find_crossing(w, last, k, &e, &least, f));
            TRY(add_event(w->out, &e, f));
        }
        last = k;
    }
    return STATUS_OK;
}

static int by_value(const void *a, const void *b)
{
    const double x = ((const follow_event *)a)->value, y = ((const follow_event *)b)->value;
    return (x > y) - (x < y);
}

status follow_events_rest(follow_walk *w, fault *f)
{
    for (int i = 0; i < w->out->modes; i++)
        for (int j = i + 1; j < w->out->modes; j++) {
            TRY(find_crossings(w, (const int[2]){i, j}, f));
            TRY(find_veerings(w, (const int[2]){i, j}, f));
        }
    if (w->out->events > 0)
        qsort(w->out->event, (size_t)w->out->events, sizeof *w->out->event, by_value);
    return STATUS_OK;
}
