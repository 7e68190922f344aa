/* Small motions about a state with rates: M x'' + (C + G) x' + K x, where x contains increments of
 * the coordinates, with rotations about fixed axes. The rates of a free rotation are the angular
 * velocity w in the axes of the frame, W = R^T w. Then dW = R^T x' and dW' = R^T (x'' - w x x'),
 * so M w~ is subtracted from the derivatives with respect to the rates. Strains of damped members
 * have the rates J v, where v contains the rates of the state. Small motions x change these rates
 * by J x' + J' x, where J' is the rate of J along the motion. */
#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* First derivative of sixth order, from three differences of values at -h .. h, -2 h .. 2 h and -3
 * h .. 3 h. */
enum { DIFFERENCES = 3 };
static const double weight_of[DIFFERENCES] = {0.75, -0.15, 1 / 60.0};
/* step of finite differences: [rad] for rotations, relative to the size of the scene for
 * translations */
static const double turn_by = 0.02;

typedef struct small_motions {
    const equations *eq;
    const model *m;
    const frame_masses *masses;
    const motion_state *now;
    outcome_about *out;
    int all;
    model_state *moved;
    double *inc, *zero; /* [all] */
    double *force;      /* [all] inertia forces in a displaced state, or for changed rates */
    double *column;     /* [3 x all] */
    /* [all] 1: coordinate of a rotation about axes that other coordinates move */
    char *odd;
} small_motions;

static status alloc(const equations *eq, const frame_masses *masses, const motion_state *now,
                    outcome_about *out, small_motions *s, fault *f)
{
    const sparse *pattern;
    const size_t all = (size_t)model_all_coordinates(eq->m) + 1;
    *s = (small_motions){.eq = eq,
                         .m = eq->m,
                         .masses = masses,
                         .now = now,
                         .out = out,
                         .all = model_all_coordinates(eq->m)};
    s->inc = calloc(6 * all, sizeof *s->inc);
    s->odd = calloc(all, sizeof *s->odd);
    if (s->inc == NULL || s->odd == NULL)
        return fault_memory(f, "small motions");
    s->zero = s->inc + all;
    s->force = s->zero + all;
    s->column = s->force + all;
    TRY(kinematics_state_alloc(eq->m, &s->moved, f));
    kinematics_state_copy(eq->m, now->state, s->moved);
    TRY(assemble_pattern_whole(eq->m, eq->run->patterns, 1, &pattern, f));
    TRY(sparse_alloc_like(pattern, &out->K, f));
    TRY(sparse_alloc_like(pattern, &out->M, f));
    TRY(sparse_alloc_like(pattern, &out->C, f));
    return sparse_alloc_like(pattern, &out->G, f);
}

static void release(small_motions *s)
{
    free(s->inc);
    free(s->odd);
    kinematics_state_free(s->moved);
}

static void add(const sparse *a, double times, sparse *to)
{
    for (int i = 0; i < to->column[to->n]; i++)
        to->value[i] += times * a->value[i];
}

static int turns_freely(const model *m, int vertex)
{
    const int own = vertex >= model_first_release(m) ||
                    (model_vertex(m, vertex)->body == vertex && model_owns(m, vertex, SCENE_RX));
    return own && forms_of(m, vertex) == FORM_BODY;
}

static void mark_odd(small_motions *s)
{
    const model *m = s->m;
    for (int i = 0; i < model_vertices(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        released_masses of;
        for (int k = 0; v->body == i && v->angles > 1 && k < v->angles; k++)
            if (v->coordinate[SCENE_RX + k] != NONE)
                s->odd[v->coordinate[SCENE_RX + k]] = 1;
        if (i < model_first_release(m))
            continue;
        released_columns(m, s->now->state, i, &of);
        for (int k = 0; k < of.count; k++)
            s->odd[of.index[k]] = 1;
    }
}

static void subtract_turning(const small_motions *s, const sparse *B, sparse *A)
{
    const model *m = s->m;
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        frame_rates r;
        if (!turns_freely(m, i))
            continue;
        inertia_rates(m, s->now->state, i, s->now->v, NULL, &r);
        const double w[9] = {0, -r.w[2], r.w[1], r.w[2], 0, -r.w[0], -r.w[1], r.w[0], 0};
        for (int from = 0; from < 3; from++)
            for (int k = B->column[at[from]]; k < B->column[at[from] + 1]; k++)
                for (int to = 0; to < 3; to++)
                    assemble_subtract(A, B->row[k], at[to], B->value[k] * w[3 * from + to]);
    }
}

