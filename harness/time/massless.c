#include "harness/time/time_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

/* Eigenvalue of the scaled M, relative to the largest mass, below which a motion has no mass. */
static const double massless_nothing = 1e-14;

typedef enum massless_task { COUNT, STIFFEST, KEEP_FORCES, KEEP_MOTION, ACCELERATE } massless_task;

typedef struct null_space_task {
    massless_task task;
    const double *given; /* [free] diagonal of a stiffness, or forces */
    double *changed;     /* [free] forces, increments, or accelerations */
    double stiffest;
} null_space_task;

static void project(const body_mass *g, double none, int forces, double x[])
{
    const int n = g->count;
    for (int i = 0; i < n; i++) {
        const double unit = forces ? g->unit[i] : 1 / g->unit[i];
        g->rest[i] = x[g->index[i]] * unit;
        x[g->index[i]] = 0;
    }
    for (int k = 0; k < n && g->value[k] <= none; k++) {
        double part = 0;
        for (int i = 0; i < n; i++)
            part += g->M[n * i + k] * g->rest[i];
        for (int i = 0; i < n; i++)
            x[g->index[i]] += part * g->M[n * i + k] * (forces ? 1 / g->unit[i] : g->unit[i]);
    }
}

static void accelerate(const body_mass *g, double none, const double force[], double a[])
{
    const int n = g->count;
    for (int i = 0; i < n; i++)
        a[g->index[i]] = 0;
    for (int k = 0; k < n; k++) {
        double part = 0;
        if (g->value[k] <= none)
            continue;
        for (int i = 0; i < n; i++)
            part += g->M[n * i + k] * g->unit[i] * force[g->index[i]];
        for (int i = 0; i < n; i++)
            a[g->index[i]] += part / g->value[k] * g->M[n * i + k] * g->unit[i];
    }
}

static double stiffest(const body_mass *g, double none, const double diagonal[], double most)
{
    const int n = g->count;
    for (int k = 0; k < n; k++) {
        double stiffness = 0;
        for (int i = 0; i < n; i++)
            stiffness += pow(g->M[n * i + k] * g->unit[i], 2) * diagonal[g->index[i]];
        if (g->value[k] > none)
            most = fmax(most, stiffness / g->value[k]);
    }
    return most;
}

/* Performs the task for a body and the bodies that constraints connect to it. Returns the rank of
 * their mass matrix. */
static int visit(const model *m, const frame_masses *all, int body, const model_state *s,
                 body_mass *g, null_space_task *of)
{
    const double none = massless_nothing * body_mass_of(m, all, body, s, g);
    const int n = g->count, rank = body_mass_rank(g, none);
    if (of->task == COUNT)
        return rank;
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', n, g->M, n, g->value); /* fails only for NaN */
    if (of->task == STIFFEST)
        of->stiffest = stiffest(g, none, of->given, of->stiffest);
    else if (of->task == ACCELERATE)
        accelerate(g, none, of->given, of->changed);
    else
        project(g, none, of->task == KEEP_FORCES, of->changed);
    return rank;
}

static int warping(const model *m, const frame_masses *all, const model_state *s,
                   null_space_task *of)
{
    int heavy = 0;
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mass = body_mass_warps(m, all, i, s);
        if (c >= model_unknowns(m))
            continue;
        heavy += mass > 0;
        if (of->task == STIFFEST && mass > 0)
            of->stiffest = fmax(of->stiffest, of->given[c] / mass);
        if (of->task == ACCELERATE)
            of->changed[c] = mass > 0 ? of->given[c] / mass : 0;
        if ((of->task == KEEP_FORCES || of->task == KEEP_MOTION) && mass > 0)
            of->changed[c] = 0;
    }
    return heavy;
}

/* Performs the task for all bodies. *out: number of free coordinates minus the rank of their
 * masses. */
static status walk(const model *m, const frame_masses *all, const model_state *s,
                   null_space_task *of, int *out, fault *f)
{
    int heavy = 0;
    body_mass g;
    TRY(body_mass_alloc(m, &g, f));
    for (int i = 0; i < model_first_release(m); i++)
        if (model_vertex(m, i)->body == i && model_first_joined(m, i) == i)
            heavy += visit(m, all, i, s, &g, of);
    *out = model_unknowns(m) - heavy - warping(m, all, s, of);
    body_mass_free(&g);
    return STATUS_OK;
}

