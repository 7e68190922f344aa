/* Search for a critical point, at which sigma(p) falls to zero along the path. sigma is the
 * smallest eigenvalue of the tangent K(p), scaled by the diagonal of the first K. Interpolation
 * uses stable states that approach this point. The error of an estimate is proportional to the
 * product of their distances from it. K is not extrapolated, because the rotation of a stiff
 * structure along the path would make it indefinite much earlier. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/scalar.h"
#include "harness/model/model.h"

enum { MAX_STATES = 60, POINTS = 3 };
static const double first_step = 0.1; /* first step, relative to the previous length of the path */
/* largest step from one state to the next, relative to the path since the start of the search */
static const double growth = 0.5;
static const double halfway = 0.5;    /* fraction of the distance to the predicted point */
static const double approached = 0.9; /* fraction of the distance to the estimate */
/* path parameter at which the search ends, relative to the previous length of the path */
static const double farthest = 1e3;
/* difference of successive estimates, relative to the path parameter */
static const double alike = 1e-3;
static const double steepest =
    8; /* rate of change of a state along the path, relative to the rate in the last step */
/* distance between states that may be due to rounding, relative to the size of the structure */
static const double at_rest = 1e-9;
static const double wanted_error = 1e-9;
/* distance from the estimate, relative to the path parameter; at smaller distances, rounding
 * determines the stability */
static const double closest = 1e-5;

static status followed_state(const analysis_context *c, int analysis, const model_state **state,
                             fault *f)
{
    const analysis_outcome *followed = &c->outcomes[c->scene->analysis[analysis].follows];
    const outcome_path *path = outcome_path_of(followed);
    if (path->stations == 0 || path->reached < path->stations)
        return fault_set(f, followed->status != STATUS_OK ? followed->status : STATUS_REFUSED,
                         "the base state was not reached: %.150s", followed->reason);
    *state = path->state[path->reached - 1];
    return STATUS_OK;
}

/* Prepares Newton's method at the followed state. K of this state, n->K, is factored and may be
 * unsymmetric. */
static status start(analysis_context *c, int analysis, const char *what, newton_run *n, fault *f)
{
    const model_state *state = NULL;
    step_record unused = {0};
    TRY(newton_alloc(c, 0, n, f));
    if (c->options->newton == NEWTON_DENSE)
        return fault_set(f, STATUS_REFUSED,
                         "%s about a loaded state require the condensed tangent, which "
                         "newton=dense does not form; give newton=mixed",
                         what);
    TRY(followed_state(c, analysis, &state, f));
    kinematics_state_copy(c->model, state, n->state);
    return newton_direction(n, kinematics_state_path(n->state), &unused, f);
}

static int needs_growth(const analysis_context *c, int analysis)
{
    for (int i = 0; i < c->scene->quantities; i++)
        if (scene_requests(&c->scene->quantity[i], analysis, SCENE_GROWTH))
            return 1;
    return 0;
}

/* Finds the frequencies if the tangent is not symmetric and positive definite. Modes may then grow.
 * Damping is included for the growth rates but not for the frequencies. */
