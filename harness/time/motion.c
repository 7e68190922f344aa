#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/numerics/numerics.h"

enum { MAX_HALVINGS = 12, MAX_PASSES = 8 };

/* bounds of the ratio of consecutive step sizes, and safety factor for the error estimate */
static const double shorter = 0.3, longer = 2, safety = 0.9;

/* A remainder before a discontinuity or before the end that is shorter than `least_rest`, relative
 * to the step size, is added to the last step. The sum of the last step and a remainder that is
 * shorter than `short_rest` is divided into two equal steps. */
static const double least_rest = 1e-6, short_rest = 1e-3;

typedef struct motion_course {
    analysis_context *c;
    const scene_motion *how;
    int analysis, follows;
    double path; /* path parameter of the static state from which the motion starts; NAN: none */
    /* end of the previous motion, which this motion continues; NULL: none */
    const outcome_end *from;
    frame_masses masses;
    run_damping damping;
    outer_work work;
    motion_scheme *scheme;
    motion_state now, next;
    double h, least; /* [s] size of the next step, and smallest step size */
    /* [s] exact time minus now.time; without it, the rounding error of now.time would grow with
     * each step */
    double rest;
    stations stations;
    observers observers;
    extrema extrema;
    frames frames;
    abouts abouts;
    outcome_motion *out;
    double balance[SCENE_BALANCES], ahead[SCENE_BALANCES];
    int looked_ahead; /* 1: `ahead` is valid */
    account account;
    extent extent, reaches; /* extent so far, and extent with the trial step */
    double rounding;        /* [J] rounding error of the energy */
    int quiet;
    int unchecked;
} motion_course;

static status balance_at(motion_course *w, const motion_state *at, double balance[SCENE_BALANCES],
                         fault *f)
{
    TRY(balance_of(&w->c->eq, &w->masses, at, balance, f));
    if (w->out->steps == 0 && w->from == NULL)
        w->out->origin = balance[SCENE_ENERGY];
    balance[SCENE_DRIFT] -= w->out->origin;
    return STATUS_OK;
}

static status record_step(motion_course *w, const step_record *record, double error, fault *f)
{
    outcome_step one = {.time = w->now.time,
                        .step = record->increment,
                        .error = error,
                        .iterations = record->iterations,
                        .rejected = record->rejected};
    if (w->looked_ahead)
        memcpy(w->balance, w->ahead, sizeof w->balance);
    else
        TRY(balance_at(w, &w->now, w->balance, f));
    w->looked_ahead = 0;
    account_take(&w->account, w->out->steps, w->balance);
    w->quiet += w->out->steps > 0 || w->from == NULL;
    memcpy(one.balance, w->balance, sizeof one.balance);
    return memory_append(&w->out->step, &w->out->steps, &one, sizeof one, "steps of a motion", f);
}

static status keep_step(motion_course *w, const step_record *record, double error, int last,
                        fault *f)
{
    TRY(history_add_step(w->c->result, record, f));
    w->c->run->counters.steps++;
    TRY(stations_inside(&w->stations, &w->now, &w->next, f));
    TRY(observers_step(&w->observers, &w->now, &w->next, f));
    TRY(frames_step(&w->frames, w->scheme->degree, &w->now, &w->next, f));
    TRY(abouts_inside(&w->abouts, &w->now, &w->next, f));
    motion_state_copy(w->c->model, &w->next, &w->now);
    w->extent = w->reaches;
    TRY(record_step(w, record, error, f));
    return extrema_here(&w->extrema, &w->now, w->balance, last, f);
}

/* Returns the end [s] of the last motion in the chain of continued motions. */
static double end_of_all(const motion_course *w)
{
    const scene *s = w->c->scene;
    int last = w->analysis;
    for (int i = last + 1; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION && s->analysis[i].follows == last)
            last = i;
    const scene_path *path = scene_path_of(&s->analysis[last]);
    return path->value[path->stations - 1];
}

/* Returns 1 if the error of the step is allowed. If the errors of steps add up to the error of the
 * motion, the allowed error of a step is proportional to its size. */
static int allowed(motion_course *w, double step, double error)
{
    w->reaches = extent_with(&w->extent, w->c->model, w->scheme, &w->now, &w->next, step, error);
    if (w->how->tolerance <= 0)
        return 1;
    const double part = w->scheme->adds ? step / end_of_all(w) : 1,
                 most = extent_allows(&w->reaches, part, w->how->tolerance),
                 order = w->scheme->order - w->scheme->adds,
                 of = extent_error(&w->reaches, w->scheme, step, error),
                 ratio = safety * pow(most / larger(of, 1e-300), 1 / order);
    w->h = step * fmin(longer, fmax(shorter, ratio));
    w->reaches.worst = fmax(w->reaches.worst, of / part);
    return of <= most;
}

