#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "a harmonic analysis");
}

static status factor_at(vibration *v, double hertz, fault *f)
{
    fault why = {""};
    const int by_modes = v->c->scene->analysis[v->analysis].by_modes;
    status outcome = by_modes ? harmonic_modes_factor(v, 2 * PI * hertz, &why)
                              : harmonic_factor(v, 2 * PI * hertz, &why);
    if (by_modes && outcome == STATUS_OK)
        outcome = harmonic_closed_factor(v, &why);
    if (outcome != STATUS_SINGULAR)
        return outcome == STATUS_OK ? outcome : fault_set(f, outcome, "%s", why.text);
    return fault_set(
        f, STATUS_SINGULAR,
        hertz == 0
            ? "at %g Hz the structure is free to move; start at a higher frequency"
            : "%g Hz is a natural frequency without damping; use another frequency, or add damping",
        hertz);
}

static int same_input(const scene_response *a, const scene_response *b)
{
    return a->driver == b->driver && a->reference == b->reference && a->forced == b->forced &&
           a->unbalanced == b->unbalanced &&
           (a->forced == SCENE_NONE || a->forced_along == b->forced_along) &&
           (a->unbalanced == SCENE_NONE || a->spinning == b->spinning);
}

/* Solves directly. x contains the forces on entry and the solution on return. */
static void solve_direct(vibration *v, const scene_response *r, double w, double complex x[])
{
    const int n = v->free, more = harmonic_border(v), N = n + more + v->loops;
    const int carried = more > 0 && harmonic_carried(v, r, v->x + N + n);
    for (int i = 0; i < n; i++) {
        v->x[i] = creal(x[i]);
        v->x[N + i] = cimag(x[i]);
    }
    for (int i = 0; i < more; i++) {
        v->x[n + i] = 0;
        v->x[N + n + i] = carried ? w * v->x[N + n + i] : 0;
    }
    for (int l = 0; l < v->loops; l++) {
        v->x[n + more + l] = creal(x[v->all + l]);
        v->x[N + n + more + l] = cimag(x[v->all + l]);
    }
    factor_solve(v->factor, v->x);
    for (int i = 0; i < n; i++)
        x[i] = v->x[i] + I * v->x[N + i];
    for (int l = 0; l < v->loops; l++)
        x[v->all + l] = v->x[n + more + l] + I * v->x[N + n + more + l];
}

/* Solves by modal superposition. x contains the forces on entry and the solution on return. Sets
 * left[free] to the residual of the forces. */
static void solve_by_modes(vibration *v, const scene_response *r, double w, double complex x[],
                           double complex left[])
{
    const double *U;
    const size_t n = (size_t)v->free;
    const int more = harmonic_modes_damped(v->modes, &U);
    memcpy(left, x, n * sizeof *left);
    if (more > 0 && harmonic_carried(v, r, v->x))
        for (size_t i = 0; i < (size_t)more; i++)
            for (size_t k = 0; k < n; k++)
                left[k] += I * w * v->x[i] * U[i * n + k];
    if (v->loops > 0)
        harmonic_closed_solve(v, left, x);
    if (v->loops == 0 || !v->modes->complete) /* the bound needs the residual without loops */
        harmonic_modes_solve(v, left, v->loops > 0 ? v->dual : x);
}

static status solve_own_input(vibration *v, int quantity, double w, fault *f)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    double complex *x = v->found + (size_t)quantity * loops_whole(v),
                   *left = v->left + (size_t)quantity * (size_t)v->free;
    TRY(harmonic_input(v, r, w, x, f));
    if (s->analysis[v->analysis].by_modes)
        solve_by_modes(v, r, w, x, left);
    else
        solve_direct(v, r, w, x);
    return STATUS_OK;
}

static status solve_input(vibration *v, int quantity, double w, fault *f)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    const size_t all = loops_whole(v);
    double complex *x = v->found + (size_t)quantity * all,
                   *left = v->left + (size_t)quantity * (size_t)v->free;
    for (int i = 0; i < quantity; i++)
        if (scene_requests(&s->quantity[i], v->analysis, SCENE_RESPONSE) &&
            same_input(&s->quantity[i].what.of.response, r)) {
            memcpy(x, v->found + (size_t)i * all, all * sizeof *x);
            memcpy(left, v->left + (size_t)i * (size_t)v->free, (size_t)v->free * sizeof *left);
            return STATUS_OK;
        }
    return solve_own_input(v, quantity, w, f);
}

