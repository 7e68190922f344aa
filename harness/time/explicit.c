#include "harness/time/time_impl.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

/* Computes dydt at time t [s] for y; the signature is GSL's. */
static int explicit_rates(double t, const double y[], double dydt[], void *context);
/* Checks the model. REFUSED: a coordinate of the undeformed model has no inertia, or a member has
 * an offset or a released end. */
static status explicit_check(const model *, const frame_masses *, fault *);

static double error_of(const explicit_scheme *s)
{
    double square = 0;
    for (int i = 0; i < s->free; i++)
        square += s->weight[i] * s->error[i] * s->error[i];
    return sqrt(square);
}

static int size_of(const explicit_scheme *s)
{
    return 2 * s->free + 2 + feedback_count(&s->of.c->eq);
}

static int advance(explicit_scheme *s, const motion_state *from, double h)
{
    const gsl_odeiv2_system of_motion = {
        .function = explicit_rates, .dimension = (size_t)size_of(s), .params = s};
    memset(s->y, 0, (size_t)s->free * sizeof *s->y);
    memcpy(s->y + s->free, from->v, (size_t)s->free * sizeof *s->y);
    s->y[2 * s->free] = from->work;
    s->y[2 * s->free + 1] = from->dissipated;
    for (int i = 0; i < feedback_count(&s->of.c->eq); i++)
        s->y[2 * s->free + 2 + i] = from->state->feedback[i];
    return gsl_odeiv2_step_apply(s->stepper, from->time, h, s->y, s->error, NULL, s->dydt,
                                 &of_motion);
}

static status step(motion_scheme *base, const motion_state *from, double h, motion_state *to,
                   double *error, step_record *record, fault *f)
{
    explicit_scheme *s = (explicit_scheme *)base;
    const model *m = s->of.c->model;
    s->from = from;
    s->at = to;
    s->end = discontinuities_before(m, record->path);
    s->outcome = STATUS_OK;
    if (s->of.c->run->damping != NULL)
        damping_follow(&s->of.c->eq, 0, s->of.c->run->damping->none, NULL);
    kinematics_state_copy(m, from->state, to->state);
    kinematics_commit(m, to->state);
    if (advance(s, from, h) != GSL_SUCCESS)
        return fault_set(f, s->outcome == STATUS_OK ? STATUS_NOT_CONVERGED : s->outcome, "%s",
                         s->why.text);
    memcpy(to->algorithm, to->a, (size_t)s->all * sizeof *to->a);
    to->time = record->path;
    to->work = s->y[2 * s->free];
    to->dissipated = s->y[2 * s->free + 1];
    for (int i = 0; i < feedback_count(&s->of.c->eq); i++)
        to->state->feedback[i] = s->y[2 * s->free + 2 + i];
    *error = error_of(s);
    record->remaining = 0;
    return STATUS_OK;
}

static void release(motion_scheme *base)
{
    explicit_scheme *s = (explicit_scheme *)base;
    if (s->stepper != NULL)
        gsl_odeiv2_step_free(s->stepper);
    free(s->y);
    free(s);
}

static status allocate(explicit_scheme *s, fault *f)
{
    const model *m = s->of.c->model;
    const size_t n = (size_t)size_of(s), all = (size_t)s->all + 1;
    s->y = calloc(3 * n + 3 * all + (size_t)model_memory(m) + ELEMENT_MAX_STRAINS, sizeof *s->y);
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    s->stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, n);
    gsl_set_error_handler(before);
    if (s->y == NULL || s->stepper == NULL)
        return fault_memory(f, "the time integration");
    s->error = s->y + n;
    s->dydt = s->error + n;
    s->inc = s->dydt + n;
    s->residual = s->inc + all;
    s->weight = s->residual + all;
    s->memory = s->weight + all;
    s->still = s->memory + model_memory(m);
    metric_of(m, s->weight);
    return STATUS_OK;
}

