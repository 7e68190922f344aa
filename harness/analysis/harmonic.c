/* Steady small vibration about a state, at each frequency by one solution with the dynamic
 * stiffness
 *   D(w) = K + i w C - w^2 M - (w^2 - i a w)^2/(1 + i b w) B,
 * with proportional damping a M + b K in C, and B the inertia of internal motions of elements of an
 * unstressed structure (field/field.h). In real numbers
 *   [Re D, -Im D; Im D, Re D] [Re x; Im x] = [Re f; Im f].
 * Damped modes are the eigenvectors of D at s = i w. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for a harmonic analysis");
}

/* K of the undeformed structure, or with the stresses of a linear solution. */
static status linear_system_of(vibration *v, const double displaced[], fault *f)
{
    const equations *eq = &v->c->eq;
    TRY(linear_stiffness(eq, &v->K, f));
    if (displaced == NULL) {
        v->inside = !v->plain && rotating_frame_inner_matrix(eq, &v->B);
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
                         "the base state was not reached: %.150s", o->reason);
    v->state = path->state[path->reached - 1];
    const double at = kinematics_state_path(v->state);
    const step_stability stands =
        history_stability_at(c->result, c->scene->analysis[v->analysis].follows, at);
    if (stands == STEP_UNSTABLE || stands == STEP_GROWS)
        return fault_set(f, STATUS_REFUSED,
                         "the state at path %g is unstable: nothing vibrates steadily about it; "
                         "end the path before it",
                         at);
    model_linearisation lin = {.path = at, .K = &v->K, .residual = v->room};
    return linearise_state(&c->eq, &c->run->memory, v->state, &lin, f);
}

