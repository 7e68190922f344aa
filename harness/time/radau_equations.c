#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

/* Computes out = R B, where R is the orientation of a vertex in stage i. */
static void radau_in_space(const radau *, int vertex, int i, const double B[9], double out[9]);
static void radau_spread(radau *, double h);
static void radau_damp(radau *, int fresh, const motion_state *from, double h);

/* Adds the derivatives of the inertia forces on a frame in stage i to the blocks (i, k) for all
 * k. */
static void add_frame(radau *r, int index, double h, int i)
{
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame;
    const int *at = model_vertex(m, vertex)->coordinate;
    inertia_parts p;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    for (int k = 0; k < STAGES; k++) {
        radau_relation of;
        double E[9], K[36], more[36];
        radau_relate(r, vertex, h, i, k, &of);
        mat3_mul(p.rate, of.turn_acceleration, E);
        inertia_times(p.acceleration, of.acceleration, E, K);
        mat3_mul(p.rate, of.turn_rate, E);
        inertia_times(p.velocity, of.rate, E, more);
        for (int x = 0; x < 36; x++)
            K[x] += more[x];
        if (i == k) {
            inertia_times(p.place, 1, p.turn, more);
            for (int x = 0; x < 36; x++)
                K[x] += more[x];
        }
        inertia_finish(m, r->of.masses, index, &p, of.rate, i == k, K);
        stages_add_block(&r->S, i, k, 6, at, K);
    }
}

static void add_released(radau *r, int index, double h, int i)
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame, body = model_vertex(m, vertex)->body;
    inertia_parts p;
    released_masses of;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    released_columns(m, r->stage[i].state, vertex, &of);
    for (int k = 0; k < STAGES; k++) {
        radau_relation of_body, of_end;
        double at_body[9], at_end[9], motion[6 * KINEMATICS_MOST],
            K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
        radau_relate(r, body, h, i, k, &of_body);
        radau_relate(r, vertex, h, i, k, &of_end);
        radau_in_space(r, body, i, of_body.turn_acceleration, at_body);
        radau_in_space(r, vertex, i, of_end.turn_acceleration, at_end);
        released_motion(&of, of_body.acceleration, at_body, at_end, motion);
        released_project(&of, p.acceleration, motion, K);
        radau_in_space(r, body, i, of_body.turn_rate, at_body);
        radau_in_space(r, vertex, i, of_end.turn_rate, at_end);
        released_motion(&of, of_body.rate, at_body, at_end, motion);
        released_project(&of, p.velocity, motion, K);
        if (i == k) {
            released_motion(&of, 1, one, one, motion);
            released_project(&of, p.place, motion, K);
        }
        stages_add_block(&r->S, i, k, of.count, of.index, K);
    }
}

static void add_warps(radau *r, double h)
{
    const model *m = r->of.c->model;
    double B2[STAGES * STAGES];
    dense_mul(STAGES, STAGES, STAGES, r->B, r->B, B2);
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        for (int x = 0; x < STAGES * STAGES; x++)
            if (r->of.masses->warping[c] > 0)
                stages_add(&r->S, x / STAGES, x % STAGES, c, c,
                           r->of.masses->warping[c] *
                               (B2[x] / (h * h) + r->of.masses->damping * r->B[x] / h));
    }
}

void radau_integrate(radau *r, const motion_state *from, double h, const step_record *record)
{
    const equations *eq = &r->of.c->eq;
    const int count = feedback_count(eq);
    double *error = r->errors; /* [STAGES x count] */
    for (int j = 0; j < STAGES && count > 0; j++)
        feedback_errors(eq, r->stage[j].state,
                        discontinuities_before(eq->m, radau_time(r, from, h, j, record)),
                        error + count * j);
    for (int i = 0; i < STAGES; i++)
        for (int k = 0; k < count; k++) {
            double *z = &r->stage[i].state->feedback[k];
            *z = from->state->feedback[k];
            for (int j = 0; j < STAGES; j++)
                *z += h * r->A[STAGES * i + j] * error[count * j + k];
        }
}

typedef struct stages_block {
    stages_matrix *S;
    int i, k;
} stages_block;

