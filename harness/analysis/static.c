/* Nonlinear equilibrium along a path, with steps that adapt: by whether Newton succeeds, not by
 * what the tangent misses. Steps by that error are shorter than he needs, and cost more (measured
 * with errors from 0.2 to 2 rad or lengths on all cases of one station: 14 to 20 % more
 * iterations).
 */
#include "harness/analysis/static.h"

#include <math.h>

#include "harness/analysis/compliance_walk.h"
#include "harness/analysis/extract_path.h"
#include "harness/analysis/flutter_within.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { EASY_ITERATIONS = 6, MAX_HALVINGS = 14, SINGULAR_STARTS = 3 };

/* Whether what a step led to is stable, where pivots do not tell. *found: path within the step at
 * which stability is another than at its ends, or INFINITY; last_resort: the step cannot be
 * shorter. */
static status judge_step(newton_run *n, flutter_judge *judge, int last_resort, step_record *record,
                         double *found, fault *f)
{
    *found = INFINITY;
    if (judge == NULL)
        return STATUS_OK;
    if (!last_resort)
        TRY(within_step(judge, n->c, n->backup, n->state, found, f));
    return record->negative_pivots >= 0 || isfinite(*found)
               ? STATUS_OK
               : flutter_judge_state(judge, n->c, n->state, record, f);
}

/* The step is walked again in shorter ones. */
static void take_back(newton_run *n, const step_record *record)
{
    history_drop_step(n->c->result, record);
    kinematics_state_copy(n->c->model, n->backup, n->state);
    if (n->predictor != NULL)
        predictor_forget(n->predictor);
    n->c->run->counters.rejected_steps++;
}

static status walk_to(newton_run *n, double target, flutter_judge *judge, double *increment,
                      fault *f)
{
    counters *count = &n->c->run->counters;
    const double least = *increment / (1 << MAX_HALVINGS);
    int rejected = 0;
    while (kinematics_state_path(n->state) < target) {
        const double from = kinematics_state_path(n->state);
        const int last = from + *increment * (1 + 1e-9) >= target;
        const double to = last ? target : from + *increment;
        step_record record = {.path = to, .increment = to - from, .rejected = rejected};
        kinematics_state_copy(n->c->model, n->state, n->backup);
        if (n->predictor != NULL)
            predictor_guess(&n->c->eq, n->predictor, to, n->state);
        const status outcome = newton_to(n, to, &record, f);
        double found = INFINITY;
        if (outcome == STATUS_OK)
            TRY(judge_step(n, judge, to - from <= least, &record, &found, f));
        if (isfinite(found)) {
            take_back(n, &record);
            rejected++;
            *increment = found - from;
            continue;
        }
        if (outcome == STATUS_OK) {
            TRY(history_add_step(n->c->result, &record, f));
            count->steps++;
            count->negative_pivots = record.negative_pivots > count->negative_pivots
                                         ? record.negative_pivots
                                         : count->negative_pivots;
            if (n->predictor != NULL)
                TRY(predictor_add(&n->c->eq, n->state, record.iterations, n->predictor, f));
            if (record.iterations <= EASY_ITERATIONS && rejected == 0 &&
                to - from >= *increment * (1 - 1e-9))
                *increment *= 2;
            rejected = 0;
            continue;
        }
        /* Shorter steps meet the same matrix, but for the stiffness of the loads. */
        const int hopeless =
            outcome == STATUS_SINGULAR && record.iterations == 0 && rejected >= SINGULAR_STARTS;
        if (outcome == STATUS_FAULT || outcome == STATUS_REFUSED || to - from <= least ||
            hopeless) {
            history_drop_step(n->c->result, &record);
            return outcome;
        }
        take_back(n, &record);
        rejected++;
        *increment = (to - from) / 2;
    }
    return STATUS_OK;
}

status static_walk(newton_run *n, double target, double *increment, fault *f)
{
    return walk_to(n, target, NULL, increment, f);
}

/* Iterations from the undeformed state, for their time; nothing moves, so that the next one is the
 * same. */
static status sample(newton_run *n, double path, fault *f)
{
    step_record record = {.path = path};
    for (int i = 0; i < n->c->options->sample; i++)
        TRY(newton_direction(n, path, &record, f));
    return STATUS_OK;
}

/* Steps to every station, whose states are kept: none is shorter than before without need. */
static status walk(newton_run *n, int analysis, flutter_judge *judge, compliance_walk *on_the_way,
                   outcome_path *o, fault *f)
{
    analysis_context *c = n->c;
    const scene_walk *a = scene_walk_of(&c->scene->analysis[analysis]);
    const int between =
        c->options->steps_between > 0 ? c->options->steps_between : a->steps_between;
    const int steps = between > 0 ? between : 1;
    double increment = 0;
    for (int i = 0; i < a->path.stations; i++) {
        const double from = i > 0 ? a->path.value[i - 1] : 0;
        increment = fmax(increment, (a->path.value[i] - from) / steps);
        TRY(walk_to(n, a->path.value[i], judge, &increment, f));
        if (c->options->newton != NEWTON_DENSE && n->condensed == NULL)
            context_count_condition(c, n->factor, &n->K);
        TRY(compliance_walk_take(on_the_way, n, i, f));
        TRY(outcome_keep(o, c->model, n->state, extract_path_whole(c, analysis, i),
                         a->path.value[i], f));
    }
    return STATUS_OK;
}

/* With what static_analysis frees. */
static status solve(analysis_context *c, int analysis, newton_run *n, predictor *t,
                    flutter_judge *judge, compliance_walk **on_the_way, outcome_path *o, fault *f)
{
    const scene_walk *a = scene_walk_of(&c->scene->analysis[analysis]);
    TRY(newton_alloc(c, 1, n, f));
    TRY(predictor_alloc(c->model, t, f));
    n->predictor = t;
    TRY(outcome_stations(o, a->path.stations, f));
    if (c->options->sample > 0)
        return sample(n, a->path.value[0], f);
    TRY(compliance_walk_begin(n, analysis, on_the_way, f));
    return walk(n, analysis, judge, *on_the_way, o, f);
}

status static_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    newton_run n;
    predictor t = {0};
    compliance_walk *on_the_way = NULL;
    flutter_judge judge = {0};
    const scene_analysis *a = &c->scene->analysis[analysis];
    const int looks = c->options->looks && a->kind != SCENE_ROTATION && !scene_rotates(a);
    const status result =
        solve(c, analysis, &n, &t, looks ? &judge : NULL, &on_the_way, outcome_walk(o), f);
    flutter_judge_free(&judge);
    compliance_walk_end(on_the_way);
    predictor_free(&t);
    newton_free(&n);
    return result;
}