status massless_count(const model *m, const frame_masses *all, const model_state *s, int *out,
                      fault *f)
{
    null_space_task of = {.task = COUNT};
    return walk(m, all, s, &of, out, f);
}

status massless_forces(const model *m, const frame_masses *all, const model_state *s,
                       double force[], fault *f)
{
    null_space_task of = {.task = KEEP_FORCES, .changed = force};
    int count;
    return walk(m, all, s, &of, &count, f);
}

status massless_motion(const model *m, const frame_masses *all, const model_state *s, double dx[],
                       fault *f)
{
    null_space_task of = {.task = KEEP_MOTION, .changed = dx};
    int count;
    return walk(m, all, s, &of, &count, f);
}

/* Computes the largest ratio of stiffness to inertia [1/s^2]. diagonal[free]: diagonal of the
 * stiffness matrix. */
static status massless_stiffest(const model *m, const frame_masses *all, const model_state *s,
                                const double diagonal[], double *out, fault *f)
{
    null_space_task of = {.task = STIFFEST, .given = diagonal};
    int count;
    TRY(walk(m, all, s, &of, &count, f));
    *out = of.stiffest;
    return STATUS_OK;
}

/* Transforms rotations of bodies. own_to_space 1: from the axes of the bodies to global axes; 0:
 * from global axes to the axes of the bodies. */
static void turn_axes(const model *m, const model_state *s, int own_to_space, double a[])
{
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9], turning[3], turned[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY || at[0] >= model_unknowns(m) ||
            at[1] >= model_unknowns(m) || at[2] >= model_unknowns(m) || !model_owns(m, i, SCENE_RX))
            continue;
        for (int k = 0; k < 3; k++)
            turning[k] = a[at[k]];
        rotation_matrix(&s->q[4 * i], R);
        if (own_to_space)
            mat3_mul_vec(R, turning, turned);
        else
            mat3_transpose_mul_vec(R, turning, turned);
        for (int k = 0; k < 3; k++)
            a[at[k]] = turned[k];
    }
}

static void massless_own_axes(const model *m, const model_state *s, double a[])
{
    turn_axes(m, s, 0, a);
}

status massless_drop(const model *m, const frame_masses *all, const model_state *s, double a[],
                     fault *f)
{
    const size_t size = (size_t)model_unknowns(m) * sizeof *a;
    double *light = malloc(size + 1);
    if (light == NULL)
        return fault_memory(f, "the time integration");
    turn_axes(m, s, 1, a);
    memcpy(light, a, size);
    const status outcome = massless_motion(m, all, s, light, f);
    for (int c = 0; c < model_unknowns(m); c++)
        a[c] -= light[c];
    massless_own_axes(m, s, a);
    free(light);
    return outcome;
}

status massless_accelerate(const model *m, const frame_masses *all, const model_state *s,
                           const double force[], double a[], fault *f)
{
    null_space_task of = {.task = ACCELERATE, .given = force, .changed = a};
    int count;
    TRY(walk(m, all, s, &of, &count, f));
    massless_own_axes(m, s, a);
    return STATUS_OK;
}

enum { BLOCK = 9, BLOCKS = 2 };

/* Returns 1 if all three translations (block 0, in global axes) or rotations (block 1) of a body
 * are free. This must also hold for bodies that constraints connect to it. */
static int is_whole(const model *m, int i, int block)
{
    const int *at = model_vertex(m, i)->coordinate + 3 * block, first = model_first_joined(m, i);
    int whole = model_vertex(m, i)->body == i && !(block == 0 && model_vertex(m, i)->turned);
    for (int j = first; j != NONE && whole; j = model_next_joined(m, j))
        whole = memcmp(model_vertex(m, j)->coordinate, model_vertex(m, i)->coordinate,
                       sizeof model_vertex(m, i)->coordinate) == 0;
    for (int k = 0; k < 3; k++)
        whole &= at[k] != NONE && at[k] < model_unknowns(m);
    return whole;
}