static status unsymmetric_frequencies(analysis_context *c, int analysis, newton_run *n,
                                      outcome_spectrum *out, fault *f)
{
    flutter_system of;
    unsymmetric_result r = {0}, undamped = {0};
    int mode = 0;
    status outcome = flutter_system_alloc(n, &of, f);
    if (outcome == STATUS_OK && of.massless)
        outcome = fault_set(f, STATUS_REFUSED,
                            "the structure has no mass, so it has no frequencies; give a density "
                            "to a section, or a mass to a node");
    if (outcome == STATUS_OK)
        outcome = flutter_motions(n, &of, modal_wanted(c, analysis), FLUTTER_ERRORS, &r, f);
    if (outcome == STATUS_OK && of.damped)
        outcome = flutter_motions(n, &(flutter_system){.M = of.M}, modal_wanted(c, analysis),
                                  FLUTTER_ERRORS, &undamped, f);
    snprintf(out->meaning, sizeof out->meaning, "%s", flutter_damping(c->model, 0));
    out->growth_meaning = flutter_damping(c->model, of.damped);
    const flutter_kind kind = outcome == STATUS_OK ? flutter_of(&of, &r, &mode) : FLUTTER_NONE;
    if (kind != FLUTTER_NONE) {
        out->growth = r.growth[mode];
        if (c->result->reason[0] == '\0')
            snprintf(c->result->reason, sizeof c->result->reason,
                     "unstable at path %g: %s, growth rate %.4g 1/s",
                     kinematics_state_path(n->state), flutter_name(&of, kind), r.growth[mode]);
    }
    if (outcome == STATUS_OK)
        flutter_take(of.damped ? &undamped : &r, &out->positive);
    flutter_system_free(&of);
    unsymmetric_free(&undamped);
    unsymmetric_free(&r);
    return outcome;
}

static status frequencies(analysis_context *c, int analysis, newton_run *n, sparse *M,
                          eigen_result *e, outcome_spectrum *out, fault *f)
{
    const sparse *pattern;
    TRY(start(c, analysis, "frequencies", n, f));
    const int negative = factor_count(n->factor).negative_pivots;
    if (negative < 0 || (negative > 0 && needs_growth(c, analysis)))
        return unsymmetric_frequencies(c, analysis, n, out, f);
    TRY(assemble_pattern(c->model, c->run->patterns, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, M, f));
    TRY(rotating_frame_inertia(&c->eq, n->state, 0, M, NULL, f));
    snprintf(out->meaning, sizeof out->meaning, "%s", flutter_damping(c->model, 0));
    const sparse *upper = factor_upper(n->factor);
    const eigen_problem p = {.K = upper != NULL ? upper : &n->K,
                             .A = M,
                             .K_factor = n->factor,
                             .sign = 1,
                             .largest = modal_wanted(c, analysis)};
    const status result = eigen_solve(&p, e, f);
    context_count_eigen(c, e);
    return result;
}

status loaded_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    newton_run n;
    sparse M = {0};
    eigen_result e = {0};
    const status result = frequencies(c, analysis, &n, &M, &e, &o->left.spectrum, f);
    for (int i = 0; i < e.positive.count; i++) {
        e.positive.mu[i] = 1 / sqrt(e.positive.mu[i]);
        e.positive.error[i] /= 2;
    }
    if (e.positive.mu != NULL)
        outcome_take(&e.positive, &o->left.spectrum.positive);
    eigen_free(&e);
    sparse_free_values(&M);
    newton_free(&n);
    return result;
}

/* Search for the critical point. p and sigma belong to the last stable states on the path, with the
 * last state first. */
typedef struct loaded_search {
    newton_run n;
    /* predicts the next state from the stable states since the last unstable state */
    predictor guess;
    model_state *stable;
    sparse scale; /* diagonal of the first K */
    double begin, shift, p[POINTS],
        sigma[POINTS]; /* shift: the first sigma; K + shift scale is far from singular */
    int points;
    double noise; /* bound of the rounding error of sigma[0] */
    /* unstable: smallest path parameter that is known to be beyond the critical point */
    double estimate, change, unstable;
    int wanted;
    double size; /* length of the path so far */
    double predicted;
    double farthest; /* path parameter at which the search ends */
    double rate; /* distance between the last two stable states, divided by the difference of their
                    path parameters */
    int lost;    /* 1: the path does not lead from the last stable state to the trial state */
    eigen_result found;
} loaded_search;

/* Starts the search at path 0, because the given state is beyond a critical point. */
static status begin_at_rest(newton_run *n, fault *f)
{
    step_record unused = {0};
    kinematics_state_copy(n->c->model, kinematics_rest(n->c->model), n->state);
    TRY(newton_to(n, 0, &unused, f));
    TRY(newton_direction(n, 0, &unused, f));
    history_drop_step(n->c->result, &unused);
    return factor_count(n->factor).negative_pivots == 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "critical loads require a stable state, but neither the initial state "
                           "nor the state at path 0 is stable; reduce the loads at path 0");
}

