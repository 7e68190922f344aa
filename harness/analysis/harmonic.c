/* Steady small vibration about a state, at each frequency by one solution with the dynamic
 * stiffness
 *   D(w) = K + i w C - w^2 M - (w^2 - i a w)^2/(1 + i b w) B,
 * with proportional damping a M + b K in C, and B of what moves inside the elements of an
 * unstressed structure (field/field.h). In real numbers [Re D, -Im D; Im D, Re D] [Re x; Im x] =
 * [Re f; Im f]. Damped modes are the eigenvectors of D at s = i w. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

typedef struct vibration {
    analysis_context *c;
    int analysis, free, all;
    const model_state *state;
    sparse K, M, C, B; /* on all coordinates */
    int damped, inside;
    sparse D; /* [2 free] real form */
    int *source,
        *first; /* entry of K behind each entry of the free block, by columns; [free + 1] */
    int *row;
    matrix_factor *factor;
    double *x;             /* [2 free] */
    double complex *found; /* [quantities x all] */
    double *room;          /* [model_stresses + all] */
} vibration;

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for a harmonic analysis");
}

/* K of the undeformed structure, or of one with the stresses of a linear solution. */
static status linear_system_of(vibration *v, const double displaced[], fault *f)
{
    const equations *eq = &v->c->eq;
    TRY(linear_stiffness(eq, &v->K, f));
    if (displaced == NULL) {
        v->inside = rotating_frame_inner_matrix(eq, &v->B);
        return STATUS_OK;
    }
    TRY(linear_whole_stresses(eq, displaced, 1, v->room, f));
    TRY(linear_geometric_stiffness(eq, v->room, 1, &v->C, f));
    for (int i = 0; i < v->K.column[v->K.n]; i++)
        v->K.value[i] += v->C.value[i];
    return STATUS_OK;
}

/* The end of the static path. */
static status tangent_of(vibration *v, const analysis_outcome *o, fault *f)
{
    analysis_context *c = v->c;
    const outcome_path *path = outcome_path_of(o);
    if (path->stations == 0 || path->reached < path->stations)
        return fault_set(f, o->status != STATUS_OK ? o->status : STATUS_REFUSED,
                         "the state to start from was not reached: %.150s", o->reason);
    v->state = path->state[path->reached - 1];
    const double at = kinematics_state_path(v->state);
    const step_stability stands =
        history_stability_at(c->result, c->scene->analysis[v->analysis].follows, at);
    if (stands == STEP_UNSTABLE || stands == STEP_GROWS)
        return fault_set(f, STATUS_REFUSED,
                         "the state at path %g is unstable: nothing vibrates steadily about it; "
                         "end the path before",
                         at);
    model_linearisation lin = {.path = at, .K = &v->K, .residual = v->room};
    return linearise_state(&c->eq, &c->run->memory, v->state, &lin, f);
}

/* whole: of driven coordinates too. */
static status matrices(vibration *v, int whole, fault *f)
{
    analysis_context *c = v->c;
    const int follows = c->scene->analysis[v->analysis].follows;
    const sparse *pattern;
    TRY(follows != SCENE_NONE
            ? assemble_pattern_of_states(c->model, c->run->patterns, whole, &pattern, f)
            : assemble_pattern(c->model, c->run->patterns, whole, &pattern, f));
    TRY(sparse_alloc_like(pattern, &v->K, f));
    TRY(sparse_alloc_like(pattern, &v->M, f));
    TRY(sparse_alloc_like(pattern, &v->C, f));
    TRY(sparse_alloc_like(pattern, &v->B, f));
    if (follows == SCENE_NONE) {
        if (linear_initial(c->model) > 0)
            return fault_set(f, STATUS_REFUSED,
                             "members have strains by themselves, whose stresses the undeformed "
                             "state has not; name a static analysis with about");
        TRY(linear_system_of(v, NULL, f));
    } else if (c->scene->analysis[follows].kind == SCENE_LINEAR) {
        const analysis_outcome *o = &c->outcomes[follows];
        if (o->status != STATUS_OK)
            return fault_set(f, o->status, "the analysis that it is about: %.150s", o->reason);
        TRY(linear_system_of(v, outcome_displacements(o), f));
    } else {
        TRY(tangent_of(v, &c->outcomes[follows], f));
    }
    TRY(rotating_frame_inertia(&c->eq, v->state, kinematics_state_path(v->state), &v->M, NULL, f));
    const scene_proportional *damping = &c->scene->analysis[v->analysis].damping;
    v->damped = damping_acts(c->scene) || damping->mass > 0 || damping->stiffness > 0;
    if (!v->damped) {
        sparse_zero(&v->C);
        return STATUS_OK;
    }
    TRY(damping_matrix(&c->eq, v->state, damping->stiffness, &v->C, f));
    for (int i = 0; i < v->C.column[v->C.n]; i++)
        v->C.value[i] += damping->mass * v->M.value[i];
    return STATUS_OK;
}

