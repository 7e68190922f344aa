/* Search for the path parameter at which stability is lost. Bisection narrows the interval between
 * the last stable and the first unstable station. Interpolation follows on the unstable side, where
 * the square of the imaginary part of s^2 (flutter), s^2 (divergence) or s (with damping) is
 * smooth. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

enum {
    MOTIONS = 8,
    COMPARED_MOTIONS = 4,
    MAX_STATIONS = 400,
    MAX_TRIALS = 8,
    MAX_CLOSER = 60,
    POINTS = 3
};
/* first step, relative to the path parameter of the followed state */
static const double first_step = 1e-3;
static const double wanted_change = 0.15,
                    largest_change = 0.5; /* relative change of the square of a frequency */
static const double fastest_growth = 10;  /* ratio of a step to the previous step */
static const double farthest =
    1e3; /* end of the search, relative to the path parameter of the followed state */
static const double farther =
    100; /* end of the search, relative to the path on which a square doubles at its initial rate */
/* width of the interval at which interpolation starts, relative to the path parameter */
static const double coarse_interval = 1e-2;
static const double near_lost =
    1e-2; /* distance to a point without equilibrium, relative to the path parameter */
static const double closer = 0.1; /* fraction of the remaining interval */
/* distance of the unstable station from the estimate, and change of the estimate, at which the
 * search ends, relative to the path parameter */
static const double closest = 1e-5, wanted_error = 1e-10;
/* the same distance at a divergence, where Newton's method still converges */
static const double near_divergence = 1e-4;
/* square of the relative difference of two squares that count as equal */
static const double alike = 1e-10;

typedef struct station {
    double path;
    flutter_kind kind;
    int count;
    double square[MOTIONS]; /* squares of frequencies in ascending order; negative: divergence */
    double measure;         /* measure of the growing mode, which is zero where stability is lost */
    double frequency;
} station;

typedef struct search {
    newton_run *n;
    flutter_walk *walk;
    flutter_system of;
    model_state *kept; /* state of the last stable station */
    station before, last, next;
    double size;
    unsymmetric_result found; /* modes of the last unstable station */
    int mode;
} search;

static void describe(search *s, const unsymmetric_result *r, station *out)
{
    out->kind = flutter_of(&s->of, r, &s->mode);
    out->count = flutter_squares(&s->of, r, MOTIONS, out->square);
    if (out->kind == FLUTTER_NONE)
        return;
    const double rate = r->growth[s->mode], split = r->split[s->mode];
    out->frequency = r->frequency[s->mode];
    out->measure = s->of.damped                      ? rate / hypot(rate, out->frequency)
                   : out->kind == FLUTTER_OSCILLATES ? split * split
                                                     : rate * rate;
}

/* STATUS_SINGULAR: the tangent is singular. significant 1: growth within rounding is ignored. */
static status look_closely(search *s, double path, int significant, station *out, fault *f)
{
    newton_run *n = s->n;
    step_record unused = {0};
    unsymmetric_result r = {0};
    double increment = path - kinematics_state_path(s->kept);
    memset(out, 0, sizeof *out);
    out->path = path;
    kinematics_state_copy(n->c->model, s->kept, n->state);
    if (increment != 0)
        TRY(s->walk(n, path, &increment, f));
    TRY(newton_direction(n, path, &unused, f));
    status outcome = flutter_motions(n, &s->of, s->of.damped ? COMPARED_MOTIONS : MOTIONS,
                                     significant ? FLUTTER_ERRORS : FLUTTER_MODES, &r, f);
    if (outcome == STATUS_OK)
        describe(s, &r, out);
    if (outcome == STATUS_OK && out->kind != FLUTTER_NONE) {
        unsymmetric_free(&s->found);
        s->found = r;
    } else {
        unsymmetric_free(&r);
    }
    return outcome;
}

static status look(search *s, double path, station *out, fault *f)
{
    return look_closely(s, path, 0, out, f);
}

static void keep(search *s, const station *at)
{
    s->before = s->last;
    s->last = *at;
    kinematics_state_copy(s->n->c->model, s->n->state, s->kept);
}

/* Returns the largest relative change of a square between two stations. The change is relative to
 * the square at station a, but to `lowest` (the lowest square at path 0) if `lowest` is larger. */
static double change(const station *a, const station *b, double lowest)
{
    double largest = 0;
    for (int i = 0; i < COMPARED_MOTIONS && i < a->count && i < b->count; i++)
        largest =
            fmax(largest, fabs(b->square[i] - a->square[i]) / fmax(fabs(a->square[i]), lowest));
    return largest;
}

/* Returns the square of the relative difference of two adjacent squares. Its continuation beyond a
 * flutter point is negative. */