/* whole: also of driven coordinates. */
static status matrices(vibration *v, int whole, fault *f)
{
    analysis_context *c = v->c;
    const int follows = c->scene->analysis[v->analysis].follows;
    const sparse *pattern;
    TRY(follows != SCENE_NONE
            ? assemble_pattern_of_states(c->model, c->run->patterns, whole, &pattern, f)
            : assemble_pattern_at_rest(c->model, c->run->patterns, 1, whole, &pattern, f));
    TRY(sparse_alloc_like(pattern, &v->K, f));
    TRY(sparse_alloc_like(pattern, &v->M, f));
    TRY(sparse_alloc_like(pattern, &v->C, f));
    TRY(sparse_alloc_like(pattern, &v->B, f));
    if (follows == SCENE_NONE) {
        if (linear_initial(c->model) > 0)
            return fault_set(f, STATUS_REFUSED,
                             "members have initial strains, whose stresses the undeformed state "
                             "lacks; name a static analysis with 'about'");
        TRY(linear_system_of(v, NULL, f));
    } else if (c->scene->analysis[follows].kind == SCENE_LINEAR) {
        const analysis_outcome *o = &c->outcomes[follows];
        if (o->status != STATUS_OK)
            return fault_set(f, o->status, "its base analysis: %.150s", o->reason);
        TRY(linear_system_of(v, outcome_displacements(o, c->eq.loading.acting), f));
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

/* The free block as a full matrix: first[free + 1] from counts, or its entries. */
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

/* Modes with a damping ratio in a direct solution: one unknown y = i w U^T (x - r) for each, so
 * that D x + U y = f; r: static displacements due to driven coordinates. */
static int bordering(const vibration *v)
{
    const double *U;
    return v->c->scene->analysis[v->analysis].by_modes ? 0 : harmonic_modes_damped(v->modes, &U);
}

/* The entries of column j of one half: rows and, unless z is NULL, their values at w. */
static int column_of(const vibration *v, int j, double w, int row[], double complex z[])
{
    const int n = v->free, more = bordering(v);
    const double *U;
    int count = 0;
    harmonic_modes_damped(v->modes, &U);
    for (int k = j < n ? v->first[j] : 0; j < n && k < v->first[j + 1]; k++) {
        row[count] = v->row[k];
        z[count++] = harmonic_dynamic(v, w, v->source[k]);
    }
    for (int i = 0; j < n && i < more; i++) {
        row[count] = n + i;
        z[count++] = I * w * U[(size_t)i * (size_t)n + (size_t)j];
    }
    for (int i = 0; j >= n && i < n; i++) {
        row[count] = i;
        z[count++] = U[(size_t)(j - n) * (size_t)n + (size_t)i];
    }
    if (j >= n) {
        row[count] = j;
        z[count++] = -1;
    }
    return count;
}

/* D at the frequency; w = 0 also sets its pattern. */
static void fill(vibration *v, double w)
{
    const int n = v->free + bordering(v);
    int at = 0;
    for (int j = 0; j < 2 * n; j++) {
        const int imaginary = j >= n, count = column_of(v, j % n, w, v->rows, v->column);
        v->D.column[j] = at;
        for (int half = 0; half < 2; half++)
            for (int k = 0; k < count; k++) {
                const double complex z = v->column[k];
                v->D.row[at] = half * n + v->rows[k];
                v->D.value[at++] = half == imaginary ? creal(z) : half ? cimag(z) : -cimag(z);
            }
    }
    v->D.column[2 * n] = at;
}

/* Counts, then the starts of columns at first[column + 1], which become the starts of the next
 * ones. */
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
    if (v->row == NULL || v->source == NULL)
        return no_memory(f);
    unfold(v);
    return STATUS_OK;
}

/* The matrix of a direct solution. */
static status make_matrix(vibration *v, fault *f)
{
    const int more = bordering(v), n = v->free + more;
    const size_t entries =
        (size_t)v->first[v->free] + 2 * (size_t)more * (size_t)v->free + (size_t)more;
    v->D = (sparse){.n = 2 * n,
                    .column = calloc(2 * (size_t)n + 1, sizeof(int)),
                    .row = calloc(4 * entries + 1, sizeof(int)),
                    .value = calloc(4 * entries + 1, sizeof(double))};
    v->rows = calloc((size_t)n + 1, sizeof *v->rows);
    v->column = calloc((size_t)n + 1, sizeof *v->column);
    if (v->D.column == NULL || v->D.row == NULL || v->D.value == NULL || v->rows == NULL ||
        v->column == NULL)
        return no_memory(f);
    fill(v, 0);
    return factor_alloc(&v->D, &v->factor, f);
}

static status factor_direct(vibration *v, double w, fault *f)
{
    fill(v, w);
    v->c->run->counters.factorisations++;
    return factor_numeric(v->factor, &v->D, f);
}

static status factor_at(vibration *v, double hertz, fault *f)
{
    fault why = {""};
    const status outcome = v->c->scene->analysis[v->analysis].by_modes
                               ? harmonic_modes_factor(v, 2 * PI * hertz, &why)
                               : factor_direct(v, 2 * PI * hertz, &why);
    if (outcome != STATUS_SINGULAR)
        return outcome == STATUS_OK ? outcome : fault_set(f, outcome, "%s", why.text);
    return fault_set(
        f, STATUS_SINGULAR,
        hertz == 0
            ? "at %g Hz the structure is free to move; start at a higher frequency"
            : "%g Hz is a natural frequency without damping; use another frequency, or add damping",
        hertz);
}

status harmonic_check_motion(const vibration *v, int driver, fault *f)
{
    const model *m = v->c->model;
    for (int i = 0; i < model_scene(m)->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (model_vertex(m, i)->vector_driver[k] == driver)
                return fault_set(f, STATUS_REFUSED,
                                 "motion %s is a component of a rotation vector: drive an angle, "
                                 "or a translation",
                                 model_scene(m)->driver[driver].name);
    return STATUS_OK;
}

/* Right-hand side of an input; a prescribed motion is 1 in x[all]. */
static status input_of(const vibration *v, const scene_response *r, double w, double complex x[],
                       fault *f)
{
    const model *m = v->c->model;
    int index[KINEMATICS_MOST], moves = 0;
    double T[6 * KINEMATICS_MOST];
    memset(x, 0, (size_t)v->all * sizeof *x);
    if (r->driver != SCENE_NONE) {
        const int c = model_driver_coordinate(m, r->driver);
        TRY(harmonic_check_motion(v, r->driver, f));
        for (int k = v->K.column[c]; k < v->K.column[c + 1]; k++)
            if (v->K.row[k] < v->free)
                x[v->K.row[k]] = -harmonic_dynamic(v, w, k);
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
                             "%s is held or driven against the force, which therefore moves "
                             "nothing; name another component, or a motion with 'drive'",
                             scene_called(model_scene(m), SCENE_NODES, r->forced).text);
}

static int same_input(const scene_response *a, const scene_response *b)
{
    return a->driver == b->driver &&
           (a->driver != SCENE_NONE ||
            (a->forced == b->forced && a->forced_along == b->forced_along));
}

/* y[border] of the direct solution, U^T r of the driven coordinate of an input; 0: of a force. */
static int carried_of(const vibration *v, const scene_response *r, double y[])
{
    if (r->driver == SCENE_NONE)
        return 0;
    harmonic_modes_carried(v, model_driver_coordinate(v->c->model, r->driver), y);
    return 1;
}

/* x: forces, replaced by the solution. */
static void solve_direct(vibration *v, const scene_response *r, double w, double complex x[])
{
    const int n = v->free, more = bordering(v), N = n + more;
    const int carried = more > 0 && carried_of(v, r, v->x + N + n);
    for (int i = 0; i < n; i++) {
        v->x[i] = creal(x[i]);
        v->x[N + i] = cimag(x[i]);
    }
    for (int i = 0; i < more; i++) {
        v->x[n + i] = 0;
        v->x[N + n + i] = carried ? w * v->x[N + n + i] : 0;
    }
    factor_solve(v->factor, v->x);
    v->c->run->counters.solutions++;
    for (int i = 0; i < n; i++)
        x[i] = v->x[i] + I * v->x[N + i];
}

/* x: forces, replaced by the modal solution; left[free]: residual of the forces. */
static void solve_by_modes(vibration *v, const scene_response *r, double w, double complex x[],
                           double complex left[])
{
    const double *U;
    const size_t n = (size_t)v->free;
    const int more = harmonic_modes_damped(v->modes, &U);
    memcpy(left, x, n * sizeof *left);
    if (more > 0 && carried_of(v, r, v->x))
        for (size_t i = 0; i < (size_t)more; i++)
            for (size_t k = 0; k < n; k++)
                left[k] += I * w * v->x[i] * U[i * n + k];
    harmonic_modes_solve(v, left, x);
}

/* Solves for the input of a quantity. */
static status solve_own_input(vibration *v, int quantity, double w, fault *f)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    double complex *x = v->found + (size_t)quantity * (size_t)v->all,
                   *left = v->left + (size_t)quantity * (size_t)v->free;
    TRY(input_of(v, r, w, x, f));
    if (s->analysis[v->analysis].by_modes)
        solve_by_modes(v, r, w, x, left);
    else
        solve_direct(v, r, w, x);
    return STATUS_OK;
}

/* The solution for the input of a quantity; reuses that of an earlier quantity with the same input.
 */
static status solve_input(vibration *v, int quantity, double w, fault *f)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    const size_t all = (size_t)v->all;
    double complex *x = v->found + (size_t)quantity * all,
                   *left = v->left + (size_t)quantity * (size_t)v->free;
    for (int i = 0; i < quantity; i++)
        if (scene_asks(&s->quantity[i], v->analysis, SCENE_RESPONSE) &&
            same_input(&s->quantity[i].what.of.response, r)) {
            memcpy(x, v->found + (size_t)i * all, all * sizeof *x);
            memcpy(left, v->left + (size_t)i * (size_t)v->free, (size_t)v->free * sizeof *left);
            return STATUS_OK;
        }
    return solve_own_input(v, quantity, w, f);
}