static void append(vibration *v, int column, int row, int source)
{
    const int at = v->first[column + 1]++;
    if (v->row == NULL)
        return;
    v->row[at] = row;
    v->source[at] = source;
}

/* The free block, whole: first[free + 1] from counts, or its entries. */
static void unfold(vibration *v)
{
    for (int j = 0; j < v->free; j++)
        for (int k = v->K.column[j]; k < v->K.column[j + 1]; k++) {
            const int i = v->K.row[k];
            if (i >= v->free)
                continue;
            append(v, j, i, k);
            if (v->K.symmetric && i != j)
                append(v, i, j, k);
        }
}

/* Counts, then begins of columns at first[column + 1], which end as those of the next ones. */
static status make_pattern(vibration *v, fault *f)
{
    const int n = v->free;
    v->first = calloc((size_t)n + 2, sizeof *v->first);
    if (v->first == NULL)
        return no_memory(f);
    unfold(v);
    int entries = 0;
    for (int j = 0; j < n; j++) {
        const int count = v->first[j + 1];
        v->first[j + 1] = entries;
        entries += count;
    }
    v->row = calloc((size_t)entries + 1, sizeof *v->row);
    v->source = calloc((size_t)entries + 1, sizeof *v->source);
    v->D = (sparse){.n = 2 * n,
                    .column = calloc(2 * (size_t)n + 1, sizeof(int)),
                    .row = calloc(4 * (size_t)entries + 1, sizeof(int)),
                    .value = calloc(4 * (size_t)entries + 1, sizeof(double))};
    if (v->row == NULL || v->source == NULL || v->D.column == NULL || v->D.row == NULL ||
        v->D.value == NULL)
        return no_memory(f);
    unfold(v);
    for (int j = 0, at = 0; j < 2 * n; j++) {
        v->D.column[j] = at;
        for (int half = 0; half < 2; half++)
            for (int k = v->first[j % n]; k < v->first[j % n + 1]; k++)
                v->D.row[at++] = half * n + v->row[k];
        v->D.column[j + 1] = at;
    }
    return STATUS_OK;
}

/* Entry k of D, as K has them. */
static double complex dynamic(const vibration *v, double w, int k)
{
    double complex D = v->K.value[k] - w * w * v->M.value[k];
    if (v->inside) {
        const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
        const double complex moves = w * (w - I * damping->mass);
        D -= moves * moves / (1 + I * w * damping->stiffness) * v->B.value[k];
    }
    return v->damped ? D + I * w * v->C.value[k] : D;
}

static status factor_at(vibration *v, double hertz, fault *f)
{
    const int n = v->free;
    const double w = 2 * PI * hertz;
    fault why = {""};
    for (int j = 0, at = 0; j < 2 * n; j++) {
        const int imaginary = j >= n;
        for (int half = 0; half < 2; half++)
            for (int k = v->first[j % n]; k < v->first[j % n + 1]; k++) {
                const double complex z = dynamic(v, w, v->source[k]);
                v->D.value[at++] = half == imaginary ? creal(z) : half ? cimag(z) : -cimag(z);
            }
    }
    v->c->run->counters.factorisations++;
    const status outcome = factor_numeric(v->factor, &v->D, &why);
    if (outcome != STATUS_SINGULAR)
        return outcome == STATUS_OK ? outcome : fault_set(f, outcome, "%s", why.text);
    return fault_set(f, STATUS_SINGULAR,
                     hertz == 0 ? "at %g Hz nothing holds the structure; begin above"
                                : "at %g Hz something vibrates by itself that nothing damps: take "
                                  "another frequency, or give damping",
                     hertz);
}