static double difference(const station *a, int i)
{
    const double part = (a->square[i + 1] - a->square[i]) / (a->square[i + 1] + a->square[i]);
    return part * part;
}

/* Returns the path parameter at the minimum of the parabola through the differences at three
 * stations. Returns NAN if this minimum is not between the stations, or neither negative nor small.
 */
static double vertex(const station *a, const station *b, const station *c, int i)
{
    const double fa = difference(a, i), fb = difference(b, i), fc = difference(c, i);
    const double ab = (fb - fa) / (b->path - a->path), bc = (fc - fb) / (c->path - b->path);
    const double bend = (bc - ab) / (c->path - a->path);
    if (!(bend > 0) || fmax(fa, fmax(fb, fc)) < alike)
        return NAN;
    const double at = (a->path + b->path) / 2 - ab / (2 * bend);
    const double least = fa + ab * (at - a->path) + bend * (at - a->path) * (at - b->path);
    return at > a->path && at < c->path && least < 0.1 * fmin(fa, fmin(fb, fc)) ? at : NAN;
}

static status look_between(search *s, station a, station b, station c, int i, fault *f)
{
    for (int trials = 0; trials < MAX_TRIALS; trials++) {
        const double at = vertex(&a, &b, &c, i), span = c.path - a.path;
        station m;
        if (isnan(at) || fabs(at - b.path) < 1e-6 * span || at - a.path < 1e-6 * span ||
            c.path - at < 1e-6 * span)
            return STATUS_OK;
        TRY(look(s, at, &m, f));
        if (m.kind != FLUTTER_NONE) {
            s->next = m;
            return STATUS_OK;
        }
        if (at < b.path && difference(&m, i) < difference(&b, i)) {
            c = b;
            b = m;
        } else if (at < b.path) {
            a = m;
        } else if (difference(&m, i) < difference(&b, i)) {
            a = b;
            b = m;
        } else {
            c = m;
        }
    }
    return STATUS_OK;
}

static status is_lost(const search *s, const char *why, fault *f)
{
    return fault_set(f, STATUS_NOT_CONVERGED, "no critical load from path 0 to %g; beyond this, %s",
                     s->last.path, why);
}

static status confirm(search *s, fault *f)
{
    station again;
    TRY(look_closely(s, s->next.path, 1, &again, f));
    return again.kind != FLUTTER_NONE
               ? STATUS_OK
               : is_lost(
                     s,
                     "growing modes are lost in the round-off of the tangent; use fewer elements",
                     f);
}

/* Advances from the stored state, which belongs to `last`, to the first unstable station
 * s->next. */
static status walk(search *s, fault *f)
{
    double step = first_step * s->size, end = farthest * s->size;
    const double lowest = s->last.count > 0 ? s->last.square[0] : 0;
    double failed = INFINITY; /* smallest path parameter without an equilibrium */
    int stations = 0;
    for (int trials = 0; trials < MAX_STATIONS; trials++) {
        const double path = s->last.path + step;
        if (path > end && stations > COMPARED_MOTIONS)
            break;
        const status outcome = look(s, path, &s->next, f);
        if (outcome == STATUS_FAULT)
            return outcome;
        const double changed = outcome == STATUS_OK ? change(&s->last, &s->next, lowest) : INFINITY;
        if (outcome != STATUS_OK || (s->next.kind == FLUTTER_NONE && changed > largest_change)) {
            failed = outcome != STATUS_OK ? fmin(failed, path) : failed;
            if (failed - s->last.path < near_lost * failed)
                return is_lost(s, f->text, f);
            if (step < 1e-6 * fmax(fabs(path), 1e-9 * s->size))
                return outcome != STATUS_OK ? outcome
                                            : fault_set(f, STATUS_NOT_CONVERGED,
                                                        "frequencies jump at path %g", path);
            step /= 4;
            continue;
        }
        if (s->next.kind != FLUTTER_NONE)
            return confirm(s, f);
        if (s->next.count < s->last.count)
            return is_lost(
                s, "slow modes are lost in the round-off of the tangent; use fewer elements", f);
        const station c = s->next;
        for (int i = 0; stations > 0 && !s->of.massless && !s->of.damped &&
                        i + 1 < COMPARED_MOTIONS + 2 && i + 1 < c.count;
             i++) {
            TRY(look_between(s, s->before, s->last, c, i, f));
            if (s->next.kind != FLUTTER_NONE && s->next.path < s->last.path) {
                TRY(look(s, s->before.path, &s->last, f));
                keep(s, &s->last);
            }
            if (s->next.kind != FLUTTER_NONE)
                return confirm(s, f);
        }
        if (kinematics_state_path(s->n->state) != path)
            TRY(look(s, path, &s->next, f));
        keep(s, &s->next);
        if (stations++ == 0)
            end = fmax(end, farther * path / changed);
        step *= fmin(fastest_growth, wanted_change / changed);
    }
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "no critical load from path 0 to %g, because there is no divergence%s",
                     s->last.path,
                     s->of.massless ? ", and flutter requires mass; add a density to a section"
                                    : " and no flutter");
}

