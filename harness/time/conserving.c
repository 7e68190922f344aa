#include "harness/time/time_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/math/vec3.h"

/* Finds the rotations without inertia. REFUSED: rotations of masses are free, but none has inertia.
 */
static status conserving_massless(conserving *, fault *);
static void conserving_rates(conserving *, const motion_state *from, double h, motion_state *to);

enum { LEAST_ITERATIONS = 3 };

static status direction(conserving *s, const motion_state *from, model_state *now, double h,
                        step_record *record, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    memset(s->residual, 0, bytes);
    memset(s->column, 0, bytes);
    memset(s->row, 0, bytes);
    sparse_zero(&s->S);
    record->incompatibility = 0;
    conserving_forces(s, from, now, &record->incompatibility);
    conserving_inertia(s, from, now, h);
    conserving_loads(s, from, now, h, s->residual);
    for (int c = 0; c < s->free; c++)
        s->residual[c] -= s->missing * s->column[c];
    TRY(context_factor(s->of.c, s->factor, &s->S, f));
    memcpy(s->dx, s->residual, (size_t)s->free * sizeof *s->dx);
    memset(s->dx + s->free, 0, (size_t)(s->all - s->free) * sizeof *s->dx);
    factor_solve(s->factor, s->dx);
    if (s->k != 0) {
        factor_solve(s->factor, s->column);
        const double part =
            dense_dot(s->free, s->row, s->dx) / (1 + dense_dot(s->free, s->row, s->column));
        for (int c = 0; c < s->free; c++)
            s->dx[c] -= part * s->column[c];
    }
    context_count_factorisations(s->of.c, s->factor, &s->counted);
    return STATUS_OK;
}

static double size_of(const conserving *s)
{
    const model *m = s->of.c->model;
    double largest = 0;
    for (int i = 0; i < model_first_release(m); i++)
        for (int c = 0; c < 6 && model_vertex(m, i)->body == i; c++) {
            const int at = model_vertex(m, i)->coordinate[c];
            if (at != NONE)
                largest = larger(largest, fabs(s->dx[at]) / (c < 3 ? model_length(m) : 1));
        }
    for (int i = 0; i < model_warps(m); i++)
        largest = larger(largest, fabs(s->dx[model_warp(m, i)]) * model_length(m));
    return largest;
}

typedef struct solution {
    conserving *s;
    const motion_state *from;
    motion_state *to;
    double time;
} solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    const solution *one = of;
    conserving *s = one->s;
    const model_state *from = one->from->state;
    model_state *now = one->to->state;
    double *inc = one->to->algorithm;
    TRY(conserving_stresses(s, one->from, now, iteration, f));
    TRY(direction(s, one->from, now, s->h, record, f));
    strain_update_begin(s->strain_update, now);
    const double inner = conserving_update(s, one->from, now);
    for (int c = 0; c < s->free; c++)
        s->step[c] += s->dx[c];
    conserving_increment(s, from, inc);
    increment_apply(s->of.c->model, from, inc, one->time, now);
    out->at = one->time;
    out->size = larger(inner, size_of(s));
    out->stress = (advance_stress){s->largest, s->change};
    return STATUS_OK;
}

static void prepare(void *of, int iteration, double correction)
{
    const solution *one = of;
    strain_update_apply(one->s->strain_update, one->to->state, iteration, correction);
}

static status accept(void *of, fault *f)
{
    const solution *one = of;
    return one->s->wild ? fault_set(f, STATUS_NOT_CONVERGED,
                                    "strains change too much in the step to %g s to conserve "
                                    "energy; use a shorter step",
                                    one->time)
                        : STATUS_OK;
}