/* Right-hand side of an input; what moves is 1 itself in x[all]. */
static status input_of(const vibration *v, const scene_response *r, double w, double complex x[],
                       fault *f)
{
    const model *m = v->c->model;
    int index[KINEMATICS_MOST], moves = 0;
    double T[6 * KINEMATICS_MOST];
    memset(x, 0, (size_t)v->all * sizeof *x);
    if (r->driver != SCENE_NONE) {
        const int c = model_driver_coordinate(m, r->driver);
        for (int i = 0; i < model_scene(m)->nodes; i++)
            for (int k = 0; k < 3; k++)
                if (model_vertex(m, i)->vector_driver[k] == r->driver)
                    return fault_set(f, STATUS_REFUSED,
                                     "motion %s is a component of a rotation vector: drive an "
                                     "angle, or a translation",
                                     model_scene(m)->driver[r->driver].name);
        for (int k = v->K.column[c]; k < v->K.column[c + 1]; k++)
            if (v->K.row[k] < v->free)
                x[v->K.row[k]] = -dynamic(v, w, k);
        x[c] = 1;
        return STATUS_OK;
    }
    const int count = kinematics_node_jacobian(m, v->state, r->forced, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        if (index[k] < v->free) {
            x[index[k]] = T[r->forced_along * count + k];
            moves |= T[r->forced_along * count + k] != 0;
        }
    return moves ? STATUS_OK
                 : fault_set(f, STATUS_REFUSED,
                             "%s is held or driven against the force: it moves nothing; name "
                             "another component, or a motion with drive",
                             scene_called(model_scene(m), SCENE_NODES, r->forced).text);
}

static int same_input(const scene_response *a, const scene_response *b)
{
    return a->driver == b->driver &&
           (a->driver != SCENE_NONE ||
            (a->forced == b->forced && a->forced_along == b->forced_along));
}

/* The solution for the input of a quantity, of an earlier one where that has the same. */
static status solve_input(vibration *v, int quantity, double w, fault *f)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    double complex *x = v->found + (size_t)quantity * (size_t)v->all;
    for (int i = 0; i < quantity; i++)
        if (scene_asks(&s->quantity[i], v->analysis, SCENE_RESPONSE) &&
            same_input(&s->quantity[i].what.of.response, r)) {
            memcpy(x, v->found + (size_t)i * (size_t)v->all, (size_t)v->all * sizeof *x);
            return STATUS_OK;
        }
    TRY(input_of(v, r, w, x, f));
    for (int i = 0; i < v->free; i++) {
        v->x[i] = creal(x[i]);
        v->x[v->free + i] = cimag(x[i]);
    }
    factor_solve(v->factor, v->x);
    v->c->run->counters.solutions++;
    for (int i = 0; i < v->free; i++)
        x[i] = v->x[i] + I * v->x[v->free + i];
    return STATUS_OK;
}

static double complex motion_of(const vibration *v, int node, int component,
                                const double complex x[])
{
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    double complex sum = 0;
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        sum += T[component * count + k] * x[index[k]];
    return sum;
}