/* Returns the zero of the measure, extrapolated from the unstable stations p[0] < p[1] < ... */
static double extrapolate(int points, const double p[], const double g[])
{
    const double slope = (p[0] - p[1]) / (g[0] - g[1]), line = p[0] - g[0] * slope;
    if (points < 3)
        return line;
    const double bend = ((p[1] - p[2]) / (g[1] - g[2]) - slope) / (g[2] - g[0]);
    return line + g[0] * g[1] * bend;
}

static status close_in(search *s, flutter_point *out, fault *f)
{
    double p[POINTS] = {0}, g[POINTS] = {0}, low = s->last.path, estimate = NAN, apart = INFINITY;
    station high = s->next;
    int points = 0;
    for (int i = 0; i < MAX_CLOSER; i++) {
        const int is_coarse = high.path - low > coarse_interval * fabs(high.path);
        if (!is_coarse && (points == 0 || high.path < p[0])) {
            memmove(p + 1, p, (POINTS - 1) * sizeof *p);
            memmove(g + 1, g, (POINTS - 1) * sizeof *g);
            p[0] = high.path;
            g[0] = high.measure;
            points += points < POINTS;
        }
        double target = (low + high.path) / 2;
        if (points > 1 && g[1] > g[0]) {
            const double last = estimate, found = extrapolate(points, p, g);
            estimate = fmin(fmax(found, low), high.path);
            apart = fabs(estimate - last);
            if (apart <= wanted_error * fabs(estimate) ||
                high.path - estimate <=
                    (high.kind == FLUTTER_DIVERGES ? near_divergence : closest) * fabs(high.path))
                break;
            target = estimate + closer * (high.path - estimate);
        }
        station m;
        const status outcome = look(s, target, &m, f);
        if (outcome == STATUS_SINGULAR) { /* the station is at a divergence */
            estimate = target;
            apart = 0;
            break;
        }
        TRY(outcome);
        if (m.kind == FLUTTER_NONE) {
            low = target;
            keep(s, &m);
        } else {
            points = m.kind == high.kind ? points : 0;
            high = m;
        }
    }
    if (isnan(estimate))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "the critical load was not found; it is between path %g and %g", low,
                         high.path);
    out->path = estimate;
    out->error = apart / fabs(estimate);
    out->frequency = high.kind == FLUTTER_OSCILLATES ? high.frequency : 0;
    if (s->found.mode == NULL || high.kind == FLUTTER_NONE)
        return STATUS_OK;
    const size_t n = (size_t)s->found.n;
    out->mode = calloc(n + 1, sizeof *out->mode);
    if (out->mode == NULL)
        return fault_memory(f, "critical loads");
    memcpy(out->mode, s->found.mode + (size_t)s->mode * n, n * sizeof *out->mode);
    return STATUS_OK;
}

static status run(search *s, flutter_point *out, fault *f)
{
    newton_run *n = s->n;
    step_record unused = {0};
    TRY(kinematics_state_alloc(n->c->model, &s->kept, f));
    kinematics_state_copy(n->c->model, kinematics_rest(n->c->model), n->state);
    TRY(newton_to(n, 0, &unused, f));
    TRY(newton_direction(n, 0, &unused, f));
    TRY(flutter_system_alloc(n, &s->of, f));
    kinematics_state_copy(n->c->model, n->state, s->kept);
    TRY(look(s, 0, &s->last, f));
    if (s->last.kind != FLUTTER_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "critical loads require a stable state, but that at path 0 is not stable: "
                         "%s; reduce the loads at path 0",
                         flutter_name(&s->of, s->last.kind));
    TRY(walk(s, f));
    return close_in(s, out, f);
}

status flutter_search(newton_run *n, double size, flutter_walk *walk_to, flutter_point *out,
                      fault *f)
{
    search s = {.n = n, .walk = walk_to, .size = size};
    memset(out, 0, sizeof *out);
    const status outcome = run(&s, out, f);
    if (outcome == STATUS_OK)
        out->what = flutter_name(&s.of, out->frequency > 0 ? FLUTTER_OSCILLATES : FLUTTER_DIVERGES);
    out->massless = s.of.massless;
    flutter_system_free(&s.of);
    kinematics_state_free(s.kept);
    unsymmetric_free(&s.found);
    return outcome;
}