static status step(motion_scheme *base, const motion_state *from, double h, motion_state *to,
                   double *error, step_record *record, fault *f)
{
    conserving *s = (conserving *)base;
    const model *m = s->of.c->model;
    double *inc = to->algorithm;
    *error = 0;
    s->h = h;
    kinematics_state_copy(m, from->state, to->state);
    conserving_predict(s, from, h);
    conserving_increment(s, from->state, inc);
    increment_apply(m, from->state, inc, record->path, to->state);
    TRY(conserving_begin(s, from, f));
    motion_state_recall(from, &s->newton_convergence);
    solution one = {s, from, to, record->path};
    newton_use use = newton_in_time(s->of.c, &one, correct, prepare);
    use.accept = accept;
    use.least = LEAST_ITERATIONS;
    TRY(newton_iterate(s->of.c, &use, &s->newton_convergence, record, f));
    motion_state_store(&s->newton_convergence, to);
    TRY(conserving_work(s, from, to, h, f));
    conserving_rates(s, from, h, to);
    drive_at(&s->of.c->eq, from->state, record->path, NULL, to->v, to->a);
    conserving_free_rates(s, from, h, to);
    conserving_damped(s, from, h, to);
    to->time = record->path;
    to->work += conserving_impulses(s, from, h, to);
    if (!s->massive.ready)
        TRY(massive_of(m, s->of.masses, from->state, &s->massive, f));
    s->base.light = s->massive.light;
    for (int c = 0; c < s->free; c++)
        s->dx[c] = h * h / 12 * (to->a[c] - from->a[c]);
    *error = massive_norm(&s->massive, m, s->weight, s->dx);
    return STATUS_OK;
}

static void release(motion_scheme *base)
{
    conserving *s = (conserving *)base;
    sparse_free_values(&s->S);
    factor_free(s->factor);
    free(s->step);
    free(s->W);
    free(s->deformable_values);
    strain_update_free(s->strain_update);
    massive_free(&s->massive);
    frame_masses_free(&s->masses);
    free(s);
}

/* Checks the rotations. REFUSED: a node rotates by a sequence of two angles, and both are free. */
static status check(const model *m, fault *f)
{
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        const mesh_vertex *v = model_vertex(m, i);
        int free = 0;
        for (int k = 0; k < v->angles; k++)
            free += v->coordinate[SCENE_RX + k] != NONE &&
                    v->coordinate[SCENE_RX + k] < model_unknowns(m);
        if (v->angles == 2 && free == 2)
            return fault_set(
                f, STATUS_REFUSED,
                "%s rotates by two free angles, but the integrator conserving supports only one or "
                "three free angles, or driven angles; use alpha or radau",
                scene_called(model_scene(m), SCENE_NODES, i).text);
    }
    return STATUS_OK;
}

static int turns_freely(const model *m, int vertex)
{
    int free = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ; c++)
        free += model_vertex(m, vertex)->coordinate[c] != NONE &&
                model_vertex(m, vertex)->coordinate[c] < model_unknowns(m);
    return free > 0;
}

static int leads(const model *m, int node)
{
    for (int i = 0; i < model_scene(m)->constraints; i++)
        if (model_scene(m)->constraint[i].master == node)
            return 1;
    return 0;
}

static status refuse_constraint(const model *m, int node, const char *why, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "the integrator conserving does not support %s (%s); use alpha or radau", why,
                     scene_called(model_scene(m), SCENE_NODES, node).text);
}

/* Checks the constraints. REFUSED: the rates at the end of a step would violate a constraint. */
static status check_constraints(const model *m, const frame_masses *masses, fault *f)
{
    if (model_mesh_of(m)->joined == NULL)
        return STATUS_OK;
    for (int i = 0; i < VERTEX_COORDINATES * model_scene(m)->nodes; i++) {
        const int node = i / VERTEX_COORDINATES, c = i % VERTEX_COORDINATES;
        const scene_tie *tie = model_tie(m, node, c);
        if (tie == NULL || c < SCENE_RX)
            continue;
        if (tie->ratio != 1)
            return refuse_constraint(m, node, "rotations in a ratio", f);
        if (model_vertex(m, node)->leader != NONE || leads(m, node))
            for (int k = SCENE_RY; k <= SCENE_RZ; k++)
                if (model_vertex(m, node)->coordinate[k] != NONE)
                    return refuse_constraint(m, node, "nodes of a diaphragm that tilt", f);
        if ((model_vertex(m, node)->angles > 0) != (model_vertex(m, tie->node)->angles > 0))
            return refuse_constraint(m, node, "equal rotations of nodes with and without axes", f);
    }
    for (int k = 0; k < masses->masses; k++) {
        const int node = masses->mass[k].frame;
        int tied = 0;
        for (int c = 0; c < SCENE_RX && node < model_scene(m)->nodes; c++)
            tied |= model_tie(m, node, c) != NULL && !leads(m, node);
        if (tied && turns_freely(m, node) &&
            vec3_norm(masses->mass[k].moment) > 1e-12 * masses->mass[k].mass * model_length(m))
            return refuse_constraint(
                m, node, "constrained translations of a node that rotates with an eccentric mass",
                f);
    }
    return STATUS_OK;
}