static void add_entry(void *to, int row, int column, double value)
{
    const stages_block *at = to;
    stages_add(at->S, at->i, at->k, row, column, value);
}

/* Adds the derivatives of loads with feedback. The derivatives with respect to the error in stage k
 * are B_ik/h for the rate in stage i, and h A_ik for the integral. */
static void add_feedback(radau *r, double h, int i)
{
    for (int k = 0; k < STAGES && feedback_count(&r->of.c->eq) > 0; k++) {
        stages_block at = {&r->S, i, k};
        const feedback_gains gains = {i == k, r->B[STAGES * i + k] / h, h * r->A[STAGES * i + k]};
        feedback_tangent(&r->of.c->eq, r->stage[i].state, &gains, add_entry, &at);
    }
}

static void differentiate_turns(radau *r);

status radau_equations(radau *r, int fresh, const motion_state *from, double h, step_record *record,
                       fault *f)
{
    const model *m = r->of.c->model;
    if (fresh)
        stages_zero(&r->S);
    record->incompatibility = 0;
    radau_integrate(r, from, h, record);
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        model_linearisation lin = {.path =
                                       discontinuities_before(m, radau_time(r, from, h, i, record)),
                                   .K = fresh ? &r->K : NULL,
                                   .residual = r->dx};
        if (r->of.c->options->newton == NEWTON_DISPLACEMENT)
            TRY(linearise_make_compatible(&r->of.c->eq, one->state, f));
        feedback_take(&r->of.c->eq, one->state, one->v, lin.path);
        TRY(linearise_state(&r->of.c->eq, &one->memory, one->state, &lin, f));
        inertia_subtract(m, r->of.masses, one->state, one->v, one->a, r->dx);
        r->of.c->run->counters.inertia_evaluations +=
            r->of.masses->spread ? model_elements(m) * (1 + fresh) : 0;
        memcpy(r->residual + (size_t)i * (size_t)r->free, r->dx,
               (size_t)r->free * sizeof *r->residual);
        if (fresh)
            stages_put(&r->S, i, &r->K);
        if (fresh)
            add_feedback(r, h, i);
        record->incompatibility = fmax(record->incompatibility, lin.incompatibility);
    }
    radau_damp(r, fresh, from, h);
    if (!fresh)
        return STATUS_OK;
    differentiate_turns(r);
    for (int i = 0; i < STAGES; i++)
        for (int k = 0; k < r->of.masses->masses; k++)
            if (r->of.masses->mass[k].frame < model_first_release(r->of.c->model))
                add_frame(r, k, h, i);
            else
                add_released(r, k, h, i);
    add_warps(r, h);
    if (r->of.masses->spread)
        radau_spread(r, h);
    return STATUS_OK;
}

/* Computes the rates and accelerations of three stages from their increments. The derivative of the
 * rates of stage j with respect to the increment of stage k is
 *     G_jk = B_jk/h Jr(t_j) + (j = k) d(Jr(t_j) t_j')/dt_j.
 * The derivative of the accelerations of stage i is sum_j B_ij/h G_jk. */

void radau_coefficients(radau *r)
{
    const double s = sqrt(6);
    const double A[9] = {(88 - 7 * s) / 360,     (296 - 169 * s) / 1800, (-2 + 3 * s) / 225,
                         (296 + 169 * s) / 1800, (88 + 7 * s) / 360,     (-2 - 3 * s) / 225,
                         (16 - s) / 36,          (16 + s) / 36,          1 / 9.0};
    double LU[9];
    int pivot[STAGES];
    memcpy(LU, A, sizeof LU);
    memcpy(r->A, A, sizeof A);
    memcpy(r->weights, &A[6], sizeof r->weights);
    for (int i = 0; i < 9; i++)
        r->B[i] = i % 4 == 0;
    dense_lu(STAGES, LU, pivot);
    dense_lu_solve(STAGES, STAGES, LU, pivot, r->B);
    r->node[0] = (4 - s) / 10;
    r->node[1] = (4 + s) / 10;
    r->node[2] = 1;
}