static int loads_wanted(const analysis_context *c, int analysis)
{
    int wanted = 1 + imperfection_modes(c->scene, analysis);
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (scene_requests(q, analysis, SCENE_CRITICAL_FACTOR) &&
            scene_critical_load_of(q)->sign > 0 && scene_critical_load_of(q)->order >= wanted)
            wanted = scene_critical_load_of(q)->order + 1;
    }
    return wanted;
}

static status search_alloc(analysis_context *c, int analysis, loaded_search *s, fault *f)
{
    s->wanted = loads_wanted(c, analysis);
    s->size = fabs(kinematics_state_path(s->n.state));
    if (s->size == 0)
        s->size = 1;
    if (!factor_is_symmetric(s->n.factor))
        return STATUS_OK;
    if (factor_count(s->n.factor).negative_pivots > 0)
        TRY(begin_at_rest(&s->n, f));
    TRY(sparse_alloc_like(&s->n.K, &s->scale, f));
    TRY(kinematics_state_alloc(c->model, &s->stable, f));
    TRY(predictor_alloc(c->model, &s->guess, f));
    predictor_reset(&s->guess);
    TRY(predictor_add(&c->eq, s->n.state, 0, &s->guess, f));
    s->n.predictor = &s->guess;
    s->begin = kinematics_state_path(s->n.state);
    sparse_zero(&s->scale);
    for (int j = 0; j < s->scale.n; j++)
        for (int k = s->scale.column[j]; k < s->scale.column[j + 1]; k++)
            if (s->scale.row[k] == j)
                s->scale.value[k] = s->n.K.value[k];
    return STATUS_OK;
}

static void search_free(loaded_search *s)
{
    newton_free(&s->n);
    predictor_free(&s->guess);
    kinematics_state_free(s->stable);
    sparse_free_values(&s->scale);
    eigen_free(&s->found);
}

static status find_noise(loaded_search *s, fault *f)
{
    const newton_run *n = &s->n;
    double *x = calloc(2 * (size_t)n->all + 1, sizeof *x), size = 0;
    if (x == NULL)
        return fault_memory(f, "critical loads");
    double *y = x + n->all;
    memcpy(x, s->found.positive.mode, (size_t)n->free * sizeof *x);
    sparse_mul(&s->scale, x, y);
    for (int k = 0; k < n->free; k++)
        size += x[k] * y[k];
    s->noise =
        stiffness_parts_assembled_rounding(n->c->model, &n->c->run->memory, n->state, x) / size;
    free(x);
    return STATUS_OK;
}

/* Returns the relative error of the estimate due to rounding of sigma. The slope of sigma is that
 * from the last state in which sigma is much larger than its rounding error, or from the start. */
static double error_of(const loaded_search *s)
{
    const double much = 10;
    double away = s->estimate - s->begin, fall = s->shift;
    for (int i = s->points - 1; i >= 0; i--)
        if (s->sigma[i] > much * s->noise) {
            away = s->estimate - s->p[i];
            fall = s->sigma[i];
        }
    return s->noise > 0 ? s->noise * fabs(away / (fall * s->estimate)) : 0;
}

/* Makes Newton's current state, whose K is factored, the last stable state, and computes its
 * sigma. */