static double complex dot(size_t n, const double complex a[], const double complex b[])
{
    double complex sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static double part_of(const scene_response *r, double complex z)
{
    switch (r->part) {
    case SCENE_AMPLITUDE:
        return cabs(z);
    case SCENE_PHASE:
        return carg(z);
    case SCENE_REAL:
        return creal(z);
    case SCENE_IMAGINARY:
        break;
    }
    return cimag(z);
}

/* Returns the error bound of the requested part of z, whose complex error is at most `bound`. The
 * bound of a phase is an angle [rad]. */
static double bound_of(const scene_response *r, double complex z, double bound)
{
    if (r->part != SCENE_PHASE || bound == 0)
        return bound;
    return bound < cabs(z) ? asin(bound / cabs(z)) : PI;
}

static void read_quantity(vibration *v, int quantity, double w, double *value, double *bound)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    const size_t n = (size_t)v->free, all = loops_whole(v);
    harmonic_output(v, r, w, v->output);
    const double complex times = r->of == SCENE_VELOCITY       ? I * w
                                 : r->of == SCENE_ACCELERATION ? -w * w
                                                               : 1,
                         z = times * dot(all, v->output, v->found + (size_t)quantity * all) -
                             harmonic_force_at(v, r, w);
    *value = part_of(r, z);
    *bound = 0;
    if (s->analysis[v->analysis].by_modes && s->analysis[v->analysis].modes > 0) {
        const double complex *left = v->left + (size_t)quantity * n,
                             *u = v->found + (size_t)quantity * all + v->all;
        if (v->loops > 0 && v->modes->complete)
            return;
        harmonic_modes_solve(v, v->output, v->dual);
        *bound = bound_of(r, z,
                          cabs(times) * (v->loops > 0
                                             ? harmonic_closed_bound(v, left, u, v->output, v->dual)
                                             : harmonic_modes_bound(v, left, v->output)));
    }
}

/* Computes a quantity at a frequency. The search maximises sign * value. */
static status respond_at(vibration *v, int quantity, double sign, double hertz, outcome_peak *out,
                         fault *f)
{
    const double w = 2 * PI * hertz;
    const int amplitude = v->c->scene->quantity[quantity].what.of.response.part == SCENE_AMPLITUDE;
    *out = (outcome_peak){.hertz = hertz};
    const status factored = factor_at(v, hertz, f);
    if (factored == STATUS_SINGULAR) {
        out->value = amplitude ? INFINITY : sign * INFINITY;
        return STATUS_OK;
    }
    TRY(factored);
    TRY(solve_own_input(v, quantity, w, f));
    read_quantity(v, quantity, w, &out->value, &out->bound);
    return STATUS_OK;
}

static status respond(vibration *v, outcome_harmonic *o, fault *f)
{
    const scene *s = v->c->scene;
    const scene_path *path = scene_path_of(&s->analysis[v->analysis]);
    const size_t stations = (size_t)path->stations;
    for (int i = 0; i < path->stations; i++) {
        const double w = 2 * PI * path->value[i];
        TRY(stop_check(f));
        TRY(factor_at(v, path->value[i], f));
        for (int k = 0; k < s->quantities; k++)
            if (scene_requests(&s->quantity[k], v->analysis, SCENE_RESPONSE)) {
                const size_t at = (size_t)k * stations + (size_t)i;
                TRY(solve_input(v, k, w, f));
                read_quantity(v, k, w, &o->response[at], &o->bound[at]);
            }
        o->path.value[o->path.reached++] = path->value[i];
    }
    return v->plain ? STATUS_OK : harmonic_extremes_refine(v, respond_at, o, f);
}

status harmonic_check_rates(const vibration *v, const scene_response *r, fault *f)
{
    const model *m = v->c->model;
    const int node[] = {r->node, r->from};
    for (int i = 0; i < 2 && v->about != NULL; i++) {
        if ((r->of != SCENE_VELOCITY && r->of != SCENE_ACCELERATION) || node[i] == SCENE_NONE)
            continue;
        const mesh_vertex *body = model_vertex(m, model_body(m, node[i]));
        int turns = 0;
        for (int k = 0; k < 3; k++) {
            const int c = body->coordinate[SCENE_RX + k];
            turns |= c != NONE && v->about->rate[c] != 0;
        }
        if (turns && (model_body(m, node[i]) != node[i] || body->angles > 1))
            return fault_set(f, STATUS_REFUSED,
                             "the velocity of %s depends on more than the rate of its "
                             "displacement, because its body rotates at %g s; request the "
                             "displacement, or the velocity of the main node of the body",
                             scene_called(model_scene(m), SCENE_NODES, node[i]).text,
                             v->about->time);
    }
    return STATUS_OK;
}

/* Checks the requested reactions, rates and unbalances. REFUSED: one of them cannot be
 * evaluated. */
static status check_outputs(const vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    int c;
    for (int i = 0; i < s->quantities; i++) {
        if (!scene_requests(&s->quantity[i], v->analysis, SCENE_RESPONSE))
            continue;
        const scene_response *r = &s->quantity[i].what.of.response;
        TRY(harmonic_check_rates(v, r, f));
        if (v->rotates && r->unbalanced != SCENE_NONE)
            return fault_set(f, STATUS_REFUSED,
                             "%s: an unbalance rotates with the frequency in fixed axes, but the "
                             "axes rotate; give %s a mass with 'centre', or a response about a "
                             "state without rotation",
                             s->quantity[i].name, scene_called(s, SCENE_NODES, r->unbalanced).text);
        if (r->of == SCENE_REACTING)
            TRY(harmonic_reacting(v, r, &c, f));
    }
    return STATUS_OK;
}