status explicit_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    explicit_scheme *s = calloc(1, sizeof *s);
    *out = NULL;
    if (s == NULL)
        return fault_memory(f, "the time integration");
    *out = &s->base;
    s->base =
        (motion_scheme){.order = 8, .degree = DENSE_OUTPUT_QUINTIC, .step = step, .free = release};
    s->of = *request;
    s->free = size.free;
    s->all = size.free + size.driven;
    TRY(explicit_check(request->c->model, request->masses, f));
    return allocate(s, f);
}

/* Computes the mass matrix M[count x count] of the free coordinates of a frame, and their indices
 * of[count]. Returns count. */
static int block(const model *m, const frame_masses *masses, int index, const model_state *s,
                 const double v[], int of[6], double M[36])
{
    const int *at = model_vertex(m, masses->mass[index].frame)->coordinate;
    inertia_parts p;
    double K[36];
    int row[6], count = 0;
    inertia_frame(m, masses, index, s, v, NULL, &p);
    inertia_times(p.acceleration, 1, p.rate, K);
    inertia_finish(m, masses, index, &p, 0, 0, K);
    for (int i = 0; i < 6; i++)
        if (at[i] != NONE && at[i] < model_unknowns(m)) {
            of[count] = at[i];
            row[count++] = i;
        }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            M[count * i + j] = K[6 * row[i] + row[j]];
    return count;
}

static status accelerate_joined(const model *m, const frame_masses *masses, int body,
                                const model_state *s, const double residual[], body_mass *g,
                                double a[], fault *f)
{
    body_mass_of(m, masses, body, s, g);
    for (int k = 0; k < g->count; k++)
        g->value[k] = g->unit[k] * residual[g->index[k]];
    if (g->count > 0 && dense_lu_regular(g->count, g->M, g->used) != 0)
        return fault_set(
            f, STATUS_SINGULAR,
            "%s: two of its rotation axes coincide (gimbal lock); give another sequence of angles",
            scene_called(model_scene(m), SCENE_NODES, body).text);
    dense_lu_solve(g->count, 1, g->M, g->used, g->value);
    for (int k = 0; k < g->count; k++)
        a[g->index[k]] = g->unit[k] * g->value[k];
    for (int i = body; i != NONE; i = model_next_joined(m, i)) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9], own[3];
        if (forms_of(m, i) != FORM_BODY || at[0] >= model_unknowns(m) ||
            !model_owns(m, i, SCENE_RX))
            continue;
        const double turning[3] = {a[at[0]], a[at[1]], a[at[2]]};
        rotation_matrix(&s->q[4 * i], R);
        mat3_transpose_mul_vec(R, turning, own);
        for (int k = 0; k < 3; k++)
            a[at[k]] = own[k];
    }
    return STATUS_OK;
}

static void accelerate_warps(const model *m, const frame_masses *masses, const double residual[],
                             double a[])
{
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        if (c < model_unknowns(m))
            a[c] = residual[c] / masses->warping[c];
    }
}

static status accelerate_together(const model *m, const frame_masses *masses, const model_state *s,
                                  const double residual[], double a[], fault *f)
{
    body_mass g;
    TRY(body_mass_alloc(m, &g, f));
    status outcome = STATUS_OK;
    for (int i = 0; i < model_vertices(m) && outcome == STATUS_OK; i++)
        if (model_vertex(m, i)->body == i && model_first_joined(m, i) == i)
            outcome = accelerate_joined(m, masses, i, s, residual, &g, a, f);
    body_mass_free(&g);
    accelerate_warps(m, masses, residual, a);
    return outcome;
}

/* Computes a[free] = M^-1 residual. The residual contains the forces due to prescribed
 * accelerations in a. SINGULAR: two axes of a sequence of angles coincide. */