static double part_of(const vibration *v, const scene_response *r, double w,
                      const double complex x[])
{
    double complex z = motion_of(v, r->node, r->component, x);
    if (r->from != SCENE_NONE)
        z -= motion_of(v, r->from, r->component, x);
    if (r->of == SCENE_VELOCITY)
        z *= I * w;
    if (r->of == SCENE_ACCELERATION)
        z *= -w * w;
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

static status respond(vibration *v, outcome_harmonic *o, fault *f)
{
    const scene *s = v->c->scene;
    const scene_path *path = scene_path_of(&s->analysis[v->analysis]);
    const size_t stations = (size_t)path->stations;
    for (int i = 0; i < path->stations; i++) {
        const double w = 2 * PI * path->value[i];
        TRY(factor_at(v, path->value[i], f));
        for (int k = 0; k < s->quantities; k++)
            if (scene_asks(&s->quantity[k], v->analysis, SCENE_RESPONSE)) {
                TRY(solve_input(v, k, w, f));
                o->response[(size_t)k * stations + (size_t)i] = part_of(
                    v, &s->quantity[k].what.of.response, w, v->found + (size_t)k * (size_t)v->all);
            }
        o->path.value[o->path.reached++] = path->value[i];
    }
    return STATUS_OK;
}

static status solve(vibration *v, outcome_harmonic *o, fault *f)
{
    const scene *s = v->c->scene;
    const model_size size = model_sizes(v->c->model);
    const size_t stations = (size_t)scene_path_of(&s->analysis[v->analysis])->stations;
    v->free = size.free;
    v->all = size.free + size.driven;
    v->state = kinematics_rest(v->c->model);
    o->path.stations = (int)stations;
    o->path.value = calloc(stations + 1, sizeof *o->path.value);
    o->response = calloc((size_t)s->quantities * stations + 1, sizeof *o->response);
    v->x = calloc(2 * (size_t)v->free + 1, sizeof *v->x);
    v->found = calloc((size_t)s->quantities * (size_t)v->all + 1, sizeof *v->found);
    v->room = calloc((size_t)model_stresses(v->c->model) + (size_t)v->all + 1, sizeof *v->room);
    if (o->path.value == NULL || o->response == NULL || v->x == NULL || v->found == NULL ||
        v->room == NULL)
        return no_memory(f);
    TRY(matrices(v, 1, f));
    TRY(make_pattern(v, f));
    TRY(factor_alloc(&v->D, &v->factor, f));
    return respond(v, o, f);
}

static void vibration_free(vibration *v)
{
    factor_free(v->factor);
    sparse_free_values(&v->K);
    sparse_free_values(&v->M);
    sparse_free_values(&v->C);
    sparse_free_values(&v->B);
    free(v->D.column);
    free(v->D.row);
    free(v->D.value);
    free(v->first);
    free(v->row);
    free(v->source);
    free(v->x);
    free(v->found);
    free(v->room);
}

status harmonic_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    const status outcome = solve(&v, &o->left.harmonic, f);
    vibration_free(&v);
    return outcome;
}

static void note_growth(analysis_context *c, const unsymmetric_result *r, outcome_spectrum *out)
{
    for (int i = 0; i < r->count; i++)
        out->growth = fmax(out->growth, r->growth[i]);
    if (out->growth > 0 && c->result->reason[0] == '\0')
        snprintf(c->result->reason, sizeof c->result->reason,
                 "unstable: a damped mode grows with %.4g 1/s", out->growth);
}

static status find_modes(vibration *v, unsymmetric_result *r, fault *f)
{
    analysis_context *c = v->c;
    const model_size size = model_sizes(c->model);
    fault why = {""};
    v->state = kinematics_rest(c->model);
    v->room = calloc((size_t)model_stresses(c->model) + (size_t)(size.free + size.driven) + 1,
                     sizeof *v->room);
    if (v->room == NULL)
        return no_memory(f);
    TRY(matrices(v, 0, f));
    TRY(factor_alloc(&v->K, &v->factor, f));
    c->run->counters.factorisations++;
    const status factored = factor_numeric(v->factor, &v->K, &why);
    if (factored == STATUS_SINGULAR)
        return fault_set(f, STATUS_REFUSED,
                         "damped modes need a stiffness against every motion, and one has none: "
                         "hold the structure, or support it by a soft spring");
    if (factored != STATUS_OK)
        return fault_set(f, factored, "%s", why.text);
    const unsymmetric_problem p = {.K = &v->K,
                                   .M = &v->M,
                                   .C = &v->C,
                                   .B = v->inside ? &v->B : NULL,
                                   .mass = c->scene->analysis[v->analysis].damping.mass,
                                   .stiffness = c->scene->analysis[v->analysis].damping.stiffness,
                                   .K_factor = v->factor,
                                   .wanted = modal_wanted(c, v->analysis),
                                   .estimate = 1,
                                   .decaying = 1};
    const status found = unsymmetric_solve(&p, r, f);
    c->run->counters.solutions += r->solutions;
    return found;
}

status damped_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    unsymmetric_result r = {0};
    outcome_spectrum *out = &o->left.spectrum;
    const status outcome = find_modes(&v, &r, f);
    if (outcome == STATUS_OK) {
        note_growth(c, &r, out);
        out->positive.growth = r.growth;
        flutter_take(&r, &out->positive);
        snprintf(out->meaning, sizeof out->meaning, "%s", v.damped ? "damped" : "");
    }
    unsymmetric_free(&r);
    vibration_free(&v);
    return outcome;
}
