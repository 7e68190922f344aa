/* How far apart two states of a model are: what arc length is measured with. */
#include "harness/model/metric.h"

#include <math.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/model/model_impl.h"

/* Bodies that have a coordinate. */
static int moving_bodies(const model *m)
{
    int count = 0;
    for (int i = 0; i < m->mesh.vertices; i++) {
        int moves = 0;
        for (int c = 0; c < VERTEX_COORDINATES; c++)
            moves |= m->mesh.vertex[i].body == i && m->mesh.vertex[i].coordinate[c] != NONE;
        count += moves;
    }
    return count > 0 ? count : 1;
}

void metric_of(const model *m, double weight[])
{
    const double share = 1.0 / moving_bodies(m);
    for (int k = 0; k < m->mesh.free + m->mesh.driven; k++)
        weight[k] = 0;
    for (int i = 0; i < m->mesh.vertices; i++) {
        if (m->mesh.vertex[i].body != i)
            continue;
        for (int c = 0; c < VERTEX_COORDINATES; c++)
            if (m->mesh.vertex[i].coordinate[c] != NONE)
                weight[m->mesh.vertex[i].coordinate[c]] +=
                    c < SCENE_RX ? share / (m->size * m->size) : share;
    }
}

double metric_shift_part(const model *m, const double dx[])
{
    double shift = 0, all = 0;
    for (int i = 0; i < m->mesh.vertices; i++)
        for (int c = 0; c < VERTEX_COORDINATES && m->mesh.vertex[i].body == i; c++) {
            const int k = m->mesh.vertex[i].coordinate[c];
            const double x = k == NONE ? 0 : c < SCENE_RX ? dx[k] / m->size : dx[k];
            shift += c < SCENE_RX ? x * x : 0;
            all += x * x;
        }
    return all > 0 ? shift / all : 0;
}

static double turn(const model_state *a, const model_state *b, int vertex)
{
    double angle[3];
    rotation_between(&a->q[4 * vertex], &b->q[4 * vertex], angle);
    return vec3_norm(angle);
}

/* |d - P d|^2 */
static double square_beside(const double d[3], const double P[9])
{
    double light[3] = {0, 0, 0}, sum = 0;
    if (P != NULL)
        mat3_mul_vec(P, d, light);
    for (int k = 0; k < 3; k++)
        sum += (d[k] - light[k]) * (d[k] - light[k]);
    return sum;
}

static void in_own_axes(const double q[4], double v[3])
{
    double back[4];
    rotation_conjugate(q, back);
    rotation_apply(back, v, v);
}

double metric_distance(const model *m, const model_state *a, const model_state *b,
                       const double light[])
{
    double sum = 0;
    for (int i = 0; i < m->mesh.vertices; i++) {
        const double *P = light != NULL && i < m->mesh.first_release ? &light[18 * i] : NULL;
        double d[3], angle[3];
        if (m->mesh.vertex[i].body != i)
            continue;
        for (int k = 0; k < 3; k++)
            d[k] = (b->u[3 * i + k] - a->u[3 * i + k]) / m->size;
        rotation_between(&a->q[4 * i], &b->q[4 * i], angle);
        if (P != NULL)
            in_own_axes(&a->q[4 * i], angle);
        sum += square_beside(d, P) + square_beside(angle, P != NULL ? P + 9 : NULL);
    }
    return sqrt(sum / moving_bodies(m));
}

double metric_turn_between(const model *m, const model_state *a, const model_state *b)
{
    double largest = 0;
    for (int i = 0; i < m->mesh.vertices; i++)
        if (m->mesh.vertex[i].body == i)
            largest = fmax(largest, turn(a, b, i));
    return largest;
}
