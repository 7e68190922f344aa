#include "harness/time/time_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics.h"

enum { PIECES = MEANS_NODES - 1, MOST_HALVINGS = 200 };

/* largest value, relative to the size of the quantity, that counts as zero */
static const double no_sign = 1e-13,
                    /* largest force or energy, relative to its largest magnitude so far, that
                     * counts as zero */
    no_sign_aside = 1e-9,
                    /* The sign changes at a jump, not at zero, if the value at the root exceeds
                     * this fraction of the values around it. For example, a rotation vector
                     * reverses its direction at half a revolution. */
    a_jump = 1e-3;

static void begin(observers *s, observer *one, const scene_quantity *q)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    const double end = path->value[path->stations - 1];
    *one = (observer){.q = q,
                      .out = &s->out->passing[q - s->c->scene->quantity],
                      .from = q->passing.from,
                      .until = q->passing.until > 0 ? fmin(q->passing.until, end) : end,
                      .by_probe = !reading_is_kinematic(q),
                      .noise = no_sign * fmax(1, model_length(s->c->model))};
    s->by_probe |= one->by_probe;
}

static int is_observed(const observers *s, const scene_quantity *q)
{
    return q->analysis == s->analysis && scene_is_passed(q, SCENE_MOTION) &&
           (reading_is_kinematic(q) || !scene_is_extreme(q->reduction));
}

status observers_alloc(observers *s, fault *f)
{
    const scene *what = s->c->scene;
    TRY(dense_output_alloc(&s->c->eq, &s->inside, f));
    TRY(motion_state_alloc(s->c->model, &s->at, f));
    s->one = calloc((size_t)what->quantities + 1, sizeof *s->one);
    s->out->passing = calloc((size_t)what->quantities + 1, sizeof *s->out->passing);
    if (s->one == NULL || s->out->passing == NULL)
        return fault_memory(f, "the states of a motion");
    for (int i = 0; i < what->quantities; i++)
        if (is_observed(s, &what->quantity[i]))
            begin(s, &s->one[s->count++], &what->quantity[i]);
    s->probe_steps =
        (probe_steps){.c = s->c, .scheme = s->scheme, .masses = s->masses, .out = s->out};
    return s->by_probe ? probe_steps_alloc(&s->probe_steps, f) : STATUS_OK;
}

void observers_free(observers *s)
{
    free(s->one);
    dense_output_free(&s->inside);
    motion_state_free(&s->at);
    if (s->by_probe)
        probe_steps_free(&s->probe_steps);
}

/* Returns the slope of a quantity at a time. The slope is exact if the quantity is a polynomial of
 * fourth degree in the step. */
static double slope_at(observers *s, const observer *one, double time)
{
    const double d = (s->inside.to->time - s->inside.from->time) / 64;
    return (8 * (observer_value(s, one, time + d) - observer_value(s, one, time - d)) -
            (observer_value(s, one, time + 2 * d) - observer_value(s, one, time - 2 * d))) /
           (12 * d);
}

typedef double along(observers *, const observer *, double time);

static double above_level(observers *s, const observer *one, double time)
{
    return observer_value(s, one, time) - one->q->passing.level;
}

/* Returns the root between a and b, where the values fa and fb of f have opposite signs. Uses
 * secant steps, and bisection in every third iteration. */
static double root(observers *s, const observer *one, along *f, double a, double fa, double b,
                   double fb)
{
    const double least = one->by_probe ? 1e-10 * (s->inside.to->time - s->inside.from->time) : 0,
                 zero = one->by_probe ? one->noise / 10 : 0;
    double last = a - 1;
    for (int i = 0; i < MOST_HALVINGS && fabs(fa) > zero && fabs(fb) > zero; i++) {
        const double width = b - a, secant = b - fb * width / (fb - fa);
        const double inside = 1e-3 * width;
        const double x = i % 3 == 2 ? a + width / 2 : fmin(fmax(secant, a + inside), b - inside);
        if (width <= fmax(least, 2 * DBL_EPSILON * fmax(fabs(a), fabs(b))) || x <= a || x >= b ||
            fabs(x - last) < least)
            break;
        last = x;
        const double fx = f(s, one, x);
        if ((fx < 0) == (fa < 0)) {
            a = x;
            fa = fx;
        } else {
            b = x;
            fb = fx;
        }
    }
    return fabs(fa) < fabs(fb) ? a : b;
}