static status take_state(loaded_search *s, fault *f)
{
    const eigen_problem p = {
        .K = &s->n.K, .A = &s->scale, .K_factor = s->n.factor, .sign = 1, .largest = s->wanted};
    eigen_free(&s->found);
    for (int i = 0; i < s->scale.column[s->scale.n]; i++)
        s->n.K.value[i] += s->shift * s->scale.value[i];
    if (s->shift > 0)
        TRY(context_factor(s->n.c, s->n.factor, &s->n.K, f));
    const status found = eigen_solve(&p, &s->found, f);
    context_count_eigen(s->n.c, &s->found);
    TRY(found);
    TRY(find_noise(s, f));
    memmove(s->p + 1, s->p, (POINTS - 1) * sizeof *s->p);
    memmove(s->sigma + 1, s->sigma, (POINTS - 1) * sizeof *s->sigma);
    s->p[0] = kinematics_state_path(s->n.state);
    s->sigma[0] = 1 / s->found.positive.mu[0] - s->shift;
    s->shift = s->points == 0 ? s->sigma[0] : s->shift;
    s->points += s->points < POINTS;
    kinematics_state_copy(s->n.c->model, s->n.state, s->stable);
    return STATUS_OK;
}

static status tangent_at_path(loaded_search *s, double path, fault *f)
{
    step_record unused = {0};
    double increment = path - s->p[0];
    kinematics_state_copy(s->n.c->model, s->stable, s->n.state);
    TRY(static_walk(&s->n, path, &increment, f));
    return newton_convergence_tangent_stands(&s->n.newton_convergence)
               ? STATUS_OK
               : newton_direction(&s->n, path, &unused, f);
}

/* Returns the rate of change of the structure from the stored state to Newton's current state. */
static double rate_to(const loaded_search *s, double path)
{
    return metric_distance(s->n.c->model, s->stable, s->n.state, NULL) / (path - s->p[0]);
}

/* Computes the state at `path`. Sets *stable to 1 if the state is stable; the state is then the
 * last stable state. Beyond a limit point, there is no neighbouring state: Newton's method fails,
 * or finds a distant state, which may be stable. */
static status go_to(loaded_search *s, double path, int *stable, fault *f)
{
    const status outcome = tangent_at_path(s, path, f);
    *stable = outcome == STATUS_OK && factor_count(s->n.factor).negative_pivots == 0;
    s->lost = outcome == STATUS_NOT_CONVERGED;
    if (outcome != STATUS_OK && outcome != STATUS_SINGULAR && !s->lost)
        return outcome;
    if (outcome == STATUS_OK) {
        const double rate = rate_to(s, path);
        s->lost = s->rate > 0 && rate > steepest * s->rate && rate * (path - s->p[0]) > at_rest;
        *stable &= !s->lost;
        if (s->lost)
            (void)fault_set(f, STATUS_NOT_CONVERGED,
                            "near path %g the structure jumps to another equilibrium before it "
                            "loses its stiffness; use a continuation",
                            path);
        else if (*stable)
            s->rate = rate;
    }
    if (*stable)
        return take_state(s, f);
    predictor_reset(&s->guess);
    return predictor_add(&s->n.c->eq, s->stable, 0, &s->guess, f);
}

/* Returns the zero of sigma from the inverse interpolation p(sigma); INFINITY: sigma does not
 * fall. */
static double extrapolate(const loaded_search *s)
{
    const double *p = s->p, *g = s->sigma;
    if (s->points < 2 || !(g[0] < g[1]))
        return INFINITY;
    const double slope = (p[0] - p[1]) / (g[0] - g[1]), line = p[0] - g[0] * slope;
    if (s->points < 3 || !(g[1] < g[2]))
        return line;
    const double bend = ((p[1] - p[2]) / (g[1] - g[2]) - slope) / (g[2] - g[0]);
    const double parabola = line + g[0] * g[1] * bend;
    return parabola > p[0] ? parabola : line;
}

/* Predicts the distance to the first critical point from the eigenvalues of (K, -dK), where K is
 * the tangent at the start and dK is its change in a step. A has the pattern of K. */