static status column(const model *m, const frame_masses *masses, const model_state *s, int block,
                     int k, double dx[], massive *h, fault *f)
{
    memset(dx, 0, (size_t)model_unknowns(m) * sizeof *dx);
    for (int i = 0; i < model_first_release(m); i++)
        if (is_whole(m, i, block))
            dx[model_vertex(m, i)->coordinate[3 * block + k]] = 1;
    TRY(massless_motion(m, masses, s, dx, f));
    for (int i = 0; i < model_first_release(m); i++)
        for (int r = 0; r < 3 && is_whole(m, i, block); r++)
            h->light[BLOCK * (BLOCKS * i + block) + 3 * r + k] =
                dx[model_vertex(m, i)->coordinate[3 * block + r]];
    return STATUS_OK;
}

static void own_axes(const model *m, const model_state *s, massive *h)
{
    for (int i = 0; i < model_first_release(m); i++) {
        double R[9], PR[9], *P = h->light + BLOCK * (BLOCKS * i + 1);
        if (!is_whole(m, i, 1) || forms_of(m, i) != FORM_BODY)
            continue;
        rotation_matrix(&s->q[4 * i], R);
        mat3_mul(P, R, PR);
        mat3_transpose_mul(R, PR, P);
    }
}

static int is_moved(const model *m, const model_state *s, const scene_component *what,
                    const double dx[])
{
    int index[6];
    double T[36], most = 0;
    const int n = kinematics_node_jacobian(m, s, what->node, 6, index, T),
              first = what->component < SCENE_RX ? 0 : 3;
    for (int i = first; i < first + 3; i++) {
        double sum = 0, size = 0;
        for (int k = 0; k < n; k++) {
            const double part = index[k] < model_unknowns(m) ? T[i * n + k] : 0;
            sum += part * dx[index[k] < model_unknowns(m) ? index[k] : 0];
            size += fabs(part);
        }
        most = fmax(most, size > 0 ? fabs(sum) / size : 0);
    }
    return most > 1e-9;
}

static int is_all(const scene *s, int analysis, const unsigned char undefined[])
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].analysis == analysis && !undefined[i])
            return 0;
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].follows == analysis)
            return 0;
    return 1;
}

status motion_undefined(const scene *s, const scene_quantity *q, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "quantity %s: node %s has no inertia for this motion, so its "
                     "acceleration is not defined; name another node, add a mass or an "
                     "inertia, or a density of its members, and do not omit rotary_inertia",
                     q->name, scene_name(s, SCENE_NODES, scene_component_of(q)->node).text);
}

status massless_readings(const model *m, const frame_masses *masses, const model_state *s,
                         int analysis, unsigned char **undefined, fault *f)
{
    const scene *of = model_scene(m);
    const scene_quantity *first = NULL;
    double *dx = calloc((size_t)model_unknowns(m) + 1, sizeof *dx);
    *undefined = calloc((size_t)of->quantities + 1, sizeof **undefined);
    status outcome =
        dx != NULL && *undefined != NULL ? STATUS_OK : fault_memory(f, "the time integration");
    for (int i = 0; i < of->quantities && outcome == STATUS_OK; i++) {
        const scene_quantity *q = &of->quantity[i];
        if (q->analysis != analysis || q->what.kind != SCENE_RATE ||
            q->what.of.rated.rate == SCENE_SPEED)
            continue;
        for (int k = 0; k < model_unknowns(m); k++)
            dx[k] = 1 + 0.01 * k;
        outcome = massless_motion(m, masses, s, dx, f);
        (*undefined)[i] = outcome == STATUS_OK && is_moved(m, s, scene_component_of(q), dx);
        first = (*undefined)[i] && first == NULL ? q : first;
    }
    free(dx);
    return outcome == STATUS_OK && first != NULL && is_all(of, analysis, *undefined)
               ? motion_undefined(of, first, f)
               : outcome;
}

status massive_of(const model *m, const frame_masses *masses, const model_state *s, massive *h,
                  fault *f)
{
    int count;
    TRY(massless_count(m, masses, s, &count, f));
    h->ready = 1;
    if (count == 0)
        return STATUS_OK;
    double *dx = calloc((size_t)model_unknowns(m) + 1, sizeof *dx);
    h->light = calloc((size_t)model_first_release(m) * BLOCKS * BLOCK + 1, sizeof *h->light);
    status outcome =
        dx != NULL && h->light != NULL ? STATUS_OK : fault_memory(f, "the time integration");
    for (int c = 0; c < 3 * BLOCKS && outcome == STATUS_OK; c++)
        outcome = column(m, masses, s, c / 3, c % 3, dx, h, f);
    free(dx);
    if (outcome == STATUS_OK)
        own_axes(m, s, h);
    return outcome;
}