static status crossed(observers *s, observer *one, const motion_state *from, double time, fault *f)
{
    double error = 0;
    TRY(observer_disagreement(s, one, from, time, &error, f));
    error += one->blur;
    const double slope = fabs(slope_at(s, one, time));
    error = slope > 0 ? error / slope : 0;
    if (one->q->reduction == SCENE_CROSSING && one->crossings == one->q->passing.order)
        *one->out = (outcome_passing){1, time, time, error};
    if (one->crossings == 0) {
        one->first = time;
        one->error = error;
    }
    one->last = time;
    if (++one->crossings > 1) {
        const double span = time - one->first, period = span / (one->crossings - 1),
                     add_error = (one->error + error) / span;
        if (one->q->reduction == SCENE_PERIOD)
            *one->out = (outcome_passing){1, period, time, add_error * period};
        if (one->q->reduction == SCENE_PER_SECOND)
            *one->out = (outcome_passing){1, 1 / period, time, add_error / period};
    }
    return STATUS_OK;
}

/* Returns 1 if a crossing towards this side of the level is counted; side 1: above, -1: below. */
static int counts(const observer *one, int side)
{
    const scene_direction way = one->q->passing.direction;
    return way == SCENE_EITHER || side == (way == SCENE_RISING ? 1 : -1);
}

static int turns_back(const observer *one)
{
    return !one->by_probe && one->q->what.kind != SCENE_RATE;
}

static status observe_level(observers *s, observer *one, const motion_state *from, const double t[],
                            const double value[], fault *f)
{
    for (int i = 0; i <= PIECES; i++) {
        const double now = value[i] - one->q->passing.level;
        const int side = (now > one->noise) - (now < -one->noise);
        if (side == 0 || side == one->side)
            continue;
        const int was = one->side;
        one->side = side;
        if (was == 0 || !counts(one, side))
            continue;
        const double before = i > 0 ? value[i - 1] - one->q->passing.level : now;
        const double time = (before < 0) != (now < 0)
                                ? root(s, one, above_level, t[i - 1], before, t[i], now)
                                : t[i > 0 ? i - 1 : 0];
        const int jumps =
            turns_back(one) &&
            fabs(above_level(s, one, time)) > a_jump * fmax(fabs(before), fabs(now)) + one->noise;
        if (!jumps && time >= one->from && time <= one->until)
            TRY(crossed(s, one, from, time, f));
    }
    return STATUS_OK;
}

static void take_extreme(observer *one, double sign, double value, double time, double error)
{
    if (!one->out->known || sign * value > sign * one->out->value)
        *one->out = (outcome_passing){1, value, time, fmax(error, one->blur)};
}

static status observe_extreme(observers *s, observer *one, const motion_state *from, double sign,
                              const double t[], const double value[], fault *f)
{
    double most = -INFINITY, least = INFINITY;
    for (int i = 0; i <= PIECES; i++) {
        most = fmax(most, sign * value[i]);
        least = fmin(least, sign * value[i]);
    }
    const int cannot_converge =
        one->out->known && most + (most - least) / 2 < sign * one->out->value;
    take_extreme(one, sign, value[0], t[0], 0);
    take_extreme(one, sign, value[PIECES], t[PIECES], 0);
    double before = cannot_converge ? 0 : sign * slope_at(s, one, t[0]);
    for (int i = 0; i < PIECES && !cannot_converge; i++) {
        const double now = sign * slope_at(s, one, t[i + 1]);
        if (before > 0 && now < 0) {
            const double time = root(s, one, slope_at, t[i], sign * before, t[i + 1], sign * now);
            const double there = observer_value(s, one, time);
            double error = 0;
            if (!one->out->known || sign * there > sign * one->out->value)
                TRY(observer_disagreement(s, one, from, time, &error, f));
            take_extreme(one, sign, there, time, error);
        }
        before = now;
    }
    return STATUS_OK;
}