/* o[all] += times the small motion of a component of a node, in all coordinates. */
static void add_motion(const vibration *v, int node, int component, double times,
                       double complex o[])
{
    int index[KINEMATICS_MOST];
    double T[6 * KINEMATICS_MOST];
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        o[index[k]] += times * T[component * count + k];
}

status harmonic_reacting(const vibration *v, const scene_response *r, int *out, fault *f)
{
    const scene *s = v->c->scene;
    int index[KINEMATICS_MOST], driver = SCENE_NONE, nodes = 0;
    double T[6 * KINEMATICS_MOST];
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, r->node, KINEMATICS_MOST, index, T);
    const int first = r->component - r->component % 3;
    const double rounding = 1e-12;
    double R[9];
    scene_node_axes(&s->node[r->node], R);
    *out = -1;
    for (int k = 0; k < count; k++) {
        double moved = 0; /* along the axes of its supports */
        for (int i = 0; i < 3; i++)
            moved += R[3 * i + r->component % 3] * T[(first + i) * count + k];
        if (fabs(moved) > rounding)
            *out = *out == -1 && index[k] >= v->free ? index[k] : -2;
    }
    for (int i = 0; i < s->drivers && *out >= 0; i++)
        if (model_driver_coordinate(v->c->model, i) == *out)
            driver = i;
    for (int i = 0; i < s->nodes && driver != SCENE_NONE; i++)
        for (int k = 0; k < 3; k++)
            nodes += (s->node[i].translation[k] == driver) + (s->node[i].angle[k] == driver) +
                     2 * (model_vertex(v->c->model, i)->vector_driver[k] == driver);
    for (int i = 0; i < 6 * s->nodes && driver != SCENE_NONE; i++) /* what follows it */
        nodes += model_tie(v->c->model, i / 6, i % 6) != NULL &&
                 model_vertex(v->c->model, i / 6)->coordinate[i % 6] == *out;
    if (driver == SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "a reaction of %s requires a motion that drives this component alone, and "
                         "there is none; replace 'hold' at the node by a motion with value: [0, 0]",
                         scene_called(s, SCENE_NODES, r->node).text);
    return nodes == 1
               ? STATUS_OK
               : fault_set(
                     f, STATUS_REFUSED,
                     "motion %s drives more than the component whose reaction is requested; give "
                     "each component its own motion, or attach the nodes to one driven node",
                     s->driver[driver].name);
}