/* Adds `scale` times the inertia forces after the coordinate, or its rate, has changed by h. */
static void add_forces(small_motions *s, int c, int rate, double h, double scale, double out[])
{
    double *const changed = rate ? s->now->v : s->inc;
    const double before = changed[c];
    changed[c] += h;
    if (!rate)
        increment_apply(s->m, s->now->state, s->inc, s->now->time, s->moved);
    memset(s->force, 0, (size_t)s->all * sizeof *s->force);
    inertia_subtract(s->m, s->masses, rate ? s->now->state : s->moved, s->now->v, s->now->a,
                     s->force);
    changed[c] = before;
    for (int i = 0; i < s->all; i++)
        out[i] -= scale * s->force[i];
}

static void differentiate(small_motions *s, int c, int rate, double out[])
{
    const double h = rate ? 1 : turn_by;
    memset(out, 0, (size_t)s->all * sizeof *out);
    for (int k = 0; k < (rate ? 1 : DIFFERENCES); k++)
        for (int sign = -1; sign < 2; sign += 2)
            add_forces(s, c, rate, sign * (k + 1) * h, sign * (rate ? 0.5 : weight_of[k]) / h, out);
}

static void put_column(int c, const double of[], sparse *A)
{
    for (int k = A->column[c]; k < A->column[c + 1]; k++)
        A->value[k] = of[A->row[k]];
}

static void put_turn(small_motions *s, int vertex, int rate, sparse *A)
{
    const int *at = &model_vertex(s->m, vertex)->coordinate[SCENE_RX];
    const size_t n = (size_t)s->all;
    double R[9], M[3] = {0, 0, 0};
    rotation_matrix(&s->now->state->q[4 * vertex], R);
    for (int k = 0; k < 3; k++)
        differentiate(s, at[k], rate, s->column + (size_t)k * n);
    for (size_t i = 0; i < n; i++) {
        double own[3];
        for (int k = 0; k < 3; k++)
            own[k] = s->column[(size_t)k * n + i];
        for (size_t k = 0; k < 3; k++)
            s->column[k * n + i] =
                R[3 * k] * own[0] + R[3 * k + 1] * own[1] + R[3 * k + 2] * own[2];
    }
    if (!rate) {
        memset(s->force, 0, n * sizeof *s->force);
        inertia_subtract(s->m, s->masses, s->now->state, s->now->v, s->now->a, s->force);
        for (int k = 0; k < 3; k++)
            M[k] = -s->force[at[k]] / 2;
    }
    const double half[9] = {0, -M[2], M[1], M[2], 0, -M[0], -M[1], M[0], 0};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            s->column[(size_t)k * n + (size_t)at[i]] += half[3 * i + k];
        put_column(at[k], s->column + (size_t)k * n, A);
    }
}

static void put_odd(small_motions *s, int rate, sparse *A)
{
    const model *m = s->m;
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        if (!turns_freely(m, i) || !s->odd[at[0]])
            continue;
        put_turn(s, i, rate, A);
        for (int k = 0; k < 3; k++)
            s->odd[at[k]] = 2;
    }
    for (int c = 0; c < s->all; c++) {
        if (s->odd[c] == 1) {
            differentiate(s, c, rate, s->column);
            put_column(c, s->column, A);
        }
        s->odd[c] = s->odd[c] != 0;
    }
}