static status explicit_accelerate(const model *m, const frame_masses *masses, const model_state *s,
                                  const double v[], const double residual[], double a[], fault *f)
{
    if (model_mesh_of(m)->joined != NULL)
        return accelerate_together(m, masses, s, residual, a, f);
    for (int k = 0; k < masses->masses; k++) {
        int of[6], pivot[6];
        double M[36], b[6];
        const int n = block(m, masses, k, s, v, of, M);
        for (int i = 0; i < n; i++)
            b[i] = residual[of[i]];
        if (dense_lu_regular(n, M, pivot) != 0)
            return fault_set(f, STATUS_SINGULAR,
                             "%s: two of its rotation axes coincide (gimbal lock); give another "
                             "sequence of angles",
                             scene_called(model_scene(m), SCENE_NODES, masses->mass[k].frame).text);
        dense_lu_solve(n, 1, M, pivot, b);
        for (int i = 0; i < n; i++)
            a[of[i]] = b[i];
    }
    accelerate_warps(m, masses, residual, a);
    return STATUS_OK;
}

/* Returns 1 if every motion of the coordinates has kinetic energy. M[n x n] is overwritten. */
static int is_heavy(int n, double M[])
{
    const double rounding = 1e-13;
    double size[6];
    for (int i = 0; i < n; i++)
        size[i] = sqrt(fmax(M[n * i + i], 0));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            M[n * i + j] = size[i] > 0 && size[j] > 0 ? M[n * i + j] / (size[i] * size[j]) : 0;
    if (dense_cholesky(n, M) != 0)
        return 0;
    for (int i = 0; i < n; i++)
        if (M[n * i + i] * M[n * i + i] < rounding)
            return 0;
    return 1;
}

static status refuse(const model *m, int vertex, const char *what, fault *f)
{
    scene_words whose = {"a node inside a member"};
    if (vertex < model_scene(m)->nodes)
        whose = scene_called(model_scene(m), SCENE_NODES, vertex);
    return fault_set(f, STATUS_REFUSED,
                     "integrator explicit: the %s of %s has no inertia, so its acceleration is not "
                     "determined; add a mass or an inertia (members: do not omit rotary_inertia), "
                     "or use alpha, conserving or radau",
                     what, whose.text);
}

static status refuse_warping(const model *m, int warp, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "integrator explicit: %s; use alpha%s or radau",
                     model_mesh_of(m)->warp[warp].scalar
                         ? "the additional unknowns of the formulation have no inertia"
                         : "warping has no inertia",
                     model_scalars(m) > 0 ? "" : ", conserving");
}

static status check_vertex(const model *m, int index, const int heavy[], fault *f)
{
    const mesh_vertex *v = model_vertex(m, index);
    for (int c = 0; c < VERTEX_COORDINATES; c++)
        if (v->coordinate[c] != NONE && v->coordinate[c] < model_unknowns(m) &&
            !heavy[v->coordinate[c]])
            return refuse(m, index, c < SCENE_RX ? "place" : "rotation", f);
    return STATUS_OK;
}

static void mark(const model *m, const frame_masses *masses, const double rest[], int heavy[])
{
    for (int k = 0; k < masses->masses; k++) {
        int of[6];
        double M[36];
        const int n = block(m, masses, k, kinematics_rest(m), rest, of, M);
        for (int i = 0; i < n; i++) {
            double some[36];
            for (int r = 0; r <= i; r++)
                memcpy(&some[(i + 1) * r], &M[n * r], (size_t)(i + 1) * sizeof *some);
            heavy[of[i]] = is_heavy(i + 1, some);
        }
    }
    for (int w = 0; w < model_warps(m); w++)
        heavy[model_warp(m, w)] = masses->warping[model_warp(m, w)] > 0;
}

static status check_joined(const model *m, const frame_masses *masses, fault *f)
{
    const double rounding = 1e-13;
    status outcome = STATUS_OK;
    body_mass g;
    TRY(body_mass_alloc(m, &g, f));
    for (int i = 0; i < model_vertices(m) && outcome == STATUS_OK; i++) {
        if (model_vertex(m, i)->body != i || model_first_joined(m, i) != i)
            continue;
        const double largest = body_mass_of(m, masses, i, kinematics_rest(m), &g);
        if (body_mass_rank(&g, rounding * largest) < g.count)
            outcome = refuse(m, i, "place or rotation", f);
    }
    for (int w = 0; w < model_warps(m) && outcome == STATUS_OK; w++)
        if (model_warp(m, w) < model_unknowns(m) && !(masses->warping[model_warp(m, w)] > 0))
            outcome = refuse_warping(m, w, f);
    body_mass_free(&g);
    return outcome;
}

