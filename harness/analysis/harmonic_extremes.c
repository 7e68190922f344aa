#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_REMOVED = 8 };
/* Search for the largest sign * value. removed: undamped natural frequencies whose modes do not
 * contribute to the response, because the input does not excite them or the output does not contain
 * them. At these frequencies the response is continuous, but the equations are singular. */
typedef struct extreme_search {
    vibration *v;
    harmonic_value *respond;
    int quantity, removed;
    double sign, size, hertz[MOST_REMOVED]; /* size: magnitude of the response */
} extreme_search;

static const double aside =
    1e-6; /* distance from a natural frequency, relative to this frequency */

static status value_at(extreme_search *s, double hertz, outcome_peak *out, fault *f)
{
    for (int i = 0; i < s->removed; i++) {
        const double off = (hertz / s->hertz[i] - 1) / aside;
        outcome_peak above;
        if (fabs(off) >= 1)
            continue;
        TRY(s->respond(s->v, s->quantity, s->sign, s->hertz[i] * (1 - aside), out, f));
        TRY(s->respond(s->v, s->quantity, s->sign, s->hertz[i] * (1 + aside), &above, f));
        out->value += (above.value - out->value) * (1 + off) / 2;
        out->bound = fmax(out->bound, above.bound);
        out->hertz = hertz;
        return STATUS_OK;
    }
    return s->respond(s->v, s->quantity, s->sign, hertz, out, f);
}

/* Searches for the largest sign * value between two frequencies by golden-section search, which
 * assumes a single maximum. */
static status refine_between(extreme_search *s, double low, double high, outcome_peak *best,
                             fault *f)
{
    const double part = 0.6180339887498949, narrow = 1e-10, settled = 1e-3, nothing = 1e-6,
                 sign = s->sign;
    outcome_peak a, b;
    TRY(value_at(s, high - part * (high - low), &a, f));
    TRY(value_at(s, low + part * (high - low), &b, f));
    while (high - low > narrow * high && isfinite(a.value) && isfinite(b.value)) {
        if (sign * a.value >= sign * b.value) {
            high = b.hertz;
            b = a;
            TRY(value_at(s, high - part * (high - low), &a, f));
        } else {
            low = a.hertz;
            a = b;
            TRY(value_at(s, low + part * (high - low), &b, f));
        }
    }
    *best = sign * a.value >= sign * b.value ? a : b;
    best->known = 1;
    const double larger = fmax(fabs(a.value), fabs(b.value));
    best->unbounded = !isfinite(best->value) ||
                      (fabs(a.value - b.value) > settled * larger && larger > nothing * s->size);
    return STATUS_OK;
}

/* Sets *pole to 1 if the response increases by more than a factor of 3 when the distance from the
 * frequency decreases to a tenth. */
static status is_pole(extreme_search *s, double hertz, int *pole, fault *f)
{
    static const double distance[] = {1e-4, 1e-5, 1e-6}, round_off = 1e-6;
    double middle = 0, apart[3];
    for (int i = 0; i < 3; i++) {
        outcome_peak a, b;
        TRY(value_at(s, hertz * (1 - distance[i]), &a, f));
        TRY(value_at(s, hertz * (1 + distance[i]), &b, f));
        middle = i == 0 ? (a.value + b.value) / 2 : middle;
        apart[i] = fabs(a.value - middle) + fabs(b.value - middle);
    }
    *pole = !(apart[2] <= fmax(3 * apart[1], round_off * fmax(s->size, fabs(middle))));
    return STATUS_OK;
}

static status find_between(extreme_search *s, double low, double high, outcome_peak *best, fault *f)
{
    for (int pole = 0;;) {
        TRY(refine_between(s, low, high, best, f));
        if (best->unbounded)
            TRY(is_pole(s, best->hertz, &pole, f));
        if (!best->unbounded || pole || s->removed == MOST_REMOVED)
            return STATUS_OK;
        s->hertz[s->removed++] = best->hertz;
    }
}

typedef struct samples {
    int count;
    double *hertz, *value;
    int *station; /* station of the analysis; SCENE_NONE: a frequency between stations */
} samples;

/* at f (1 +- 10^-1 ... 10^-5) on both sides of a natural frequency f */
enum { SIDES = 5, BETWEEN = 9 };

static void samples_free(samples *s)
{
    free(s->hertz);
    free(s->value);
    free(s->station);
}