static status predict(loaded_search *s, double step, sparse *A, fault *f)
{
    newton_run *n = &s->n;
    step_record unused = {0};
    eigen_result found = {0};
    s->predicted = INFINITY;
    s->p[0] = s->begin;
    kinematics_state_copy(n->c->model, n->state, s->stable);
    if (tangent_at_path(s, s->begin + step, f) != STATUS_OK)
        step = 0;
    else
        s->rate = rate_to(s, s->begin + step);
    memcpy(A->value, n->K.value, (size_t)A->column[A->n] * sizeof *A->value);
    kinematics_state_copy(n->c->model, s->stable, n->state);
    predictor_reset(&s->guess);
    TRY(predictor_add(&n->c->eq, n->state, 0, &s->guess, f));
    TRY(newton_direction(n, s->begin, &unused, f));
    if (step == 0)
        return STATUS_OK;
    for (int i = 0; i < A->column[A->n]; i++)
        A->value[i] -= n->K.value[i];
    const eigen_problem p = {.K = &n->K, .A = A, .K_factor = n->factor, .sign = -1, .largest = 1};
    const status outcome = eigen_solve(&p, &found, f);
    context_count_eigen(n->c, &found);
    if (outcome != STATUS_FAULT && found.positive.count > 0 && found.positive.mu[0] > 0)
        s->predicted = step / found.positive.mu[0];
    eigen_free(&found);
    return outcome == STATUS_FAULT ? outcome : STATUS_OK;
}

static status predict_twice(loaded_search *s, fault *f)
{
    const double small = 1e-3;
    sparse A = {0};
    TRY(sparse_alloc_like(&s->n.K, &A, f));
    status outcome = predict(s, small * s->size, &A, f);
    const double first = s->predicted;
    if (outcome == STATUS_OK && isfinite(first) && (first < s->size || first > 1e3 * s->size))
        outcome = predict(s, small * first, &A, f);
    if (!isfinite(s->predicted))
        s->predicted = first;
    sparse_free_values(&A);
    return outcome;
}

/* Returns 1 if sigma is as small as expected from the remaining distance. sigma is proportional to
 * this distance or, at a limit point, to its square root. If sigma is larger, the state beyond
 * belongs to another equilibrium path. */
static int falls_to_zero(const loaded_search *s)
{
    const double noise = 2e-3, steep = 5;
    const double part = fabs((s->estimate - s->p[0]) / (s->estimate - s->begin));
    return s->sigma[0] <= s->shift * (noise + steep * sqrt(part));
}

static status find_critical(loaded_search *s, fault *f)
{
    int stable = 0;
    TRY(predict_twice(s, f));
    const int is_predicted = isfinite(s->predicted);
    double target = s->begin + (is_predicted ? halfway * s->predicted : first_step * s->size);
    TRY(take_state(s, f));
    s->farthest = s->begin + fmax(farthest * s->size, is_predicted ? 10 * s->predicted : 0);
    const double farthest_path = s->farthest;
    for (int i = 0; i < MAX_STATES && target <= farthest_path; i++) {
        TRY(go_to(s, target, &stable, f));
        if (s->lost && target - s->p[0] <= closest * fmax(s->size, fabs(target)))
            return STATUS_NOT_CONVERGED;
        if (!stable) {
            s->unstable = s->lost ? s->unstable : target;
            target = (s->p[0] + target) / 2;
            continue;
        }
        const double last = s->estimate, limit = fmin(s->p[0] + growth * (s->p[0] - s->begin),
                                                      (s->p[0] + s->unstable) / 2);
        s->estimate = extrapolate(s);
        s->change = fabs(s->estimate - last);
        const double left = s->estimate - s->p[0],
                     size = fmax(fabs(s->estimate), s->estimate - s->begin);
        if (isfinite(s->estimate) && (s->change <= wanted_error * size ||
                                      (left <= 2 * closest * size && s->change <= alike * size)))
            return falls_to_zero(s)
                       ? STATUS_OK
                       : fault_set(f, STATUS_NOT_CONVERGED,
                                   "near path %g the structure jumps to another equilibrium before "
                                   "it loses its stiffness; use a continuation",
                                   s->p[0]);
        target = fmin(
            s->p[0] + fmax(closest * size,
                           fmin(approached * left, isfinite(left) ? left - closest * size : left)),
            limit);
    }
    return isfinite(s->estimate) && target <= farthest_path
               ? fault_set(f, STATUS_NOT_CONVERGED,
                           "the critical load was not found, because its estimate near path %g "
                           "still changes by %.1e; use a continuation",
                           s->estimate, s->change)
               : fault_set(f, STATUS_NOT_CONVERGED,
                           "no critical load from path %g to %g, because the structure does not "
                           "lose its stiffness there",
                           s->begin, s->p[0]);
}