/* Returns Jr(t) of a vertex in a stage, followed by d(Jr(t) t')/dt. */
static double *turn_of(const radau *r, int vertex, int stage)
{
    return r->turn + (size_t)(STAGES * vertex + stage) * 18;
}

static void three(const int at[6], const double of[], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = of[at[SCENE_RX + i]];
}

static int is_free_turn(const model *m, int vertex)
{
    const mesh_vertex *v = model_vertex(m, vertex);
    return (v->body == vertex || vertex >= model_first_release(m)) && v->angles == 0 &&
           forms_of(m, vertex) == FORM_BODY && v->coordinate[SCENE_RX] < model_unknowns(m);
}

double radau_time(const radau *r, const motion_state *from, double h, int stage,
                  const step_record *record)
{
    return stage == STAGES - 1 ? record->path : from->time + r->node[stage] * h;
}

void radau_rates(radau *r, const motion_state *from, double h)
{
    const model *m = r->of.c->model;
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        for (int c = 0; c < r->free; c++) {
            one->rate[c] = 0;
            for (int j = 0; j < STAGES; j++)
                one->rate[c] += r->B[STAGES * i + j] * r->stage[j].inc[c] / h;
            one->v[c] = one->rate[c];
        }
        for (int x = 0; x < model_vertices(m); x++) {
            const int *at = model_vertex(m, x)->coordinate;
            double t[3], rate[3], *Jr = turn_of(r, x, i), W[3];
            if (!is_free_turn(m, x))
                continue;
            three(at, one->inc, t);
            three(at, one->rate, rate);
            rotation_rates_jacobian(t, Jr);
            mat3_mul_vec(Jr, rate, W);
            for (int k = 0; k < 3; k++)
                one->v[at[SCENE_RX + k]] = W[k];
        }
    }
    for (int i = 0; i < STAGES; i++)
        for (int c = 0; c < r->free; c++) {
            r->stage[i].a[c] = 0;
            for (int j = 0; j < STAGES; j++)
                r->stage[i].a[c] += r->B[STAGES * i + j] * (r->stage[j].v[c] - from->v[c]) / h;
        }
}

static void differentiate_turns(radau *r)
{
    const model *m = r->of.c->model;
    for (int x = 0; x < model_vertices(m); x++)
        for (int i = 0; i < STAGES && is_free_turn(m, x); i++) {
            double t[3], rate[3];
            three(model_vertex(m, x)->coordinate, r->stage[i].inc, t);
            three(model_vertex(m, x)->coordinate, r->stage[i].rate, rate);
            rotation_rates_derivative(t, rate, turn_of(r, x, i) + 9);
        }
}

/* Computes G_jk of a frame, the derivative of the rates of stage j with respect to inc of stage k:
 * a scalar for translations, and a matrix [3 x 3] for rotations. */
static void gains(const radau *r, int vertex, double h, int j, int k, double *translation,
                  double turn[9])
{
    const model *m = r->of.c->model;
    const double b = r->B[STAGES * j + k] / h;
    *translation = b;
    for (int i = 0; i < 9; i++)
        turn[i] = i % 4 == 0 ? b : 0;
    if (!is_free_turn(m, vertex))
        return;
    const double *Jr = turn_of(r, vertex, j), *D = Jr + 9;
    for (int i = 0; i < 9; i++)
        turn[i] = b * Jr[i] + (j == k ? D[i] : 0);
}

void radau_relate(const radau *r, int vertex, double h, int i, int k, radau_relation *out)
{
    const model *m = r->of.c->model;
    double R[9], N[9], turn[9], sum[9] = {0};
    out->acceleration = 0;
    for (int j = 0; j < STAGES; j++) {
        double translation;
        gains(r, vertex, h, j, k, &translation, turn);
        out->acceleration += r->B[STAGES * i + j] / h * translation;
        for (int x = 0; x < 9; x++)
            sum[x] += r->B[STAGES * i + j] / h * turn[x];
    }
    gains(r, vertex, h, i, k, &out->rate, turn);
    rotation_matrix(&r->stage[k].state->q[4 * vertex], R);
    inertia_chart(m, vertex, r->stage[k].inc, R, N);
    mat3_mul(sum, N, out->turn_acceleration);
    mat3_mul(turn, N, out->turn_rate);
}