void massive_free(massive *h)
{
    free(h->light);
}

double massive_norm(const massive *h, const model *m, const double weight[], double e[])
{
    double square = 0;
    for (int i = 0; i < model_first_release(m) && h->light != NULL; i++)
        for (int block = 0; block < BLOCKS; block++) {
            const int *at = model_vertex(m, i)->coordinate + 3 * block;
            double of[3], light[3];
            if (!is_whole(m, i, block))
                continue;
            for (int k = 0; k < 3; k++)
                of[k] = e[at[k]];
            mat3_mul_vec(h->light + BLOCK * (BLOCKS * i + block), of, light);
            for (int k = 0; k < 3; k++)
                e[at[k]] -= light[k];
        }
    for (int c = 0; c < model_unknowns(m); c++)
        square += weight[c] * e[c] * e[c];
    return sqrt(square);
}

/* Stiffness that fixes coordinates with inertia, relative to the largest stiffness. It multiplies
 * rounding errors by at most this factor. */
static const double firm = 1e6;

static double *diagonal_of(const sparse *S, double out[])
{
    for (int c = 0; c < S->n; c++) {
        out[c] = 0;
        for (int k = S->column[c]; k < S->column[c + 1]; k++)
            out[c] += S->row[k] == c ? S->value[k] : 0;
    }
    return out;
}

static status forces(motion_stage *s, motion_state *now, sparse *K, fault *f)
{
    const model *m = s->c->model;
    model_linearisation lin = {.path = now->time, .K = K, .residual = s->residual};
    if (s->c->options->newton == NEWTON_DISPLACEMENT)
        TRY(linearise_make_compatible(&s->c->eq, now->state, f));
    feedback_take(&s->c->eq, now->state, now->v, now->time);
    TRY(linearise_state(&s->c->eq, &s->c->run->memory, now->state, &lin, f));
    inertia_subtract(m, s->masses, now->state, now->v, now->a, s->residual);
    return STATUS_OK;
}

typedef struct massless_solution {
    motion_stage *s;
    const double *zero;
    motion_state *now;
    double b, *moved;
} massless_solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    massless_solution *one = of;
    motion_stage *s = one->s;
    motion_state *now = one->now;
    const model *m = s->c->model;
    (void)iteration;
    (void)record;
    TRY(forces(s, now, &s->S, f));
    if (one->b == 0) {
        TRY(massless_stiffest(m, s->masses, now->state, diagonal_of(&s->S, s->dx), &one->b, f));
        one->b *= firm;
    }
    const inertia_relation with = {one->b, 0, one->zero};
    inertia_add_tangent(&s->c->eq, s->masses, now->state, now->v, now->a, &with, &s->S);
    TRY(massless_forces(m, s->masses, now->state, s->residual, f));
    TRY(stage_direction(s, 1, f));
    TRY(massless_motion(m, s->masses, now->state, s->dx, f));
    for (int c = 0; c < s->free; c++)
        one->moved[c] += s->dx[c];
    out->at = now->time;
    out->size =
        advance_state(&s->c->eq, &s->c->run->memory, now->state, s->dx, now->time, &out->stress);
    return STATUS_OK;
}

static status balance(motion_stage *s, const double zero[], motion_state *now, double moved[],
                      fault *f)
{
    massless_solution one = {s, zero, now, 0, moved};
    step_record record = {.path = now->time};
    const newton_use use = newton_in_time(s->c, &one, correct, NULL);
    motion_state_recall(now, &s->newton_convergence);
    const status outcome = newton_iterate(s->c, &use, &s->newton_convergence, &record, f);
    history_drop_step(s->c->result, &record);
    if (outcome == STATUS_NOT_CONVERGED)
        return fault_set(f, outcome,
                         "at %g s no equilibrium of the coordinates without inertia under loads "
                         "and gyroscopic moments was found (correction %.1e in iteration %d); add "
                         "inertia, or reduce the angular velocity",
                         now->time, record.correction, record.iterations);
    if (outcome == STATUS_OK)
        motion_state_store(&s->newton_convergence, now);
    return outcome;
}