/* Counts the negative eigenvalues at `path`. The computation starts from s->stable, which does not
 * change. */
static status count_at(loaded_search *s, double path, int *negative, fault *f)
{
    s->p[0] = kinematics_state_path(s->stable);
    TRY(tangent_at_path(s, path, f));
    *negative = factor_count(s->n.factor).negative_pivots;
    predictor_reset(&s->guess);
    return STATUS_OK;
}

typedef struct loads_found {
    int count;
    double *value, *error;
} loads_found;

static void add_loads(const loaded_search *s, int negative, double value, double error,
                      loads_found *out)
{
    for (; out->count < negative && out->count < s->wanted; out->count++) {
        out->value[out->count] = value;
        out->error[out->count] = error;
    }
}

/* Adds the first load, and the loads that are so close to it that the path has passed them at
 * `low`. The eigenvalues decrease almost in proportion to the distances from these loads. */
static void add_first(const loaded_search *s, int negative, double from, double low,
                      loads_found *out)
{
    const eigen_side *found = &s->found.positive;
    const double size = fabs(s->estimate - s->begin);
    add_loads(s, 1, s->estimate, error_of(s), out);
    for (int i = 1; i < negative && i < s->wanted; i++) {
        const double sigma = i < found->count ? 1 / found->mu[i] - s->shift : NAN,
                     value = from + (s->estimate - from) * sigma / s->sigma[0],
                     apart = value - s->estimate;
        if (!(apart > wanted_error * size)) /* one multiple load */
            add_loads(s, i + 1, s->estimate, error_of(s), out);
        else
            add_loads(s, i + 1, fmin(value, low), apart / size, out);
    }
}

/* Reduces the part of the path from *low to *high in which eigenvalues become negative. Their
 * number is `passed` at *low and *above at *high. Close to a critical point, rounding errors may
 * prevent the convergence of Newton's method. */
static status narrow(loaded_search *s, int passed, double *low, double *high, int *above, fault *f)
{
    const double apart = 1e-9, half = 0.5, less = 0.382;
    for (double part = half; *high - *low > apart * fabs(*high);) {
        const double middle = *low + part * (*high - *low);
        int inside = 0;
        const status outcome = count_at(s, middle, &inside, f);
        const int failed = outcome == STATUS_SINGULAR || outcome == STATUS_NOT_CONVERGED;
        if (failed && *high - *low <= closest * fabs(*high))
            return STATUS_OK;
        if (failed && part == half) {
            part = less;
            continue;
        }
        TRY(outcome);
        part = half;
        if (inside > passed) {
            *high = middle;
            *above = inside;
        } else {
            *low = middle;
            kinematics_state_copy(s->n.c->model, s->n.state, s->stable);
        }
    }
    return STATUS_OK;
}

/* Finds a path parameter *low, from which the search continues: the first of several values just
 * above the load `high` at which Newton's method converges. The last value is `most`. Sets
 * *negative to the number of negative eigenvalues at *low. */