static void radau_in_space(const radau *r, int vertex, int i, const double B[9], double out[9])
{
    double R[9];
    rotation_matrix(&r->stage[i].state->q[4 * vertex], R);
    mat3_mul(R, B, out);
}

typedef struct damped {
    double J[ELEMENT_MAX_STRAINS * MODEL_MAX_COORDINATES];
    double gained[ELEMENT_MAX_STRAINS];
} damped;

static void take(radau *r, const motion_state *from, int stage, int element, damped *out)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    const size_t first = (size_t)element * (size_t)model_strains(m);
    const model_slot w = linearise_slot(m, &r->stage[stage].memory, element);
    for (int k = 0; k < model_strains(m); k++) {
        double *row = out->J + k * el->columns;
        memset(row, 0, (size_t)el->columns * sizeof *row);
        memcpy(row, w.J + k * model_own_coordinates(m),
               (size_t)model_own_coordinates(m) * sizeof *row);
        eliminate_forces(m, r->stage[stage].state, el, row);
        out->gained[k] = r->stage[stage].state->e[first + (size_t)k] + w.incompatibility[k] -
                         from->state->e[first + (size_t)k];
    }
}

static void add_stress(radau *r, const damped all[STAGES], double h, const double V[], int stage,
                       int element)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    double rate[ELEMENT_MAX_STRAINS] = {0}, more[ELEMENT_MAX_STRAINS],
           force[MODEL_MAX_COORDINATES] = {0};
    for (int j = 0; j < STAGES; j++)
        for (int k = 0; k < model_strains(m); k++)
            rate[k] += r->B[STAGES * stage + j] / h * all[j].gained[k];
    dense_mul_vec(model_strains(m), model_strains(m), V, rate, more);
    const model_slot w = linearise_slot(m, &r->stage[stage].memory, element);
    for (int k = 0; k < model_strains(m); k++)
        w.sigma[k] += more[k];
    dense_add_transpose_mul(el->columns, model_strains(m), 1, all[stage].J, more, force);
    for (int c = 0; c < el->columns; c++)
        if (el->index[c] != NONE && el->index[c] < r->free)
            r->residual[(size_t)stage * (size_t)r->free + (size_t)el->index[c]] -= force[c];
}

/* Adds B_ik/h J_i^T V J_k to all blocks (i, k). */
static void add_blocks(radau *r, const damped all[STAGES], double h, const double V[], int element)
{
    const model *m = r->of.c->model;
    const mesh_element *el = model_element(m, element);
    const int n = el->columns;
    for (int k = 0; k < STAGES; k++) {
        double VJ[ELEMENT_MAX_STRAINS * MODEL_MAX_COORDINATES];
        dense_mul(model_strains(m), model_strains(m), n, V, all[k].J, VJ);
        for (int i = 0; i < STAGES; i++) {
            const double part = r->B[STAGES * i + k] / h;
            double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
            memset(K, 0, (size_t)(n * n) * sizeof *K);
            dense_add_transpose_mul(n, model_strains(m), n, all[i].J, VJ, K);
            for (int row = 0; row < n; row++)
                for (int column = 0; column < n; column++)
                    stages_add(&r->S, i, k, el->index[row], el->index[column],
                               part * K[n * row + column]);
        }
    }
}