static status explicit_check(const model *m, const frame_masses *masses, fault *f)
{
    const size_t all = (size_t)model_all_coordinates(m) + 1;
    for (int i = 0; i < model_scene(m)->members; i++)
        if (scene_is_beside(&model_scene(m)->member[i], 0) ||
            scene_is_beside(&model_scene(m)->member[i], 1))
            return fault_set(f, STATUS_REFUSED,
                             "integrator explicit: %s has an offset, which this integrator does "
                             "not support; end the member at a node that is part_of the other "
                             "node, or use alpha, conserving or radau",
                             scene_called(model_scene(m), SCENE_MEMBERS, i).text);
    if (model_releases(m) > 0)
        return fault_set(f, STATUS_REFUSED,
                         "integrator explicit: released ends of members have no inertia; use "
                         "alpha, conserving or radau");
    if (model_mesh_of(m)->joined != NULL)
        return check_joined(m, masses, f);
    int *heavy = calloc(all, sizeof *heavy);
    double *rest = calloc(all, sizeof *rest);
    status outcome =
        heavy != NULL && rest != NULL ? STATUS_OK : fault_memory(f, "the time integration");
    if (outcome == STATUS_OK)
        mark(m, masses, rest, heavy);
    for (int i = 0; i < model_vertices(m) && outcome == STATUS_OK; i++)
        if (model_vertex(m, i)->body == i)
            outcome = check_vertex(m, i, heavy, f);
    for (int w = 0; w < model_warps(m) && outcome == STATUS_OK; w++)
        if (model_warp(m, w) < model_unknowns(m) && !heavy[model_warp(m, w)])
            outcome = refuse_warping(m, w, f);
    free(heavy);
    free(rest);
    return outcome;
}

/* Computes inc' = X v. For rotations in the axes of a frame, X is rotation_rates_inverse; otherwise
 * X = 1. */
static void turn_rates(const explicit_scheme *s, const double inc[], const double v[],
                       double rate[])
{
    const model *m = s->of.c->model;
    memcpy(rate, v, (size_t)s->free * sizeof *rate);
    for (int x = 0; x < model_first_release(m); x++) {
        const mesh_vertex *frame = model_vertex(m, x);
        const int *at = frame->coordinate + SCENE_RX;
        double t[3], W[3], inverse[9], turned[3];
        if (frame->body != x || forms_of(m, x) != FORM_BODY || at[0] >= s->free)
            continue;
        for (int k = 0; k < 3; k++) {
            t[k] = inc[at[k]];
            W[k] = v[at[k]];
        }
        rotation_rates_inverse(t, inverse);
        mat3_mul_vec(inverse, W, turned);
        for (int k = 0; k < 3; k++)
            rate[at[k]] = turned[k];
    }
}

static status consistent_rates(const explicit_scheme *s, int i, double time, fault *f)
{
    enum { MOST = 30 };
    const double none = 1e-15;
    const model *m = s->of.c->model;
    const element_data *data = free_strain_data(&s->of.c->eq, i, time);
    const double *e = s->at->state->e + (size_t)i * (size_t)model_strains(m);
    double *inner = s->at->state->inner + (size_t)i * (size_t)model_inner(m), before = INFINITY;
    for (int k = 0; k < MOST; k++) {
        s->of.c->run->counters.stress_evaluations++;
        model_type(m)->stress(data, e, inner, &(stress_output){.memory = s->memory});
        const double change = model_type(m)->update(data, s->still, s->memory, inner);
        if (change < none || (k > 3 && change < 1e-9 && change >= before))
            return STATUS_OK;
        before = change;
    }
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "element %d: its internal equations were not solved in %d iterations; use a smaller step",
        i, MOST);
}