static status allocate(conserving *s, fault *f)
{
    const model *m = s->of.c->model;
    const sparse *pattern;
    TRY(frame_masses_diaphragms(m, s->of.masses, &s->masses, f));
    s->of.masses = &s->masses;
    s->strains = model_springs(m) > 0 && model_strains(m) < SPRING_STRAINS ? SPRING_STRAINS
                                                                           : model_strains(m);
    const int nodes = model_nodes(m) > 2 || model_springs(m) == 0 ? model_nodes(m) : 2;
    const size_t all = (size_t)s->all + 1, count = (size_t)deformable_count(s) + 1,
                 strains = (size_t)s->strains,
                 elastic = s->of.c->run->damping != NULL
                               ? (size_t)(model_elements(m) * model_strains(m))
                               : 0;
    s->slot_size = s->strains * (NODE_COORDINATES * nodes + s->strains + 3) + model_memory(m) + 1;
    s->step = calloc(6 * all, sizeof *s->step);
    s->W = calloc(count * (2 * strains * strains + 1 + strains + (size_t)s->slot_size) +
                      (size_t)(4 * SPRING_STRAINS * model_springs(m)) +
                      (size_t)(9 * s->of.masses->masses) + elastic,
                  sizeof *s->W);
    if (s->of.c->options->newton != NEWTON_DISPLACEMENT)
        TRY(strain_update_alloc(&s->of.c->eq, &s->strain_update, f));
    s->deformable_values = malloc((size_t)chunk_size(m) * sizeof *s->deformable_values);
    if (s->step == NULL || s->W == NULL || s->deformable_values == NULL)
        return fault_memory(f, "the time integration");
    s->residual = s->step + all;
    s->column = s->residual + all;
    s->row = s->column + all;
    s->dx = s->row + all;
    s->weight = s->dx + all;
    s->C = s->W + count * strains * strains;
    s->energy = s->C + count * strains * strains;
    s->d = s->energy + count;
    s->slot = s->d + count * strains;
    s->spring = s->slot + count * (size_t)s->slot_size;
    s->massless = s->spring + (size_t)(4 * SPRING_STRAINS * model_springs(m));
    if (elastic > 0)
        s->elastic = s->massless + (size_t)(9 * s->of.masses->masses);
    TRY(check_constraints(m, s->of.masses, f));
    TRY(conserving_massless(s, f));
    metric_of(m, s->weight);
    TRY(assemble_pattern_in_time(s->of.c->model, s->of.c->run->patterns, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    return factor_alloc_copies(pattern, 1, &s->factor, f);
}

status conserving_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    *out = NULL;
    TRY(check(request->c->model, f));
    conserving *s = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_memory(f, "the time integration");
    *out = &s->base;
    s->base = (motion_scheme){.order = 3, .adds = 1, .step = step, .free = release};
    s->of = *request;
    s->free = size.free;
    s->all = size.free + size.driven;
    newton_convergence_start(request->c->options->criterion, model_leaves(request->c->model) != 0,
                             size.elements, &s->newton_convergence);
    return allocate(s, f);
}

enum { BALL = 3 };

/* Computes N, the projection onto the axes about which J[9] is zero. Returns the number of these
 * axes. */
static int null_space(const double J[9], double N[9])
{
    const double nothing = 1e-12;
    double A[9], value[3];
    int count = 0;
    memset(N, 0, 9 * sizeof *N);
    memcpy(A, J, sizeof A);
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', 3, A, 3, value);
    for (int k = 0; k < 3; k++) {
        if (value[k] > nothing * value[2])
            continue;
        count++;
        for (int i = 0; i < 9; i++)
            N[i] += A[3 * (i / 3) + k] * A[3 * (i % 3) + k];
    }
    return count;
}

static status conserving_massless(conserving *s, fault *f)
{
    const model *m = s->of.c->model;
    int heavy = 0, turning = 0;
    for (int k = 0; k < s->of.masses->masses; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        double centre[3], J[9];
        frame_mass_step_centre(m, one, centre, J);
        heavy += null_space(J, s->massless + (size_t)(9 * k)) < 3;
        turning += turns_freely(m, one->frame);
    }
    return heavy > 0 || turning == 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "no rotation has inertia, but the integrator conserving requires such a "
                           "rotation; use alpha or radau, or give the sections rotary inertia");
}