static void damp_spring(radau *r, int fresh, const motion_state *from, double h, int spring)
{
    enum { SIX = SPRING_STRAINS, X = ELEMENT_MAX_COORDINATES };
    const model *m = r->of.c->model;
    const mesh_discrete *of = model_discrete(m, model_discretes(m) - model_springs(m) + spring);
    const mesh_element *el = &of->el;
    const double *C = of->spring->damping;
    double d[STAGES][SIX], J[STAGES][SIX * X], begin[SIX], K[X * X], CJ[SIX * X], force[X];
    dashpots_strains(m, from->state, spring, begin, J[0]);
    for (int i = 0; i < STAGES; i++)
        dashpots_strains(m, r->stage[i].state, spring, d[i], J[i]);
    for (int i = 0; i < STAGES; i++) {
        double rate[SIX] = {0}, sigma[SIX];
        for (int j = 0; j < STAGES; j++)
            for (int k = 0; k < SIX; k++)
                rate[k] += r->B[STAGES * i + j] / h * (d[j][k] - begin[k]);
        dense_mul_vec(SIX, SIX, C, rate, sigma);
        dashpots_stressed(m, r->stage[i].state, spring, sigma, force, K);
        for (int c = 0; c < el->columns; c++)
            if (el->index[c] != NONE && el->index[c] < r->free)
                r->residual[(size_t)i * (size_t)r->free + (size_t)el->index[c]] -= force[c];
        for (int k = 0; fresh && k < STAGES; k++) {
            const size_t size = (size_t)(el->columns * el->columns) * sizeof *K;
            double block[X * X];
            if (i == k)
                memcpy(block, K, size);
            else
                memset(block, 0, size);
            dense_mul(SIX, SIX, el->columns, C, J[k], CJ);
            for (int x = 0; x < SIX * el->columns; x++)
                CJ[x] *= r->B[STAGES * i + k] / h;
            dense_add_transpose_mul(el->columns, SIX, el->columns, J[i], CJ, block);
            for (int x = 0; x < el->columns * el->columns; x++)
                stages_add(&r->S, i, k, el->index[x / el->columns], el->index[x % el->columns],
                           block[x]);
        }
    }
}

static void radau_damp(radau *r, int fresh, const motion_state *from, double h)
{
    const model *m = r->of.c->model;
    for (int i = 0; i < model_elements(m) && r->of.c->run->damping != NULL; i++) {
        const double *V = run_damping_of(r->of.c->run->damping, m, i);
        damped all[STAGES];
        if (V == NULL)
            continue;
        for (int stage = 0; stage < STAGES; stage++)
            take(r, from, stage, i, &all[stage]);
        for (int stage = 0; stage < STAGES; stage++)
            add_stress(r, all, h, V, stage, i);
        if (fresh)
            add_blocks(r, all, h, V, i);
    }
    for (int i = 0; i < model_springs(m) && r->of.c->run->damping != NULL; i++)
        if (scene_spring_damps(
                model_discrete(m, model_discretes(m) - model_springs(m) + i)->spring))
            damp_spring(r, fresh, from, h, i);
}

/* Computes out = sum_j weight_j (e_j - e_0) for the strains of elements and the deformations of
 * springs. */
static void sum_strains(const radau *r, const motion_state *from, const double weight[STAGES],
                        double out[])
{
    const model *m = r->of.c->model;
    const size_t count = (size_t)model_elements(m) * (size_t)model_strains(m);
    for (size_t k = 0; k < count; k++) {
        out[k] = 0;
        for (int j = 0; j < STAGES; j++)
            out[k] += weight[j] * (r->stage[j].state->e[k] - from->state->e[k]);
    }
    for (int i = 0; i < model_springs(m); i++) {
        double d[SPRING_STRAINS], begin[SPRING_STRAINS],
            J[SPRING_STRAINS * ELEMENT_MAX_COORDINATES];
        double *sum = out + count + (size_t)(SPRING_STRAINS * i);
        memset(sum, 0, SPRING_STRAINS * sizeof *sum);
        dashpots_strains(m, from->state, i, begin, J);
        for (int j = 0; j < STAGES; j++) {
            dashpots_strains(m, r->stage[j].state, i, d, J);
            for (int k = 0; k < SPRING_STRAINS; k++)
                sum[k] += weight[j] * (d[k] - begin[k]);
        }
    }
}

/* Returns the energy [J] absorbed in a step by springs without a potential. */
static double circulated(const radau *r, const motion_state *from)
{
    enum { SIX = SPRING_STRAINS };
    const model *m = r->of.c->model;
    double sum = 0;
    for (int i = 0; i < model_scene(m)->springs; i++) {
        double begin[SIX], d[STAGES][SIX], J[SIX * ELEMENT_MAX_COORDINATES];
        if (!scene_spring_circulates(&model_scene(m)->spring[i]))
            continue;
        dashpots_strains(m, from->state, i, begin, J);
        for (int j = 0; j < STAGES; j++)
            dashpots_strains(m, r->stage[j].state, i, d[j], J);
        for (int j = 0; j < STAGES; j++) {
            double change[SIX] = {0};
            for (int l = 0; l < STAGES; l++)
                for (int k = 0; k < SIX; k++)
                    change[k] += r->B[STAGES * j + l] * (d[l][k] - begin[k]);
            sum += r->weights[j] * spring_circulated(m, i, d[j], change);
        }
    }
    return sum;
}