static status accelerations(explicit_scheme *s, double time, fault *f)
{
    const model *m = s->of.c->model;
    model_linearisation lin = {.path = time, .residual = s->residual};
    for (int i = 0; i < model_elements(m) && model_inner(m) > 0; i++) {
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s->at->state, model_element(m, i), x);
        s->of.c->run->counters.strain_evaluations++;
        model_type(m)->strain(
            model_kind_of(m, i)->data, x,
            &(strain_output){.e = s->at->state->e + (size_t)i * (size_t)model_strains(m),
                             .history = model_history_of(m, s->at->state, i)});
        free_strain_subtract(&s->of.c->eq, i, time,
                             s->at->state->e + (size_t)i * (size_t)model_strains(m));
        TRY(consistent_rates(s, i, time, f));
    }
    TRY(linearise_make_compatible(&s->of.c->eq, s->at->state, f));
    feedback_take(&s->of.c->eq, s->at->state, s->at->v, time);
    TRY(linearise_state(&s->of.c->eq, &s->of.c->run->memory, s->at->state, &lin, f));
    memset(s->at->a, 0, (size_t)s->free * sizeof *s->at->a);
    inertia_subtract(m, s->of.masses, s->at->state, s->at->v, s->at->a, s->residual);
    s->power = dashpots_subtract(m, s->at->state, s->at->v, s->of.work->dashpots, s->residual) +
               springs_circulating_power(m, s->at->state, s->at->v, s->of.work->dashpots);
    return explicit_accelerate(m, s->of.masses, s->at->state, s->at->v, s->residual, s->at->a, f);
}

static int is_finite(int n, const double y[])
{
    for (int i = 0; i < n; i++)
        if (!isfinite(y[i]))
            return 0;
    return 1;
}

static int explicit_rates(double t, const double y[], double dydt[], void *context)
{
    explicit_scheme *s = context;
    const model *m = s->of.c->model;
    const double time = t > s->from->time ? fmin(t, s->end) : t;
    if (!is_finite(size_of(s), y)) {
        s->outcome = fault_set(&s->why, STATUS_NOT_CONVERGED,
                               "at %g s displacements grow without bound, because the step does "
                               "not resolve the fastest mode of the mesh; use a smaller step",
                               t);
        return GSL_EFAILED;
    }
    memcpy(s->inc, y, (size_t)s->free * sizeof *s->inc);
    memcpy(s->at->v, y + s->free, (size_t)s->free * sizeof *s->at->v);
    drive_at(&s->of.c->eq, s->from->state, time, s->inc, s->at->v, s->at->a);
    increment_apply(m, s->from->state, s->inc, time, s->at->state);
    for (int i = 0; i < feedback_count(&s->of.c->eq); i++)
        s->at->state->feedback[i] = y[2 * s->free + 2 + i];
    feedback_errors(&s->of.c->eq, s->at->state, time, dydt + 2 * s->free + 2);
    s->outcome = accelerations(s, time, &s->why);
    if (s->outcome != STATUS_OK)
        return GSL_EFAILED;
    turn_rates(s, s->inc, s->at->v, dydt);
    memcpy(dydt + s->free, s->at->a, (size_t)s->free * sizeof *dydt);
    dydt[2 * s->free] = work_power(s->of.work, s->at->state, s->at->v, s->at->a, time, s->at->v) +
                        free_strain_power(&s->of.c->eq, s->at->state, time);
    dydt[2 * s->free + 1] =
        s->power + inertia_damping_power(m, s->of.masses, s->at->state, s->at->v);
    return GSL_SUCCESS;
}

static int is_driven(const model *m, const mesh_element *el)
{
    for (int k = 0; k < el->columns; k++)
        if (el->index[k] >= model_unknowns(m))
            return 1;
    return 0;
}