static void insert(samples *s, double hertz, int station)
{
    int at = s->count;
    while (at > 0 && s->hertz[at - 1] >= hertz)
        at--;
    if (at < s->count && s->hertz[at] == hertz)
        return;
    for (int i = s->count++; i > at; i--) {
        s->hertz[i] = s->hertz[i - 1];
        s->station[i] = s->station[i - 1];
    }
    s->hertz[at] = hertz;
    s->station[at] = station;
}

static status sample(vibration *v, const outcome_path *path, samples *s, fault *f)
{
    const double low = path->value[0], high = path->value[path->stations - 1];
    int natural;
    double *hertz;
    status outcome = harmonic_natural(v, high, &natural, &hertz, f);
    const size_t room = (size_t)path->stations + (2 * SIDES + BETWEEN) * ((size_t)natural + 1) + 1;
    s->hertz = calloc(room, sizeof *s->hertz);
    s->value = calloc(room, sizeof *s->value);
    s->station = calloc(room, sizeof *s->station);
    if (outcome == STATUS_OK && (s->hertz == NULL || s->value == NULL || s->station == NULL))
        outcome = fault_memory(f, "a harmonic analysis");
    for (int i = 0; outcome == STATUS_OK && i < path->stations; i++)
        insert(s, path->value[i], i);
    for (int i = 0; outcome == STATUS_OK && i < 2 * SIDES * natural; i++) {
        const int mode = i / (2 * SIDES), digits = 1 + i % (2 * SIDES) / 2;
        const double at = hertz[mode] * (1 + pow(10, -digits) * (i % 2 ? 1 : -1));
        if (at > low && at < high)
            insert(s, at, SCENE_NONE);
    }
    double from = low;
    for (int i = 0; outcome == STATUS_OK && i <= natural && from < high; i++) {
        const double to = fmin(high, i < natural ? fmax(hertz[i], from) : high);
        for (int k = 1; k <= BETWEEN && to > from; k++)
            insert(s, from + (to - from) * k / (BETWEEN + 1), SCENE_NONE);
        from = to;
    }
    free(hertz);
    return outcome;
}

/* Finds the extreme of a quantity: refines between the neighbours of every local extreme. */
static status refine(vibration *v, harmonic_value *respond, int quantity, samples *at,
                     outcome_harmonic *o, fault *f)
{
    const scene_quantity *q = &v->c->scene->quantity[quantity];
    const int last = at->count - 1;
    const double *known = o->response + (size_t)quantity * (size_t)o->path.stations;
    double *value = at->value, most = -INFINITY, size = 0;
    const double sign = (q->reduction == SCENE_MAX) == (q->factor > 0) ? 1 : -1;
    static const double boundless =
        1e8; /* largest extreme, relative to the values at the frequencies of the analysis */
    for (int i = 0; i <= last; i++) {
        outcome_peak one = {0};
        if (at->station[i] != SCENE_NONE) {
            value[i] = known[at->station[i]];
            most = fmax(most, sign * value[i]);
            size = fmax(size, fabs(value[i]));
            continue;
        }
        TRY(respond(v, quantity, sign, at->hertz[i], &one, f));
        value[i] = one.value;
    }
    for (int i = 0; i <= last && last > 0; i++) {
        const int before = i > 0 ? i - 1 : i, after = i < last ? i + 1 : i;
        outcome_peak one;
        if (sign * value[i] < sign * value[before] || sign * value[i] < sign * value[after])
            continue;
        extreme_search by = {
            .v = v, .respond = respond, .quantity = quantity, .sign = sign, .size = size};
        TRY(find_between(&by, at->hertz[before], at->hertz[after], &one, f));
        one.unbounded |= size > 0 && fabs(one.value) > boundless * size;
        if (sign * one.value <= most)
            continue;
        most = sign * one.value;
        o->peak[quantity] = one;
    }
    return STATUS_OK;
}

status harmonic_extremes_refine(vibration *v, harmonic_value *respond, outcome_harmonic *o,
                                fault *f)
{
    const scene *s = v->c->scene;
    samples at = {0};
    status outcome = STATUS_OK;
    for (int k = 0; outcome == STATUS_OK && k < s->quantities; k++) {
        const scene_quantity *q = &s->quantity[k];
        if (!scene_requests(q, v->analysis, SCENE_RESPONSE) ||
            (q->reduction != SCENE_MAX && q->reduction != SCENE_MIN) ||
            q->what.of.response.part == SCENE_PHASE)
            continue;
        if (at.hertz == NULL)
            outcome = sample(v, &o->path, &at, f);
        if (outcome == STATUS_OK)
            outcome = refine(v, respond, k, &at, o, f);
    }
    samples_free(&at);
    return outcome;
}