static void add_inertia(small_motions *s)
{
    const motion_state *now = s->now;
    outcome_about *out = s->out;
    frame_masses undamped = *s->masses;
    undamped.damping = 0;
    mark_odd(s);
    inertia_add_tangent(s->eq, &undamped, now->state, s->zero, NULL,
                        &(inertia_relation){1, 0, s->zero}, &out->M);
    inertia_add_tangent(s->eq, s->masses, now->state, now->v, now->a,
                        &(inertia_relation){0, 0, s->zero}, &out->G);
    if (s->masses->spread)
        consistent_mass_add_omitted(s->eq, now->state, now->v, now->a, s->masses->damping, &out->G);
    put_odd(s, 0, &out->G);
    add(&out->G, 1, &out->K);
    sparse_zero(&out->G);
    inertia_add_tangent(s->eq, &undamped, now->state, now->v, now->a,
                        &(inertia_relation){0, 1, s->zero}, &out->G);
    memcpy(out->C.value, out->G.value, (size_t)out->G.column[out->G.n] * sizeof(double));
    sparse_zero(&out->G);
    inertia_add_tangent(s->eq, &undamped, now->state, now->v, now->a,
                        &(inertia_relation){0, 0, s->zero}, &out->G);
    for (int i = 0; i < out->G.column[out->G.n]; i++)
        out->G.value[i] = out->C.value[i] - out->G.value[i];
    sparse_zero(&out->C);
    put_odd(s, 1, &out->G);
    if (s->masses->damping != 0)
        for (int c = 0; c < s->all; c++)
            for (int k = out->G.column[c]; k < out->G.column[c + 1] && s->odd[c]; k++)
                out->G.value[k] -= s->masses->damping * out->M.value[k];
    subtract_turning(s, &out->M, &out->G);
}

/* Returns a duration [s] in which rotations of nodes are at most about turn_by, and their
 * displacements at most about turn_by times the size of the model; 0: nothing moves. */
static double short_time(const small_motions *s)
{
    const double length = model_length(s->m);
    double fastest = 0;
    for (int i = 0; i < model_vertices(s->m); i++) {
        frame_rates r;
        vertex_rates(s->m, s->now->state, i, s->now->v, NULL, &r);
        for (int k = 0; k < 3; k++)
            fastest = fmax(fastest, fmax(fabs(r.w[k]), fabs(r.v[k]) / length));
    }
    for (int c = 0; c < s->all; c++)
        if (s->odd[c])
            fastest = fmax(fastest, fabs(s->now->v[c]));
    return fastest > 0 ? turn_by / fastest : 0;
}

static const mesh_discrete *spring_of(const model *m, int i)
{
    return model_discrete(m, model_discretes(m) - model_springs(m) + i);
}

static void strains_of(const model *m, const model_state *at, int element, double J[])
{
    const mesh_element *el = model_element(m, element);
    double own[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, at, el, x);
    model_type(m)->strain(model_kind(m, el->kind)->data, x,
                          &(strain_output){.J = own, .history = model_history_of(m, at, element)});
    for (int k = 0; k < model_strains(m); k++) {
        double *row = J + k * el->columns;
        memset(row, 0, (size_t)el->columns * sizeof *row);
        memcpy(row, own + k * model_own_coordinates(m),
               (size_t)model_own_coordinates(m) * sizeof *row);
        eliminate_forces(m, at, el, row);
    }
}

enum { ROOM = ELEMENT_MAX_STRAINS * MODEL_MAX_COORDINATES };

/* Adds `scale` times the Jacobians J of damped elements and springs to change[(elements + springs)
 * x ROOM]. */
static void add_jacobians(const small_motions *s, const model_state *at, double scale,
                          double change[])
{
    const model *m = s->m;
    double J[ROOM], d[SPRING_STRAINS];
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        if (run_damping_of(s->eq->run->damping, m, i) == NULL)
            continue;
        strains_of(m, at, i, J);
        for (int k = 0; k < model_strains(m) * el->columns; k++)
            change[(size_t)i * ROOM + (size_t)k] += scale * J[k];
    }
    for (int i = 0; i < model_springs(m); i++) {
        const size_t to = ((size_t)model_elements(m) + (size_t)i) * ROOM;
        dashpots_strains(m, at, i, d, J);
        for (int k = 0; k < SPRING_STRAINS * spring_of(m, i)->el.columns; k++)
            change[to + (size_t)k] += scale * J[k];
    }
}

static void change_jacobians(small_motions *s, double change[])
{
    const double h = short_time(s);
    for (int k = 0; k < DIFFERENCES && h > 0; k++)
        for (int sign = -1; sign < 2; sign += 2) {
            for (int c = 0; c < s->all; c++)
                s->inc[c] = sign * (k + 1) * h * s->now->v[c];
            increment_apply(s->m, s->now->state, s->inc, s->now->time, s->moved);
            add_jacobians(s, s->moved, sign * weight_of[k] / h, change);
        }
    memset(s->inc, 0, (size_t)s->all * sizeof *s->inc);
}