static status pass(loaded_search *s, double high, double width, double most, double *low,
                   int *negative, fault *f)
{
    status outcome = STATUS_NOT_CONVERGED;
    for (int last = 0; !last && (outcome == STATUS_NOT_CONVERGED || outcome == STATUS_SINGULAR);
         width *= 10) {
        last = high + width >= most;
        *low = last ? most : high + width;
        outcome = count_at(s, *low, negative, f);
    }
    TRY(outcome);
    kinematics_state_copy(s->n.c->model, s->n.state, s->stable);
    return STATUS_OK;
}

/* Finds the requested loads after the first load from the number of negative eigenvalues along the
 * path. The search ends at a thousand times the distance from the start to the first load. */
static status find_more(loaded_search *s, loads_found *out, fault *f)
{
    const double size = fabs(s->estimate - s->begin), from = s->p[0],
                 end = s->begin + farthest * size;
    double low = s->estimate + 2 * closest * size;
    int passed = 0;
    TRY(pass(s, low, 0, low, &low, &passed, f));
    add_first(s, passed, from, low, out);
    while (out->count < s->wanted && low < end) {
        const double step = fmin(end, low + 0.2 * (low - s->begin));
        double high = step;
        int above = 0;
        TRY(count_at(s, high, &above, f));
        const int some = above > passed;
        if (some)
            TRY(narrow(s, passed, &low, &high, &above, f));
        const double width = high - low, load = low + width / 2, error = width / fabs(high);
        if (some)
            add_loads(s, above, load, error, out);
        passed = above > passed ? above : passed;
        TRY(pass(s, high, some ? width : 0, step, &low, &above, f));
        add_loads(s, above, (load + low) / 2, (low - load) / fabs(high), out);
        passed = above > passed ? above : passed;
    }
    return STATUS_OK;
}

static status store_results(loaded_search *s, outcome_side *out, fault *f)
{
    const size_t n = (size_t)s->n.free, wanted = (size_t)s->wanted;
    double *mode = calloc(wanted * n + 1, sizeof *mode);
    loads_found found = {0, calloc(wanted, sizeof(double)), calloc(wanted, sizeof(double))};
    fault why = {""};
    if (mode == NULL || found.value == NULL || found.error == NULL) {
        free(mode);
        free(found.value);
        free(found.error);
        return fault_memory(f, "critical loads");
    }
    const int modes = s->found.positive.count < s->wanted ? s->found.positive.count : s->wanted;
    if (s->found.positive.mode != NULL)
        memcpy(mode, s->found.positive.mode, (size_t)modes * n * sizeof *mode);
    const status more = s->wanted > 1 ? find_more(s, &found, &why) : STATUS_OK;
    add_loads(s, 1, s->estimate, error_of(s), &found);
    *out = (outcome_side){
        .count = found.count, .value = found.value, .mode = mode, .error = found.error};
    if (more != STATUS_OK) {
        out->status = more;
        snprintf(out->reason, sizeof out->reason, "%.200s; use more elements, or a continuation",
                 why.text);
    } else if (found.count < s->wanted) {
        snprintf(out->reason, sizeof out->reason,
                 "no further critical load up to path %g; request a lower index",
                 kinematics_state_path(s->stable));
    }
    return more == STATUS_FAULT ? fault_set(f, more, "%s", why.text) : STATUS_OK;
}

/* Returns the largest N l^2/(pi^2 E I) of all elements, where N is the larger compressive force at
 * the ends of the element's member in Newton's state and I is the smaller second moment of area. If
 * the result exceeds 1, an element buckles individually, and the divergence may be this local
 * buckling. */
static double thrust_of_elements(const newton_run *n)
{
    const model *m = n->c->model;
    const internal_state at = {.s = n->state, .path = kinematics_state_path(n->state)};
    double most = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_kind *kind = model_kind_of(m, i);
        const section *s = model_section(m, kind->section);
        double end[2][7];
        for (int k = 0; k < 2; k++)
            internal_at_end(&n->c->eq, &at, model_element(m, i)->member, k, end[k]);
        const double EI = s->young * fmin(s->Iy, s->Iz), thrust = -fmin(end[0][0], end[1][0]);
        if (EI > 0) /* EI is 0 for a section given by matrices */
            most = fmax(most, thrust * kind->length * kind->length / (PI * PI * EI));
    }
    return most;
}