static int checks_flutter(const motion_course *w)
{
    return w->how->tolerance > 0 && !model_absolute(w->c->model) &&
           (w->how->scheme != SCENE_ALPHA || w->quiet >= ACCOUNT_STEPS);
}

/* Checks for an unexplained gain of energy, for example because of unresolved modes; shorter steps
 * reduce it. *grows: 1 if the gain in this step, or in this and previous steps, is larger than
 * allowed. */
static status check_growth(motion_course *w, int *grows, fault *f)
{
    *grows = 0;
    if (!checks_flutter(w))
        return STATUS_OK;
    TRY(balance_at(w, &w->next, w->ahead, f));
    w->looked_ahead = 1;
    account ahead = w->account;
    account_take(&ahead, w->out->steps, w->ahead);
    const double most = account_most(&ahead, account_gained, w->rounding),
                 drift = w->ahead[SCENE_DRIFT], gain = drift - w->balance[SCENE_DRIFT];
    *grows = gain > most || (gain > 0 && drift > most);
    return STATUS_OK;
}

static void lengthen(motion_course *w, double step, double whole, int rejected)
{
    if (w->how->tolerance > 0 && step < whole)
        w->h = fmax(w->h, whole);
    if (w->how->tolerance <= 0 && rejected == 0)
        w->h = fmin(w->how->step, 2 * w->h);
}

static status take_step(motion_course *w, double target, fault *f)
{
    for (int rejected = 0;; rejected++) {
        const double left = target - w->now.time - w->rest, whole = w->h;
        const int last = left <= whole * (1 + least_rest);
        const double step = last ? left : left < whole * (1 + short_rest) ? left / 2 : whole;
        step_record record = {.path = last ? target : w->now.time + (step + w->rest),
                              .increment = step,
                              .rejected = rejected};
        double error = 0;
        int grows = 0;
        status outcome = w->scheme->step(w->scheme, &w->now, step, &w->next, &error, &record, f);
        int right = outcome == STATUS_OK && allowed(w, step, error);
        if (right)
            outcome = newton_accept(w->c->model, w->now.state, w->next.state, f);
        right &= outcome == STATUS_OK;
        if (right)
            outcome = check_growth(w, &grows, f);
        if (right && outcome == STATUS_OK && !grows) {
            lengthen(w, step, whole, rejected);
            w->rest = last ? 0 : w->now.time - record.path + (step + w->rest);
            w->next.time = record.path;
            return keep_step(w, &record, error, last, f);
        }
        history_drop_step(w->c->result, &record);
        w->looked_ahead = 0;
        if (outcome == STATUS_FAULT || outcome == STATUS_REFUSED)
            return outcome;
        if (outcome != STATUS_OK || grows)
            w->h = step / 2;
        if (w->h < w->least)
            return outcome != STATUS_OK
                       ? outcome
                       : fault_set(f, STATUS_NOT_CONVERGED,
                                   "at %g s no step is short enough for %s; give a larger "
                                   "tolerance, or use another integrator",
                                   w->now.time,
                                   grows ? "the energy to be conserved" : "the tolerance");
        w->c->run->counters.rejected_steps++;
    }
}

static status jump(motion_course *w, fault *f)
{
    TRY(consistent_restart(w->c, &w->masses, w->how, &w->now, &w->next, f));
    extrema_jump(&w->extrema);
    return extrema_here(&w->extrema, &w->now, w->balance, 0, f);
}

static status check_balance(motion_course *w, double end, fault *f)
{
    if (w->quiet <= ACCOUNT_STEPS && w->unchecked < 2 * ACCOUNT_STEPS && w->now.time < end) {
        w->unchecked++;
        return STATUS_OK;
    }
    w->unchecked = 0;
    if (model_absolute(w->c->model))
        return STATUS_OK;
    return account_check(&w->account, w->how, w->now.time, w->balance, w->rounding, f);
}

static status integrate(motion_course *w, fault *f)
{
    const scene_path *path = &w->how->path;
    const double end = path->value[path->stations - 1];
    w->least = w->how->step / (w->c->options->whole_steps ? 1 : 1 << MAX_HALVINGS);
    TRY(stations_here(&w->stations, &w->now, w->balance, f));
    TRY(frames_begin(&w->frames, &w->now, f));
    TRY(abouts_here(&w->abouts, &w->now, f));
    while (w->now.time < end) {
        const double kink = discontinuities_next(w->c->model, w->now.time);
        TRY(stop_check(f));
        TRY(take_step(w, fmin(end, kink), f));
        TRY(check_balance(w, end, f));
        w->quiet *= w->now.time != kink;
        if (w->now.time == kink)
            TRY(jump(w, f));
        TRY(stations_here(&w->stations, &w->now, w->balance, f));
        TRY(abouts_here(&w->abouts, &w->now, f));
    }
    return resume_keep(w->c, w->analysis, &w->now,
                       &(resume_control){w->h, w->account, w->out->origin, w->quiet, w->extent},
                       w->out, f);
}