static void angle_rates(const model *m, int vertex, motion_state *to, const double w[3])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const int n = v->angles;
    double b[3][3], square[9], rate[3];
    if (n == 0)
        return;
    kinematics_axes(m, to->state, vertex, b);
    for (int i = 0; i < n; i++) {
        rate[i] = vec3_dot(b[i], w);
        for (int k = 0; k < n; k++)
            square[i * n + k] = vec3_dot(b[i], b[k]);
    }
    if (n > 1) {
        int pivot[3];
        if (dense_lu_regular(n, square, pivot) != 0)
            return; /* two axes coincide */
        dense_lu_solve(n, 1, square, pivot, rate);
    }
    for (int k = 0; k < n; k++) {
        const int at = v->coordinate[SCENE_RX + k];
        if (at != NONE && at < model_unknowns(m))
            to->v[at] = rate[k];
    }
}

/* Replaces the rates of motions without inertia by the mean rates of the step; otherwise they would
 * change sign in every step. N[9]: projection onto the rotations without inertia; NULL: no rotation
 * has inertia. */
static void without_inertia(const frame_mass *one, const double N[9], frame_mass_step *p)
{
    double mean[3], back[3];
    for (int i = 0; i < 3; i++) {
        mean[i] = (p->W0[i] + p->W1[i]) / 2 - p->W1[i];
        p->v1[i] = one->mass > 0 ? p->v1[i] : (p->v0[i] + p->v1[i]) / 2;
    }
    if (N != NULL)
        mat3_mul_vec(N, mean, back);
    else
        memcpy(back, mean, sizeof back);
    for (int i = 0; i < 3; i++)
        p->W1[i] += back[i];
}

static void heavy_ones(const model *m, const frame_mass *one, const frame_mass_step *p,
                       const model_state *s, int heavy[6])
{
    const double nothing = 1e-12;
    double b[3][3];
    release_turn_axes(m, s, one->frame, b);
    for (int i = 0, turns = 0; i < 3; i++) {
        double body[3];
        heavy[i] = one->mass > 0;
        heavy[3 + i] = 0;
        if (model_vertex(m, one->frame)->coordinate[3 + i] == NONE)
            continue;
        mat3_transpose_mul_vec(p->R1, b[turns++], body);
        heavy[3 + i] = dense_quadratic(3, one->inertia, body) >
                       nothing * (one->inertia[0] + one->inertia[4] + one->inertia[8]);
    }
}

/* Computes the velocities of the masses at released ends, and the rates of the released
 * coordinates. The velocities are separate unknowns, so that energy and momenta of these masses are
 * conserved. */
static void conserving_released_rates(const conserving *s, const motion_state *from, double h,
                                      motion_state *to)
{
    const model *m = s->of.c->model;
    const frame_masses *all = s->of.masses;
    for (int k = 0; k < all->masses; k++) {
        const frame_mass *one = &all->mass[k];
        const int *at = model_vertex(m, one->frame)->coordinate;
        frame_mass_step p;
        int heavy[6];
        if (one->frame < model_first_release(m))
            continue;
        frame_mass_step_of(s, from, to->state, h, one, &p);
        without_inertia(one, s->massless + (size_t)(9 * k), &p);
        double *own = to->ends + 6 * (one->frame - model_first_release(m));
        memcpy(own, p.v1, sizeof p.v1);
        memcpy(own + 3, p.W1, sizeof p.W1);
        heavy_ones(m, one, &p, to->state, heavy);
        for (int c = 0; c < 6; c++)
            if (at[c] != NONE)
                to->v[at[c]] =
                    heavy[c] ? 2 * s->step[at[c]] / h - from->v[at[c]] : s->step[at[c]] / h;
        for (int c = 0; c < 3 && release_of(m, one->frame)->turns == BALL; c++)
            to->v[at[SCENE_RX + c]] = p.W1[c];
    }
    to->ends_known = 1;
}

/* Returns 1 if a constraint couples the rotations of this vertex to those of another vertex. */
static int turns_with(const model *m, int vertex)
{
    int with = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ && vertex < model_scene(m)->nodes; c++)
        with |= model_tie(m, vertex, c) != NULL;
    return with;
}

