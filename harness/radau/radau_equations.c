/* The equations of three stages at once. Rates of stage j gain by the increment of stage k
 *   G_jk = B_jk/h Jr(t_j) + (j = k) d(Jr(t_j) t_j')/dt_j,
 * accelerations of stage i sum_j B_ij/h G_jk. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/equations/linearise.h"
#include "harness/inertia/inertia.h"
#include "harness/inertia/released.h"
#include "harness/inertia/turning.h"
#include "harness/radau/radau_impl.h"
#include "harness/scheme/kinks.h"

void radau_coefficients(radau *r)
{
    const double s = sqrt(6);
    const double A[9] = {(88 - 7 * s) / 360,     (296 - 169 * s) / 1800, (-2 + 3 * s) / 225,
                         (296 + 169 * s) / 1800, (88 + 7 * s) / 360,     (-2 - 3 * s) / 225,
                         (16 - s) / 36,          (16 + s) / 36,          1 / 9.0};
    double LU[9];
    int pivot[STAGES];
    memcpy(LU, A, sizeof LU);
    memcpy(r->weights, &A[6], sizeof r->weights);
    for (int i = 0; i < 9; i++)
        r->B[i] = i % 4 == 0;
    dense_lu(STAGES, LU, pivot);
    dense_lu_solve(STAGES, STAGES, LU, pivot, r->B);
    r->node[0] = (4 - s) / 10;
    r->node[1] = (4 + s) / 10;
    r->node[2] = 1;
}

static void three(const int at[6], const double of[], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = of[at[SCENE_RX + i]];
}

static int is_free_turn(const model *m, int vertex)
{
    const mesh_vertex *v = &m->vertex[vertex];
    return (v->body == vertex || vertex >= m->first_release) && v->angles == 0 &&
           forms_of(m, vertex) == FORM_BODY && v->coordinate[SCENE_RX] < m->free;
}

double radau_time(const radau *r, const instant *from, double h, int stage,
                  const step_record *record)
{
    return stage == STAGES - 1 ? record->path : from->time + r->node[stage] * h;
}

void radau_rates(radau *r, const instant *from, double h)
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
        for (int x = 0; x < m->vertices; x++) {
            const int *at = m->vertex[x].coordinate;
            double t[3], rate[3], Jr[9], W[3];
            if (!is_free_turn(m, x))
                continue;
            three(at, one->inc, t);
            three(at, one->rate, rate);
            turning_jacobian(t, Jr);
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

/* G_jk: what rates of stage j gain by inc of stage k, of one frame: scalar of translations, [3 x 3]
 * of rotations. */
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
    double t[3], rate[3], D[9];
    three(m->vertex[vertex].coordinate, r->stage[j].inc, t);
    three(m->vertex[vertex].coordinate, r->stage[j].rate, rate);
    turning_jacobian(t, turn);
    turning_derivative(t, rate, D);
    for (int i = 0; i < 9; i++)
        turn[i] = b * turn[i] + (j == k ? D[i] : 0);
}

/* What the rates (rate) and accelerations of stage i gain by spatial increments of a vertex in
 * stage k: scalars of translations, [3 x 3] of its rotation, in the axes of its rates. */
typedef struct relation {
    double rate, acceleration, turn_rate[9], turn_acceleration[9];
} relation;

static void relate(const radau *r, int vertex, double h, int i, int k, relation *out)
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

/* Blocks (i, k) of one frame, k = 0 .. */
static void add_frame(radau *r, int index, double h, int i)
{
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame;
    const int *at = m->vertex[vertex].coordinate;
    inertia_parts p;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    for (int k = 0; k < STAGES; k++) {
        relation of;
        double E[9], K[36], more[36];
        relate(r, vertex, h, i, k, &of);
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
        inertia_rows(p.turn, K);
        for (int row = 0; row < 6; row++)
            for (int column = 0; column < 6; column++)
                stages_add(&r->S, i, k, at[row], at[column], K[6 * row + column]);
    }
}

/* R_i B of a vertex. */
static void in_space(const radau *r, int vertex, int i, const double B[9], double out[9])
{
    double R[9];
    rotation_matrix(&r->stage[i].state->q[4 * vertex], R);
    mat3_mul(R, B, out);
}

/* The same of a released end. */
static void add_released(radau *r, int index, double h, int i)
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame, body = m->vertex[vertex].body;
    inertia_parts p;
    released of;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    released_columns(m, r->stage[i].state, vertex, &of);
    for (int k = 0; k < STAGES; k++) {
        relation of_body, of_end;
        double at_body[9], at_end[9], motion[6 * KINEMATICS_MOST],
            K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
        relate(r, body, h, i, k, &of_body);
        relate(r, vertex, h, i, k, &of_end);
        in_space(r, body, i, of_body.turn_acceleration, at_body);
        in_space(r, vertex, i, of_end.turn_acceleration, at_end);
        released_motion(&of, of_body.acceleration, at_body, at_end, motion);
        released_project(&of, p.acceleration, motion, K);
        in_space(r, body, i, of_body.turn_rate, at_body);
        in_space(r, vertex, i, of_end.turn_rate, at_end);
        released_motion(&of, of_body.rate, at_body, at_end, motion);
        released_project(&of, p.velocity, motion, K);
        if (i == k) {
            released_motion(&of, 1, one, one, motion);
            released_project(&of, p.place, motion, K);
        }
        for (int row = 0; row < of.count; row++)
            for (int column = 0; column < of.count; column++)
                stages_add(&r->S, i, k, of.index[row], of.index[column],
                           K[of.count * row + column]);
    }
}

static void add_warps(radau *r, double h)
{
    const model *m = r->of.c->model;
    double B2[STAGES * STAGES];
    dense_mul(STAGES, STAGES, STAGES, r->B, r->B, B2);
    for (int w = 0; w < m->warps; w++) {
        const int c = m->warp[w].coordinate;
        for (int x = 0; x < STAGES * STAGES; x++)
            if (r->of.masses->warping[c] > 0)
                stages_add(&r->S, x / STAGES, x % STAGES, c, c,
                           r->of.masses->warping[c] * B2[x] / (h * h));
    }
}

status radau_equations(radau *r, int fresh, const instant *from, double h, step_record *record,
                       fault *f)
{
    model *m = r->of.c->model;
    if (fresh)
        stages_zero(&r->S);
    record->incompatibility = 0;
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        model_linearisation lin = {.path = kinks_before(m, radau_time(r, from, h, i, record)),
                                   .K = fresh ? &r->K : NULL,
                                   .residual = r->dx};
        m->work = one->work;
        if (r->of.c->options->newton == SOLVE_DISPLACEMENT)
            TRY(linearise_make_compatible(m, one->state, f));
        TRY(linearise_state(m, one->state, &lin, f));
        inertia_subtract(m, r->of.masses, one->state, one->v, one->a, r->dx);
        memcpy(r->residual + (size_t)i * (size_t)r->free, r->dx,
               (size_t)r->free * sizeof *r->residual);
        if (fresh)
            stages_put(&r->S, i, &r->K);
        record->incompatibility = fmax(record->incompatibility, lin.incompatibility);
    }
    radau_damp(r, fresh, from, h);
    if (!fresh)
        return STATUS_OK;
    for (int i = 0; i < STAGES; i++)
        for (int k = 0; k < r->of.masses->masses; k++)
            if (r->of.masses->mass[k].frame < r->of.c->model->first_release)
                add_frame(r, k, h, i);
            else
                add_released(r, k, h, i);
    add_warps(r, h);
    return STATUS_OK;
}
