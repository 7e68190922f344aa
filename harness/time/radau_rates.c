/* Rates and accelerations of three stages, from their increments. Rates of stage j gain by the
 * increment of stage k
 *   G_jk = B_jk/h Jr(t_j) + (j = k) d(Jr(t_j) t_j')/dt_j,
 * accelerations of stage i sum_j B_ij/h G_jk. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/charts.h"
#include "harness/time/forms.h"
#include "harness/time/radau_impl.h"
#include "harness/time/turning.h"

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
    const mesh_vertex *v = model_vertex(m, vertex);
    return (v->body == vertex || vertex >= model_first_release(m)) && v->angles == 0 &&
           forms_of(m, vertex) == FORM_BODY && v->coordinate[SCENE_RX] < model_unknowns(m);
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
        for (int x = 0; x < model_vertices(m); x++) {
            const int *at = model_vertex(m, x)->coordinate;
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
    three(model_vertex(m, vertex)->coordinate, r->stage[j].inc, t);
    three(model_vertex(m, vertex)->coordinate, r->stage[j].rate, rate);
    turning_jacobian(t, turn);
    turning_derivative(t, rate, D);
    for (int i = 0; i < 9; i++)
        turn[i] = b * turn[i] + (j == k ? D[i] : 0);
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

void radau_in_space(const radau *r, int vertex, int i, const double B[9], double out[9])
{
    double R[9];
    rotation_matrix(&r->stage[i].state->q[4 * vertex], R);
    mat3_mul(R, B, out);
}