status work_alloc(const equations *eq, const frame_masses *masses, outer_work *w, fault *f)
{
    const model *m = eq->m;
    *w = (outer_work){
        .eq = eq,
        .m = m,
        .masses = masses,
        .force = calloc(2 * (size_t)model_all_coordinates(m) + dashpots_room(m), sizeof *w->force),
        .element = calloc((size_t)model_elements(m) + 1, sizeof *w->element)};
    if (w->force == NULL || w->element == NULL)
        return fault_memory(f, "the work of the loads");
    w->holding = w->force + model_all_coordinates(m);
    w->dashpots = w->holding + model_all_coordinates(m);
    for (int i = 0; i < model_elements(m); i++)
        if (is_driven(m, model_element(m, i)))
            w->element[w->elements++] = i;
    return STATUS_OK;
}

void work_free(outer_work *w)
{
    free(w->force);
    free(w->element);
}

static double product(const outer_work *w, const model_state *s, const double along[])
{
    const model *m = w->m;
    double sum = dense_dot(model_all_coordinates(m), w->force, along);
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        double R[9], own[3], moment[3], turned[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY || !model_owns(m, i, SCENE_RX))
            continue;
        rotation_matrix(&s->q[4 * i], R);
        for (int k = 0; k < 3; k++) {
            own[k] = along[at[k]];
            moment[k] = w->force[at[k]];
        }
        mat3_mul_vec(R, own, turned);
        sum += vec3_dot(moment, turned) - vec3_dot(moment, own);
    }
    return sum;
}

/* Computes the external forces on prescribed coordinates (loads and reactions) as the sum of
 * internal, dashpot and inertia forces. */
static void hold(outer_work *w, const model_state *s, const double v[], const double a[])
{
    const model *m = w->m;
    const int all = model_all_coordinates(m);
    memset(w->holding, 0, (size_t)all * sizeof *w->holding);
    inertia_subtract(m, w->masses, s, v, a, w->holding);
    dashpots_subtract(m, s, v, w->dashpots, w->holding);
    for (int c = 0; c < all; c++)
        w->holding[c] = -w->holding[c];
    linearise_add_internal(w->eq, s, w->elements, w->element, w->holding);
    memcpy(w->force + model_unknowns(m), w->holding + model_unknowns(m),
           (size_t)model_driven(m) * sizeof *w->force);
}

double work_power(outer_work *w, const model_state *s, const double v[], const double a[],
                  double time, const double along[])
{
    const model *m = w->m;
    memset(w->force, 0, (size_t)model_all_coordinates(m) * sizeof *w->force);
    feedback_take(w->eq, s, v, time);
    for (int i = 0; i < model_scene(m)->loads; i++)
        loads_add_one(w->eq, s, &model_scene(m)->load[i],
                      applied_factor(w->eq, &model_scene(m)->load[i], time), w->force);
    if (model_driven(m) > 0)
        hold(w, s, v, a);
    return product(w, s, along);
}

double work_trapezoid(outer_work *w, const motion_state *from, const motion_state *to,
                      const double inc[])
{
    return (work_power(w, from->state, from->v, from->a, from->time, inc) +
            work_power(w, to->state, to->v, to->a, discontinuities_before(w->m, to->time), inc)) /
               2 +
           free_strain_work(w->eq, from->state, from->time, to->state,
                            discontinuities_before(w->m, to->time));
}

static double first_behind(const scene_function *f, double time)
{
    double next = INFINITY;
    for (int i = 0; i < f->pieces - 1; i++)
        if (f->piece[i].until > time && f->piece[i].until < next)
            next = f->piece[i].until;
    return next;
}

double discontinuities_next(const model *m, double time)
{
    const scene *s = model_scene(m);
    double next = INFINITY;
    for (int i = 0; i < s->loads; i++)
        next = fmin(next, first_behind(&s->load[i].function, time));
    for (int i = 0; i < s->drivers; i++)
        next = fmin(next, first_behind(&s->driver[i].function, time));
    return next;
}

double discontinuities_before(const model *m, double time)
{
    const double before = nextafter(time, -INFINITY);
    return discontinuities_next(m, before) == time ? before : time;
}