/* Checks a divergence of a structure without mass. NOT_CONVERGED: the divergence is an artefact of
 * the mesh. Without mass, there is no search for flutter. */
static status check_has_mass(const newton_run *n, const flutter_point *first, fault *f)
{
    const double most = first->massless ? thrust_of_elements(n) : 0;
    return most < 1 ? STATUS_OK
                    : fault_set(f, STATUS_NOT_CONVERGED,
                                "the divergence near path %.6g is an artefact of the mesh, whose "
                                "elements carry %.3g times their Euler load there; use more "
                                "elements, or give a section a density, because flutter is "
                                "searched for only in structures with mass",
                                first->path, most);
}

/* Finds the first critical load and its kind if loads have no potential. */
static status find_without_potential(analysis_context *c, loaded_search *s, outcome_spectrum *found,
                                     fault *f)
{
    flutter_point first;
    char how[64] = "";
    TRY(flutter_search(&s->n, s->size, static_walk, &first, f));
    const status right = check_has_mass(&s->n, &first, f);
    if (right != STATUS_OK) {
        free(first.mode);
        return right;
    }
    double *value = calloc(1, sizeof *value), *error = calloc(1, sizeof *error);
    if (value == NULL || error == NULL) {
        free(value);
        free(error);
        free(first.mode);
        return fault_memory(f, "critical loads");
    }
    value[0] = first.path;
    error[0] = first.error;
    outcome_side *out = &found->positive;
    *out = (outcome_side){.count = 1, .value = value, .mode = first.mode, .error = error};
    snprintf(out->reason, sizeof out->reason,
             "for loads without a potential, only the first critical load is searched for; request "
             "which: 0");
    if (first.frequency > 0)
        snprintf(how, sizeof how, " at %.6g Hz", first.frequency / (2 * PI));
    snprintf(found->meaning, sizeof found->meaning, "%s%s%s", first.what, how,
             first.massless ? "; flutter was not searched for (no mass)" : "");
    if (c->result->reason[0] == '\0')
        snprintf(c->result->reason, sizeof c->result->reason,
                 "stability is lost at path %.6g: %s%s%s", first.path, first.what, how,
                 first.massless ? "; flutter was not searched for (no mass)" : "");
    return STATUS_OK;
}

static status run(analysis_context *c, int analysis, loaded_search *s, outcome_spectrum *out,
                  fault *f)
{
    TRY(start(c, analysis, "critical loads", &s->n, f));
    TRY(search_alloc(c, analysis, s, f));
    if (!factor_is_symmetric(s->n.factor) &&
        scene_rotates(&c->scene->analysis[c->scene->analysis[analysis].follows]))
        return fault_set(
            f, STATUS_REFUSED,
            "critical loads in rotating axes require loads that have a potential; flutter under "
            "other loads depends on Coriolis forces, which are not included; use a motion");
    if (!factor_is_symmetric(s->n.factor))
        return find_without_potential(c, s, out, f);
    TRY(find_critical(s, f));
    return store_results(s, &out->positive, f);
}

status loaded_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    loaded_search s = {.unstable = INFINITY, .estimate = INFINITY};
    outcome_side *back = &o->left.spectrum.negative;
    snprintf(back->reason, sizeof back->reason,
             "from a loaded state, the search follows the loads only in the direction of the path; "
             "reverse the loads");
    const status result = run(c, analysis, &s, &o->left.spectrum, f);
    if (result == STATUS_NOT_CONVERGED && !isfinite(s.estimate)) {
        const fault why = *f;
        (void)fault_set(f, result, "%.*s%s", FAULT_TEXT / 2, why.text,
                        along_path_end(c->scene, c->eq.loading.acting).text);
    }
    search_free(&s);
    return result;
}