static void lose(observer *one)
{
    one->out->known = one->by_probe ? PASSING_UNSOLVED : PASSING_LOST;
}

/* Returns a bound on the rounding error of a reaction, a resultant or an energy; 0 for other
 * quantities. */
static double rounding_of(const observers *s, const observer *one)
{
    const scene_quantity_kind kind = one->q->what.kind;
    if (kind == SCENE_BALANCE)
        return balance_rounding(s->c->model);
    return kind == SCENE_REACTION || kind == SCENE_INTERNAL ? 1e-12 * s->inside.to->stress : 0;
}

static status observe_step(observers *s, observer *one, const motion_state *from, fault *f)
{
    const double a = fmax(from->time, one->from), b = fmin(s->inside.to->time, one->until);
    double t[PIECES + 1], value[PIECES + 1];
    if (!(b > a))
        return STATUS_OK;
    if (one->out->known > 1)
        return STATUS_OK;
    one->blur = reading_rounding(s->c->model, one->q, s->inside.to->state,
                                 s->inside.to->time - s->inside.from->time);
    if (one->q->reduction >= SCENE_MEAN) {
        TRY(means_add(s, one, from, a, b, f));
        if (isnan(one->sum))
            lose(one);
        return STATUS_OK;
    }
    for (int i = 0; i <= PIECES; i++) {
        t[i] = one->by_probe ? means_node(a, b, i) : i == PIECES ? b : a + i * (b - a) / PIECES;
        value[i] = observer_value(s, one, t[i]);
        if (isnan(value[i])) {
            lose(one);
            return STATUS_OK;
        }
        one->largest = fmax(one->largest, fabs(value[i]));
    }
    if (one->by_probe)
        one->noise = fmax(no_sign_aside * one->largest, rounding_of(s, one));
    if (one->q->reduction >= SCENE_CROSSING)
        return observe_level(s, one, from, t, value, f);
    return observe_extreme(s, one, from, scene_extreme_sign(one->q), t, value, f);
}

status observers_step(observers *s, const motion_state *from, const motion_state *to, fault *f)
{
    if (s->count == 0)
        return STATUS_OK;
    dense_output_set(&s->inside, s->scheme->degree, from, to);
    probe_steps_set(&s->probe_steps, from, to);
    for (int i = 0; i < s->count; i++)
        TRY(observe_step(s, &s->one[i], from, f));
    return s->probe_steps.outcome == STATUS_FAULT
               ? fault_set(f, STATUS_FAULT, "%s", s->probe_steps.why.text)
               : STATUS_OK;
}

void observers_end(observers *s)
{
    for (int i = 0; i < s->count; i++) {
        outcome_passing *out = s->one[i].out;
        const scene_reduction how = s->one[i].q->reduction;
        if (how == SCENE_MAX_TIME || how == SCENE_MIN_TIME)
            *out = (outcome_passing){out->known, out->time, out->time, 0};
    }
}

static int is_followed(const scene *s, int analysis)
{
    for (int i = analysis + 1; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION && s->analysis[i].follows == analysis)
            return 1;
    return 0;
}

static void measure(const model *m, const motion_state *now, outcome_end *out)
{
    out->between = (size_t)turns_between_count(m);
    out->states = now->state->size - 3 * out->between;
    out->coordinates = (size_t)model_all_coordinates(m);
    out->strains = now->strain != NULL ? (size_t)model_stresses(m) : 0;
    out->released = now->ends_known ? motion_state_ends(m) : 0;
}

enum { PARTS = 7 };
typedef struct part {
    double *of;
    size_t count;
} part;
static void parts_of(const motion_state *now, const extent *so_far, const outcome_end *e,
                     part out[PARTS])
{
    const part list[PARTS] = {{now->state->block, e->states},   {so_far->begin->block, e->states},
                              {now->v, e->coordinates},         {now->a, e->coordinates},
                              {now->algorithm, e->coordinates}, {now->strain, 2 * e->strains},
                              {now->ends, e->released}};
    memcpy(out, list, sizeof list);
}