static status go_on(motion_course *w, fault *f)
{
    const scene_motion *former = w->from->analysis == w->analysis
                                     ? w->how
                                     : scene_motion_of(&w->c->scene->analysis[w->from->analysis]);
    resume_control control = {.extent = w->extent};
    TRY(resume_take(w->c, w->from, &w->now, &control, f));
    w->out->origin = control.origin;
    if (former->step == w->how->step && former->tolerance == w->how->tolerance)
        w->h = control.step;
    w->account = control.account;
    w->quiet = control.quiet;
    w->extent = control.extent;
    return former->scheme != w->how->scheme
               ? consistent_restart(w->c, &w->masses, w->how, &w->now, &w->next, f)
               : STATUS_OK;
}

static status find_end(motion_course *w, fault *f)
{
    w->from = resume_given(w->c, w->analysis);
    if (w->from != NULL || w->follows == SCENE_NONE ||
        w->c->scene->analysis[w->follows].kind != SCENE_MOTION)
        return STATUS_OK;
    return resume_before(w->c, w->follows, &w->from, f);
}

static status begin(motion_course *w, scene_rotating_frame *frame, fault *f)
{
    const int follows = w->follows;
    memset(frame, 0, sizeof *frame);
    w->h = w->how->step;
    TRY(find_end(w, f));
    if (w->from != NULL)
        return go_on(w, f);
    if (follows == SCENE_NONE)
        return linearise_make_compatible(&w->c->eq, w->now.state, f);
    const analysis_outcome *before = &w->c->outcomes[follows];
    const outcome_path *path = outcome_path_of(before);
    if (before->status != STATUS_OK || path->reached < path->stations)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "the initial state of the motion was not reached: %s", before->reason);
    kinematics_state_copy(w->c->model, path->state[path->reached - 1], w->now.state);
    w->path = kinematics_state_path(w->now.state);
    const scene_analysis *of = &w->c->scene->analysis[follows];
    const double speed = of->kind == SCENE_ROTATION ? path->value[path->reached - 1] : 1;
    if (scene_rotating_frame_of(of) != NULL)
        *frame = *scene_rotating_frame_of(of);
    for (int i = 0; i < 3; i++)
        frame->omega[i] *= speed;
    return STATUS_OK;
}

static status solve(motion_course *w, fault *f)
{
    const step_record start = {.increment = 0};
    scene_rotating_frame frame;
    const model *m = w->c->model;
    TRY(model_spreads(m, w->analysis) ? frame_masses_alloc_bodies(m, &w->masses, f)
                                      : frame_masses_alloc(m, &w->masses, f));
    w->masses.damping = w->c->scene->analysis[w->analysis].damping.mass;
    TRY(damping_begin(&w->c->eq, &w->damping, f));
    TRY(feedback_begin(&w->c->eq, f));
    TRY(work_alloc(&w->c->eq, &w->masses, &w->work, f));
    const scheme_request request = {w->c, &w->masses, w->how, &w->work, w->how->tolerance > 0};
    w->rounding = balance_rounding(m);
    TRY(integrator_alloc(&request, &w->scheme, f));
    TRY(motion_state_alloc(m, &w->now, f));
    TRY(motion_state_alloc(m, &w->next, f));
    TRY(kinematics_state_alloc(m, &w->extent.begin, f));
    w->stations = (stations){.c = w->c,
                             .analysis = w->analysis,
                             .masses = &w->masses,
                             .scheme = w->scheme,
                             .out = w->out};
    w->observers = (observers){.c = w->c,
                               .analysis = w->analysis,
                               .scheme = w->scheme,
                               .masses = &w->masses,
                               .out = w->out};
    TRY(stations_alloc(&w->stations, f));
    TRY(observers_alloc(&w->observers, f));
    w->extrema = (extrema){.c = w->c,
                           .analysis = w->analysis,
                           .scheme = w->scheme,
                           .masses = &w->masses,
                           .out = w->out};
    TRY(extrema_alloc(&w->extrema, f));
    w->abouts = (abouts){.c = w->c,
                         .analysis = w->analysis,
                         .masses = &w->masses,
                         .how = w->how,
                         .scheme = w->scheme,
                         .out = w->out};
    TRY(abouts_alloc(&w->abouts, f));
    TRY(begin(w, &frame, f));
    w->frames = (frames){.eq = &w->c->eq,
                         .m = m,
                         .to = &w->out->frames,
                         .begin = w->now.time,
                         .end = w->how->path.value[w->how->path.stations - 1]};
    TRY(frames_alloc(&w->frames, shapes_frames(w->c->options->shapes), f));
    TRY(checks_massless(w->c, &w->masses, w->how, w->now.state, f));
    TRY(massless_readings(m, &w->masses, w->now.state, w->analysis, &w->out->undefined, f));
    if (w->from == NULL)
        kinematics_state_copy(m, w->now.state, w->extent.begin);
    extent_begin(&w->extent, m);
    if (w->from == NULL)
        TRY(initial_conditions_rotating(w->c, &w->masses, w->how, &frame, &w->now, &w->next, f));
    TRY(record_step(w, &start, 0, f));
    TRY(extrema_here(&w->extrema, &w->now, w->balance, 0, f));
    return integrate(w, f);
}