/* o[all] += row c of D at w. */
static void add_row(const vibration *v, int c, double w, double complex o[])
{
    for (int j = 0; j < v->all; j++)
        for (int k = v->K.column[j]; k < v->K.column[j + 1]; k++) {
            if (v->K.row[k] == c)
                o[j] += harmonic_dynamic(v, w, k);
            else if (j == c && v->K.symmetric)
                o[v->K.row[k]] += harmonic_dynamic(v, w, k);
        }
}

/* What the damping of modes adds to the reaction of a driven coordinate: forces -i w r^T U U^T (x -
 * r of the input). */
static void add_carried(vibration *v, const scene_response *r, int c, double w, double complex o[])
{
    const double *U;
    const int more = harmonic_modes_damped(v->modes, &U), n = v->free;
    double *own = v->x, *input = v->x + n;
    if (more == 0)
        return;
    harmonic_modes_carried(v, c, own);
    for (int i = 0; i < more; i++)
        for (int k = 0; k < n; k++)
            o[k] -= I * w * own[i] * U[(size_t)i * (size_t)n + (size_t)k];
    if (!carried_of(v, r, input))
        return;
    for (int i = 0; i < more; i++)
        o[model_driver_coordinate(v->c->model, r->driver)] += I * w * own[i] * input[i];
}