static int mark(const model *m, const mesh_element *el, unsigned char of[])
{
    int count = 0;
    for (int c = 0; c < el->columns; c++)
        if (el->index[c] != NONE && el->index[c] < model_unknowns(m)) {
            count += !of[el->index[c]];
            of[el->index[c]] = 1;
        }
    return count;
}

/* Marks in of[free] the coordinates that relax slowly: those of elements and springs with a
 * relaxation time of at least 1e-3 h, where h is the step size. Returns their number. */
static int mark_overdamped(const equations *eq, const model_state *state, double h,
                           unsigned char of[])
{
    const double part = 1e-3;
    const model *m = eq->m;
    const run_damping *damping = eq->run->damping;
    int count = 0;
    for (int i = 0; i < model_elements(m); i++)
        if (run_damping_of(damping, m, i) != NULL &&
            damping->slowest[damping->which[i]] >= part * h)
            count += mark(m, model_element(m, i), of);
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = model_discrete(m, model_discretes(m) - model_springs(m) + i);
        double S[SPRING_STRAINS * SPRING_STRAINS];
        int holds = 0;
        if (scene_spring_damps(d->spring))
            spring_slopes(m, state, i, S);
        for (int k = 0; k < SPRING_STRAINS; k++)
            holds |=
                d->spring->damping[7 * k] > 0 && d->spring->damping[7 * k] > part * h * S[7 * k];
        if (holds)
            count += mark(m, &d->el, of);
    }
    return count;
}

/* Finds the equilibrium with damping forces as if the displacement took the time softness * h. A
 * small softness prevents the motion of damped coordinates. */
static status relax(motion_stage *s, const double zero[], double h, double softness,
                    motion_state *now, double moved[], fault *f)
{
    damping_follow(&s->c->eq, 1 / (softness * h), now->strain, now->state);
    return balance(s, zero, now, moved, f);
}

static status overdamped_rates(motion_stage *s, const double zero[], double h, motion_state *now,
                               double moved[], const unsigned char of[], fault *f)
{
    const double probe_softness = 1e-6, nothing = 1e-9;
    const model *m = s->c->model;
    model_state *before = NULL;
    TRY(linearise_make_compatible(&s->c->eq, now->state, f));
    status outcome = kinematics_state_alloc(m, &before, f);
    if (outcome == STATUS_OK) {
        kinematics_state_copy(m, now->state, before);
        outcome = relax(s, zero, h, probe_softness, now, moved, f);
    }
    if (outcome == STATUS_OK) {
        massless_own_axes(m, now->state, moved);
        for (int c = 0; c < s->free; c++)
            now->v[c] += of[c] ? moved[c] / (probe_softness * h) : 0;
        kinematics_state_copy(m, before, now->state);
        outcome = damping_now(&s->c->eq, now, f);
    }
    kinematics_state_free(before);
    TRY(outcome);
    TRY(relax(s, zero, h, nothing, now, moved, f));
    return damping_now(&s->c->eq, now, f);
}

static status find_balance(motion_stage *s, const double zero[], double h, motion_state *now,
                           fault *f)
{
    double *moved = calloc((size_t)s->free + 1, sizeof *moved);
    unsigned char *of = calloc((size_t)s->free + 1, 1);
    status outcome = fault_memory(f, "the time integration");
    if (moved != NULL && of != NULL)
        outcome = s->c->run->damping != NULL && mark_overdamped(&s->c->eq, now->state, h, of) > 0
                      ? overdamped_rates(s, zero, h, now, moved, of, f)
                      : balance(s, zero, now, moved, f);
    free(moved);
    free(of);
    return outcome;
}

status consistent_massless(motion_stage *s, const double zero[], double h, motion_state *now,
                           fault *f)
{
    const model *m = s->c->model;
    memset(now->a, 0, (size_t)s->free * sizeof *now->a);
    TRY(find_balance(s, zero, h, now, f));
    TRY(forces(s, now, NULL, f));
    TRY(massless_accelerate(m, s->masses, now->state, s->residual, now->a, f));
    memcpy(now->algorithm, now->a, (size_t)s->all * sizeof *now->a);
    return STATUS_OK;
}