double radau_dissipated(const radau *r, const motion_state *from, double h, double room[])
{
    double sum = circulated(r, from);
    for (int i = 0; i < STAGES; i++)
        sum +=
            h * r->weights[i] *
            inertia_damping_power(r->of.c->model, r->of.masses, r->stage[i].state, r->stage[i].v);
    for (int i = 0; i < STAGES && r->of.c->run->damping != NULL; i++) {
        double weight[STAGES];
        for (int j = 0; j < STAGES; j++)
            weight[j] = r->B[STAGES * i + j] / h;
        sum_strains(r, from, weight, room);
        sum += h * r->weights[i] * damping_power(&r->of.c->eq, room);
    }
    return sum;
}

void radau_damp_error(const radau *r, const motion_state *from, double h, const double e[STAGES],
                      double g, double room[])
{
    double weight[STAGES];
    if (r->of.c->run->damping == NULL)
        return;
    for (int j = 0; j < STAGES; j++)
        weight[j] = -e[j] / h;
    sum_strains(r, from, weight, room);
    damping_follow(&r->of.c->eq, g, room, from->state);
}

static void motions_of(const radau *r, const consistent_mass_parts *p, int node, double h, int i,
                       int k, consistent_mass_motion *rates, consistent_mass_motion *accelerations)
{
    const int vertex = p->el->vertex[node], body = model_vertex(r->of.c->model, vertex)->body;
    radau_relation of;
    radau_relate(r, body, h, i, k, &of);
    rates->plain = of.rate;
    accelerations->plain = of.acceleration;
    if (vertex < model_first_release(r->of.c->model)) {
        mat3_mul(p->rate[node], of.turn_rate, rates->turn);
        mat3_mul(p->rate[node], of.turn_acceleration, accelerations->turn);
        return;
    }
    radau_in_space(r, body, i, of.turn_rate, rates->turn);
    radau_in_space(r, body, i, of.turn_acceleration, accelerations->turn);
    radau_relate(r, vertex, h, i, k, &of);
    radau_in_space(r, vertex, i, of.turn_rate, rates->ball);
    radau_in_space(r, vertex, i, of.turn_acceleration, accelerations->ball);
}

static void add_element(radau *r, int element, double h, int i)
{
    const model *m = r->of.c->model;
    consistent_mass_parts p;
    consistent_mass_motion rates[ELEMENT_MAX_NODES], accelerations[ELEMENT_MAX_NODES],
        place[ELEMENT_MAX_NODES];
    consistent_mass_element(m, element, r->stage[i].state, r->stage[i].v, r->stage[i].a,
                            r->of.masses->damping, &p);
    consistent_mass_place(m, &p, place);
    for (int k = 0; k < STAGES; k++) {
        double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        memset(K, 0, (size_t)(p.columns * p.columns) * sizeof *K);
        for (int node = 0; node < p.el->nodes; node++)
            motions_of(r, &p, node, h, i, k, &rates[node], &accelerations[node]);
        consistent_mass_times(m, &p, p.acceleration, accelerations, K);
        consistent_mass_times(m, &p, p.velocity, rates, K);
        if (i == k)
            consistent_mass_times(m, &p, p.place, place, K);
        consistent_mass_rows(&p, K);
        consistent_mass_swing(m, &p, r->B[STAGES * i + k] / h, i == k, K);
        stages_add_element(&r->S, i, k, assemble_of(r->of.c->run->patterns, &r->K), element, K);
    }
}

static void radau_spread(radau *r, double h)
{
    for (int i = 0; i < STAGES; i++)
        for (int e = 0; e < model_elements(r->of.c->model); e++)
            add_element(r, e, h, i);
}