/* The linear form o of a quantity's displacements: o^T x. */
static void output_of(vibration *v, const scene_response *r, double w, double complex o[])
{
    int c = 0;
    fault unused = {""};
    memset(o, 0, (size_t)v->all * sizeof *o);
    if (r->of == SCENE_REACTING) {
        if (harmonic_reacting(v, r, &c, &unused) == STATUS_OK) {
            add_row(v, c, w, o);
            add_carried(v, r, c, w, o);
        }
        return;
    }
    add_motion(v, r->node, r->component, 1, o);
    if (r->from != SCENE_NONE)
        add_motion(v, r->from, r->component, -1, o);
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

/* Error of the phase of z, whose error is at most `bound`. */
static double bound_of(const scene_response *r, double complex z, double bound)
{
    if (r->part != SCENE_PHASE || bound == 0)
        return bound;
    return bound < cabs(z) ? asin(bound / cabs(z)) : PI;
}

/* The part of the force of 1 that the motion bears whose reaction is read. */
static double force_at(const vibration *v, const scene_response *r)
{
    int index[KINEMATICS_MOST], c = 0;
    double T[6 * KINEMATICS_MOST], sum = 0;
    fault unused = {""};
    if (r->of != SCENE_REACTING || r->driver != SCENE_NONE ||
        harmonic_reacting(v, r, &c, &unused) != STATUS_OK)
        return 0;
    const int count =
        kinematics_node_jacobian(v->c->model, v->state, r->forced, KINEMATICS_MOST, index, T);
    for (int k = 0; k < count; k++)
        sum += index[k] == c ? T[r->forced_along * count + k] : 0;
    return sum;
}

static void read_quantity(vibration *v, int quantity, double w, double *value, double *bound)
{
    const scene *s = v->c->scene;
    const scene_response *r = &s->quantity[quantity].what.of.response;
    const size_t n = (size_t)v->free, all = (size_t)v->all;
    output_of(v, r, w, v->output);
    const double complex times = r->of == SCENE_VELOCITY       ? I * w
                                 : r->of == SCENE_ACCELERATION ? -w * w
                                                               : 1,
                         z = times * dot(all, v->output, v->found + (size_t)quantity * all) -
                             force_at(v, r);
    *value = part_of(r, z);
    *bound = 0;
    if (s->analysis[v->analysis].by_modes && s->analysis[v->analysis].modes > 0) {
        harmonic_modes_solve(v, v->output, v->dual);
        *bound = bound_of(
            r, z, cabs(times) * harmonic_modes_bound(v, v->left + (size_t)quantity * n, v->output));
    }
}

/* One quantity at a frequency; sign * value is to be large. */
static status respond_at(vibration *v, int quantity, double sign, double hertz, outcome_peak *out,
                         fault *f)
{
    const double w = 2 * PI * hertz;
    const int amplitude = v->c->scene->quantity[quantity].what.of.response.part == SCENE_AMPLITUDE;
    *out = (outcome_peak){.hertz = hertz};
    const status factored = factor_at(v, hertz, f);
    if (factored == STATUS_SINGULAR) { /* on an undamped resonance */
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
        TRY(factor_at(v, path->value[i], f));
        for (int k = 0; k < s->quantities; k++)
            if (scene_asks(&s->quantity[k], v->analysis, SCENE_RESPONSE)) {
                const size_t at = (size_t)k * stations + (size_t)i;
                TRY(solve_input(v, k, w, f));
                read_quantity(v, k, w, &o->response[at], &o->bound[at]);
            }
        o->path.value[o->path.reached++] = path->value[i];
    }
    return v->plain ? STATUS_OK : harmonic_extremes_refine(v, respond_at, o, f);
}

enum { SHAPES_OF_MOTION = 4, SHAPES_OF_QUANTITY = 2 * SHAPES_OF_MOTION };

/* Those of a driven coordinate. */
static int shapes_of_motion(const vibration *v, int c, double out[])
{
    const sparse *const by_motion[SHAPES_OF_MOTION] = {&v->K, &v->M, &v->C, &v->B};
    for (int i = 0; i < SHAPES_OF_MOTION; i++)
        for (int k = v->K.column[c]; k < v->K.column[c + 1]; k++)
            if (v->K.row[k] < v->free)
                out[(size_t)i * (size_t)v->free + (size_t)v->K.row[k]] = by_motion[i]->value[k];
    return SHAPES_OF_MOTION;
}

/* The forces of a quantity's input at any frequency, and its output as forces: out[n each]. Returns
 * their number. */
static int shapes_of(vibration *v, const scene_response *r, double out[])
{
    const size_t n = (size_t)v->free;
    fault unused = {""};
    int c, count = 0;
    if (r->driver != SCENE_NONE)
        count += shapes_of_motion(v, model_driver_coordinate(v->c->model, r->driver), out);
    for (int output = r->driver != SCENE_NONE; output < 2; output++) {
        if (output && r->of == SCENE_REACTING) {
            if (harmonic_reacting(v, r, &c, &unused) == STATUS_OK)
                count += shapes_of_motion(v, c, out + (size_t)count * n);
            continue;
        }
        memset(v->output, 0, (size_t)v->all * sizeof *v->output);
        if (output)
            output_of(v, r, 0, v->output);
        else
            add_motion(v, r->forced, r->forced_along, 1, v->output);
        for (size_t k = 0; k < n; k++)
            out[(size_t)count * n + k] = creal(v->output[k]);
        count++;
    }
    return count;
}

/* Every reaction that is asked for is one. */
static status check_reactions(const vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    int c;
    for (int i = 0; i < s->quantities; i++)
        if (scene_asks(&s->quantity[i], v->analysis, SCENE_RESPONSE) &&
            s->quantity[i].what.of.response.of == SCENE_REACTING)
            TRY(harmonic_reacting(v, &s->quantity[i].what.of.response, &c, f));
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
    double *loads = calloc((size_t)s->quantities * SHAPES_OF_QUANTITY * n + 1, sizeof *loads);
    if (loads == NULL)
        return no_memory(f);
    int count = 0;
    for (int i = 0; i < s->quantities; i++)
        if (scene_asks(&s->quantity[i], v->analysis, SCENE_RESPONSE))
            count += shapes_of(v, &s->quantity[i].what.of.response, loads + (size_t)count * n);
    const status outcome = harmonic_modes_project(v, count, loads, f);
    free(loads);
    return outcome;
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
    o->bound = calloc((size_t)s->quantities * stations + 1, sizeof *o->bound);
    o->peak = calloc((size_t)s->quantities + 1, sizeof *o->peak);
    v->x = calloc(4 * (size_t)v->free + 1, sizeof *v->x);
    v->found = calloc((size_t)s->quantities * (size_t)v->all + 1, sizeof *v->found);
    v->left = calloc((size_t)s->quantities * (size_t)v->free + 1, sizeof *v->left);
    v->output = calloc((size_t)v->all + 1, sizeof *v->output);
    v->dual = calloc((size_t)v->all + 1, sizeof *v->dual);
    v->room = calloc((size_t)model_stresses(v->c->model) + (size_t)v->all + 1, sizeof *v->room);
    if (o->path.value == NULL || o->response == NULL || o->bound == NULL || o->peak == NULL ||
        v->x == NULL || v->found == NULL || v->left == NULL || v->output == NULL ||
        v->dual == NULL || v->room == NULL)
        return no_memory(f);
    TRY(matrices(v, 1, f));
    TRY(make_pattern(v, f));
    TRY(check_reactions(v, f));
    TRY(find_modes_of(v, f));
    TRY(harmonic_judge_springs(v, scene_path_of(&s->analysis[v->analysis])->value[stations - 1],
                               f));
    if (!s->analysis[v->analysis].by_modes)
        TRY(make_matrix(v, f));
    return respond(v, o, f);
}

void harmonic_release(vibration *v)
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
    free(v->rows);
    free(v->column);
    free(v->x);
    free(v->found);
    free(v->left);
    free(v->output);
    free(v->dual);
    free(v->room);
    harmonic_modes_free(v->modes);
}