static status find_modes_of(vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    const scene_analysis *a = &s->analysis[v->analysis];
    if (!a->by_modes && !scene_has_ratios(a))
        return STATUS_OK;
    TRY(harmonic_modes_find(v, f));
    if (!a->by_modes)
        return STATUS_OK;
    const size_t n = (size_t)v->free;
    double *loads = calloc(((size_t)s->quantities * HARMONIC_SHAPES + 2 * (size_t)v->loops) * n + 1,
                           sizeof *loads);
    if (loads == NULL)
        return no_memory(f);
    int count = 0;
    for (int i = 0; i < s->quantities; i++)
        if (scene_requests(&s->quantity[i], v->analysis, SCENE_RESPONSE))
            count +=
                harmonic_shapes(v, &s->quantity[i].what.of.response, loads + (size_t)count * n);
    for (int l = 0; l < v->loops; l++) {
        memcpy(loads + (size_t)count++ * n, v->loop[l].push, n * sizeof *loads);
        memcpy(loads + (size_t)count++ * n, v->loop[l].measured, n * sizeof *loads);
    }
    const status outcome = harmonic_modes_project(v, count, loads, f);
    free(loads);
    return outcome == STATUS_OK ? harmonic_closed_alloc(v, f) : outcome;
}

static status allocate(vibration *v, outcome_harmonic *o, fault *f)
{
    const size_t quantities = (size_t)v->c->scene->quantities, free = (size_t)v->free,
                 stations = (size_t)o->path.stations, whole = loops_whole(v);
    o->path.value = calloc(stations + 1, sizeof *o->path.value);
    o->response = calloc(quantities * stations + 1, sizeof *o->response);
    o->bound = calloc(quantities * stations + 1, sizeof *o->bound);
    o->peak = calloc(quantities + 1, sizeof *o->peak);
    v->x = calloc(4 * free + 2 * (size_t)v->loops + 1, sizeof *v->x);
    v->found = calloc(quantities * whole + 1, sizeof *v->found);
    v->left = calloc(quantities * free + 1, sizeof *v->left);
    v->output = calloc(whole + 1, sizeof *v->output);
    v->dual = calloc(whole + 1, sizeof *v->dual);
    return o->path.value != NULL && o->response != NULL && o->bound != NULL && o->peak != NULL &&
                   v->x != NULL && v->found != NULL && v->left != NULL && v->output != NULL &&
                   v->dual != NULL
               ? STATUS_OK
               : no_memory(f);
}

static status solve(vibration *v, outcome_harmonic *o, fault *f)
{
    const scene_path *path = scene_path_of(&v->c->scene->analysis[v->analysis]);
    o->path.stations = path->stations;
    TRY(harmonic_begin(v, f));
    TRY(allocate(v, o, f));
    TRY(harmonic_pattern(v, f));
    TRY(check_outputs(v, f));
    TRY(find_modes_of(v, f));
    TRY(harmonic_check_growth(v, path->value[path->stations - 1], f));
    if (!v->c->scene->analysis[v->analysis].by_modes)
        TRY(harmonic_matrix(v, f));
    return respond(v, o, f);
}

status harmonic_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    const status outcome = solve(&v, &o->left.harmonic, f);
    harmonic_release(&v);
    return outcome;
}

static double apart(const vibration *v, int quantity, const outcome_harmonic *a,
                    const outcome_harmonic *b)
{
    const size_t stations = (size_t)a->path.stations;
    const double *x = a->response + (size_t)quantity * stations,
                 *y = b->response + (size_t)quantity * stations;
    double largest = 0, size = 0;
    for (int i = 0; i < a->path.reached; i++) {
        largest = fmax(largest, fabs(x[i] - y[i]));
        size = fmax(size, fabs(x[i]));
    }
    if (v->c->scene->quantity[quantity].what.of.response.part == SCENE_PHASE)
        size = 1;
    return largest > 0 ? largest / size : 0;
}

status harmonic_inside(analysis_context *c, int analysis, double *error, int *quantity, fault *f)
{
    vibration v = {.c = c, .analysis = analysis, .plain = 1};
    analysis_outcome o = {.kind = SCENE_HARMONIC};
    const counters before = c->run->counters;
    const status outcome = solve(&v, &o.left.harmonic, f);
    c->run->counters = before;
    for (int i = 0; outcome == STATUS_OK && i < c->scene->quantities; i++) {
        if (!scene_requests(&c->scene->quantity[i], analysis, SCENE_RESPONSE))
            continue;
        const double one = apart(&v, i, &c->outcomes[analysis].left.harmonic, &o.left.harmonic);
        if (one > *error) {
            *error = one;
            *quantity = i;
        }
    }
    harmonic_release(&v);
    outcome_free(&o);
    return outcome;
}