static void release(motion_course *w)
{
    motion_state_free(&w->now);
    motion_state_free(&w->next);
    kinematics_state_free(w->extent.begin);
    observers_end(&w->observers);
    extrema_end(&w->extrema);
    stations_free(&w->stations);
    observers_free(&w->observers);
    extrema_free(&w->extrema);
    abouts_free(&w->abouts);
    frames_free(&w->frames);
    integrator_free(w->scheme);
    frame_masses_free(&w->masses);
    work_free(&w->work);
    damping_end(&w->c->eq, &w->damping);
}

/* Integrates the motion once for a given estimate of its extent. *again: 1 if the motion is
 * smaller, so that the estimate must be reduced. */
static status run(analysis_context *c, int analysis, double *scale, int *again, analysis_outcome *o,
                  fault *f)
{
    const history_mark begin = history_here(c->result);
    const counters before = c->run->counters;
    motion_course w;
    memset(&w, 0, sizeof w);
    w.c = c;
    w.path = NAN;
    w.how = scene_motion_of(&c->scene->analysis[analysis]);
    w.analysis = analysis;
    w.follows = c->scene->analysis[analysis].follows;
    w.out = outcome_motion_in(o);
    w.extent.scale = *scale;
    status result = solve(&w, f);
    const int has_run = result == STATUS_OK || result == STATUS_NOT_CONVERGED;
    *again = has_run && w.how->tolerance > 0 && w.out->steps > 1 &&
             extent_is_less(&w.extent, w.how->tolerance, scale);
    if (result != STATUS_FAULT && !*again &&
        history_add_motion(c->result, analysis, w.path, w.out, f) != STATUS_OK)
        result = STATUS_FAULT;
    release(&w);
    if (*again) {
        history_go_back(c->result, &begin);
        c->run->counters.steps = before.steps;
        c->run->counters.rejected_steps = before.rejected_steps;
    }
    return result;
}

status motion_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    double scale = extent_guess;
    for (int pass = 1;; pass++) {
        int again;
        const status result = run(c, analysis, &scale, &again, o, f);
        if (!again)
            return result;
        if (pass == MAX_PASSES)
            return fault_set(
                f, STATUS_NOT_CONVERGED,
                "the size of the displacements is still unknown after %d integrations; give a step",
                pass);
        outcome_free(o);
        *o = (analysis_outcome){.kind = SCENE_MOTION};
    }
}

status frames_alloc(frames *p, int count, fault *f)
{
    TRY(dense_output_alloc(p->eq, &p->inside, f));
    TRY(motion_state_alloc(p->m, &p->at, f));
    return outcome_stations(p->to, count, f);
}

void frames_free(frames *p)
{
    dense_output_free(&p->inside);
    motion_state_free(&p->at);
}

static double next_of(const frames *p)
{
    const int next = p->to->reached, last = p->to->stations - 1;
    if (next > last)
        return INFINITY;
    return next == last ? p->end : p->begin + next * (p->end - p->begin) / last;
}

status frames_begin(frames *p, const motion_state *now, fault *f)
{
    return p->to->stations > 0 ? outcome_keep(p->to, p->m, now->state, 1, now->time, f) : STATUS_OK;
}

status frames_step(frames *p, dense_output_degree degree, const motion_state *from,
                   const motion_state *to, fault *f)
{
    if (next_of(p) <= to->time)
        dense_output_set(&p->inside, degree, from, to);
    while (next_of(p) <= to->time) {
        const double time = next_of(p);
        const model_state *state = to->state;
        if (time < to->time) {
            dense_output_at(&p->inside, time, &p->at);
            state = p->at.state;
        }
        TRY(outcome_keep(p->to, p->m, state, 1, time, f));
    }
    return STATUS_OK;
}