static status copy(const model *m, int analysis, const motion_state *now,
                   const resume_control *control, outcome_end *out, fault *f)
{
    part of[PARTS];
    *out = (outcome_end){.analysis = analysis,
                         .time = now->time,
                         .path = now->state->path,
                         .step = control->step,
                         .work = now->work,
                         .dissipated = now->dissipated,
                         .largest = control->account.largest,
                         .turned = control->account.turned,
                         .scale = control->extent.scale,
                         .extent = control->extent.largest,
                         .rate = control->extent.rate,
                         .density = control->extent.density,
                         .origin = control->origin,
                         .stress = now->stress,
                         .contraction = now->contraction,
                         .quiet = control->quiet};
    measure(m, now, out);
    out->value = malloc((outcome_end_values(out) + 1) * sizeof *out->value);
    if (out->value == NULL)
        return fault_memory(f, "the final state of a motion");
    double *to = out->value;
    parts_of(now, &control->extent, out, of);
    for (int i = 0; i < PARTS; i++)
        if (of[i].count > 0) {
            memcpy(to, of[i].of, of[i].count * sizeof *to);
            to += of[i].count;
        }
    turns_put_between(m, now->state, to);
    return STATUS_OK;
}

status resume_keep(const analysis_context *c, int analysis, const motion_state *now,
                   const resume_control *control, outcome_motion *o, fault *f)
{
    outcome_end end;
    if (is_followed(c->scene, analysis))
        return copy(c->model, analysis, now, control, &o->end, f);
    if (!c->options->keep_ends)
        return STATUS_OK;
    TRY(copy(c->model, analysis, now, control, &end, f));
    const status kept =
        memory_append(&c->result->end, &c->result->ends, &end, sizeof end, "ends of motions", f);
    if (kept != STATUS_OK)
        outcome_end_free(&end);
    return kept;
}

const outcome_end *resume_given(const analysis_context *c, int analysis)
{
    for (int i = 0; i < c->options->restarts; i++)
        if (c->options->restart[i].analysis == analysis)
            return &c->options->restart[i];
    return NULL;
}

status resume_before(const analysis_context *c, int before, const outcome_end **out, fault *f)
{
    const analysis_outcome *all = &c->outcomes[before];
    *out = &outcome_motion_of(all)->end;
    if (all->status != STATUS_OK || (*out)->value == NULL)
        return fault_set(f, STATUS_NOT_CONVERGED, "the motion to be continued has failed: %s",
                         all->reason);
    return STATUS_OK;
}

status resume_take(const analysis_context *c, const outcome_end *e, motion_state *now,
                   resume_control *control, fault *f)
{
    outcome_end here;
    part of[PARTS];
    measure(c->model, now, &here);
    if (here.states != e->states || here.coordinates != e->coordinates ||
        here.strains != e->strains ||
        (e->released > 0 && e->released != motion_state_ends(c->model)))
        return fault_set(f, STATUS_REFUSED,
                         "the state of the motion to be continued has %zu numbers, but this mesh "
                         "requires %zu; use the same formulation and number of elements",
                         e->states, here.states);
    const double *from = e->value;
    parts_of(now, &control->extent, e, of);
    for (int i = 0; i < PARTS; i++)
        if (of[i].count > 0) {
            memcpy(of[i].of, from, of[i].count * sizeof *from);
            from += of[i].count;
        }
    turns_take_between(c->model, (int)e->between, from, now->state);
    now->ends_known = e->released > 0;
    now->state->path = e->path;
    now->time = e->time;
    now->work = e->work;
    now->dissipated = e->dissipated;
    now->stress = e->stress;
    now->contraction = e->contraction;
    *control =
        (resume_control){e->step,
                         {e->largest, e->turned, e->work},
                         e->origin,
                         e->quiet,
                         {control->extent.begin, 0, e->scale, e->extent, e->rate, e->density, 0}};
    return STATUS_OK;
}