/* Computes K[n x n] = J^T V J'. */
static void stiffness_of_rates(int strains, int n, const double J[], const double V[],
                               const double change[], double K[])
{
    double half[ROOM];
    dense_mul(strains, strains, n, V, change, half);
    memset(K, 0, (size_t)n * (size_t)n * sizeof *K);
    dense_add_transpose_mul(n, strains, n, J, half, K);
}

static void add_rates(small_motions *s, const double change[])
{
    const model *m = s->m;
    const mesh_pattern *pattern = assemble_of(s->eq->run->patterns, &s->out->K);
    double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES], J[ROOM], d[SPRING_STRAINS];
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        const double *V = run_damping_of(s->eq->run->damping, m, i);
        if (V == NULL)
            continue;
        strains_of(m, s->now->state, i, J);
        stiffness_of_rates(model_strains(m), el->columns, J, V, change + (size_t)i * ROOM, K);
        assemble_matrix(pattern, i, K, &s->out->K);
    }
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *spring = spring_of(m, i);
        dashpots_strains(m, s->now->state, i, d, J);
        stiffness_of_rates(SPRING_STRAINS, spring->el.columns, J, spring->spring->damping,
                           change + ((size_t)model_elements(m) + (size_t)i) * ROOM, K);
        assemble_discrete(&spring->el, K, &s->out->K);
    }
}

static status add_damping(small_motions *s, fault *f)
{
    if (s->eq->run->damping != NULL)
        TRY(damping_matrix(s->eq, s->now->state, 0, &s->out->C, f));
    add(&s->out->M, s->masses->damping, &s->out->C);
    if (s->eq->run->damping == NULL)
        return STATUS_OK;
    double *change = calloc(((size_t)model_elements(s->m) + (size_t)model_springs(s->m)) * ROOM + 1,
                            sizeof *change);
    if (change == NULL)
        return fault_memory(f, "small motions");
    change_jacobians(s, change);
    add_rates(s, change);
    free(change);
    return STATUS_OK;
}

static status make_compatible(const equations *eq, motion_state *now, fault *f)
{
    const model *m = eq->m;
    const size_t n = (size_t)model_strains(m);
    TRY(linearise_make_compatible(eq, now->state, f));
    for (int i = 0; i < model_elements(m) && eq->run->damping != NULL; i++) {
        const double *V = run_damping_of(eq->run->damping, m, i);
        double more[ELEMENT_MAX_STRAINS];
        if (V == NULL)
            continue;
        dense_mul_vec((int)n, (int)n, V, now->strain + (size_t)i * n, more);
        for (size_t k = 0; k < n; k++)
            now->state->sigma[(size_t)i * n + k] += more[k];
    }
    return STATUS_OK;
}

static status add_stiffness(small_motions *s, fault *f)
{
    const equations *eq = s->eq;
    model_linearisation lin = {.path = s->now->time, .K = &s->out->K, .residual = s->force};
    feedback_take(eq, s->now->state, s->now->v, lin.path);
    return linearise_state(eq, &eq->run->memory, s->now->state, &lin, f);
}

static status fill(small_motions *s, fault *f)
{
    TRY(add_stiffness(s, f));
    add_inertia(s);
    return add_damping(s, f);
}

status small_motions_of(const equations *eq, const frame_masses *masses, motion_state *now,
                        outcome_about *out, fault *f)
{
    run_damping *const damping = eq->run->damping;
    const run_damping before = damping != NULL ? *damping : (run_damping){0};
    small_motions s = {0};
    status outcome = damping_now(eq, now, f);
    if (outcome == STATUS_OK)
        outcome = make_compatible(eq, now, f);
    if (outcome == STATUS_OK)
        outcome = alloc(eq, masses, now, out, &s, f);
    if (outcome == STATUS_OK)
        outcome = fill(&s, f);
    release(&s);
    if (damping != NULL)
        *damping = before;
    return outcome;
}