static void massless_together(const conserving *s, int vertex, double N[9])
{
    const model *m = s->of.c->model;
    const mesh_vertex *v = model_vertex(m, vertex);
    double sum[9] = {0}, about = 0, all = 0;
    int single = NONE, turns = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ; c++)
        if (v->coordinate[c] != NONE) {
            single = c;
            turns++;
        }
    for (int k = 0; k < s->of.masses->masses; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        const mesh_vertex *other = model_vertex(m, one->frame);
        double centre[3], J[9], axis[3];
        if (single == NONE || memcmp(other->coordinate + SCENE_RX, v->coordinate + SCENE_RX,
                                     3 * sizeof *v->coordinate) != 0)
            continue;
        frame_mass_step_centre(m, one, centre, J);
        for (int i = 0; i < 9; i++)
            sum[i] += J[i];
        for (int i = 0; i < 3; i++)
            axis[i] = other->angles > 0 ? other->axis[0][i] : SCENE_RX + i == single;
        about += dense_quadratic(3, J, axis);
        all += J[0] + J[4] + J[8];
    }
    if (turns == 3) {
        null_space(sum, N);
        return;
    }
    for (int i = 0; i < 9; i++)
        N[i] = i % 4 == 0 && !(about > 1e-12 * all);
}

/* Sets the rates of translations in constraints. Without mass at the nodes that a translation
 * moves, the rate is the mean rate of the step. */
static void rates_together(const conserving *s, const motion_state *from, double h,
                           motion_state *to)
{
    const model *m = s->of.c->model;
    for (int i = 0; i < model_scene(m)->nodes; i++)
        for (int c = 0; c < SCENE_RX; c++) {
            const int at = model_vertex(m, i)->coordinate[c];
            int heavy = 0;
            if (model_tie(m, i, c) == NULL || !model_owns(m, i, c) || at == NONE || at >= s->free ||
                (leads(m, i) && !(fabs(model_vertex(m, i)->axis[0][c]) > 0.5)))
                continue;
            for (int k = 0; k < s->of.masses->masses && !heavy; k++)
                heavy = s->of.masses->mass[k].mass > 0 &&
                        model_vertex(m, s->of.masses->mass[k].frame)->coordinate[c] == at;
            to->v[at] = heavy ? 2 * s->step[at] / h - from->v[at] : s->step[at] / h;
        }
}

static void conserving_rates(conserving *s, const motion_state *from, double h, motion_state *to)
{
    const model *m = s->of.c->model;
    const frame_masses *all = s->of.masses;
    for (int i = 0, k = 0; i < model_first_release(m); i++) {
        const frame_mass plain = {.frame = i};
        const int *at = model_vertex(m, i)->coordinate;
        while (k < all->masses && all->mass[k].frame < i)
            k++;
        const frame_mass *one = k < all->masses && all->mass[k].frame == i ? &all->mass[k] : &plain;
        if (model_vertex(m, i)->body != i)
            continue;
        frame_mass_step p;
        double w[3], turned[3];
        frame_mass_step_of(s, from, to->state, h, one, &p);
        double N[9];
        const int with = turns_with(m, i);
        if (with)
            massless_together(s, i, N);
        without_inertia(one, with ? N : one == &plain ? NULL : s->massless + (size_t)(9 * k), &p);
        mat3_mul_vec(p.R1, p.W1, w);
        vec3_cross(w, p.after, turned);
        double frame[3] = {p.v1[0] - turned[0], p.v1[1] - turned[1], p.v1[2] - turned[2]};
        kinematics_to_own(model_vertex(m, i), frame);
        for (int c = 0; c < 3; c++) {
            if (at[c] != NONE && at[c] < model_unknowns(m) && model_owns(m, i, c))
                to->v[at[c]] = frame[c];
            if (at[SCENE_RX + c] != NONE && at[SCENE_RX + c] < model_unknowns(m) &&
                model_vertex(m, i)->angles == 0 && model_owns(m, i, SCENE_RX))
                to->v[at[SCENE_RX + c]] = p.W1[c];
        }
        if (model_owns(m, i, SCENE_RX))
            angle_rates(m, i, to, w);
    }
    if (model_mesh_of(m)->joined != NULL)
        rates_together(s, from, h, to);
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mean = s->step[c] / h;
        to->v[c] = all->warping[c] > 0 ? 2 * mean - from->v[c] : mean;
    }
    if (model_releases(m) > 0)
        conserving_released_rates(s, from, h, to);
    for (int c = 0; c < s->free; c++)
        to->a[c] = to->algorithm[c] = (to->v[c] - from->v[c]) / h;
}