status harmonic_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    vibration v = {.c = c, .analysis = analysis};
    const status outcome = solve(&v, &o->left.harmonic, f);
    harmonic_release(&v);
    return outcome;
}

static status system_of(vibration *v, fault *f)
{
    const model_size size = model_sizes(v->c->model);
    v->free = size.free;
    v->all = size.free + size.driven;
    v->state = kinematics_rest(v->c->model);
    v->room = calloc((size_t)model_stresses(v->c->model) + (size_t)v->all + 1, sizeof *v->room);
    if (v->room == NULL)
        return no_memory(f);
    TRY(matrices(v, 1, f));
    return scene_has_ratios(&v->c->scene->analysis[v->analysis]) ? harmonic_modes_find(v, f)
                                                                 : STATUS_OK;
}

status harmonic_system(analysis_context *c, int analysis, vibration *out, fault *f)
{
    *out = (vibration){.c = c, .analysis = analysis};
    return system_of(out, f);
}

/* Largest difference between two values of a response, relative to the largest of these. */
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
    c->run->counters = before; /* not work of the solution */
    for (int i = 0; outcome == STATUS_OK && i < c->scene->quantities; i++) {
        if (!scene_asks(&c->scene->quantity[i], analysis, SCENE_RESPONSE))
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

static void note_growth(analysis_context *c, const unsymmetric_result *r, outcome_spectrum *out)
{
    for (int i = 0; i < r->count; i++)
        out->growth = fmax(out->growth, r->growth[i]);
    if (out->growth > 0 && c->result->reason[0] == '\0')
        snprintf(c->result->reason, sizeof c->result->reason,
                 "unstable: a damped mode grows at %.4g 1/s", out->growth);
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
                         "damped modes require stiffness against every motion, but one motion has "
                         "none: hold the structure, or support it by a soft spring");
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
    harmonic_release(&v);
    return outcome;
}
