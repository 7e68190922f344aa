#include "harness/model/model_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* smallest number of pieces per member, so that a single element appears curved */
enum { LEAST_PIECES = 12 };
static const double drawn_part = 0.1,
                    /* largest drawn displacement of a mode as a fraction of the model's size, and
                     * its largest drawn rotation [rad] */
    drawn_rotation = 0.5;

/* gaps_of returns the number of gaps between the vertices of a member. pieces_of returns the number
 * of pieces of each gap. */
static int gaps_of(const model *m, int member)
{
    return (m->mesh.first_element[member + 1] - m->mesh.first_element[member]) *
           (m->mesh.nodes - 1);
}

static int pieces_of(const model *m, int member)
{
    const int gaps = gaps_of(m, member);
    return (LEAST_PIECES + gaps - 1) / gaps;
}

int centreline_points(const model *m, int first[])
{
    int count = 0;
    for (int i = 0; i < m->scene->members; i++) {
        if (first != NULL)
            first[i] = count;
        count += gaps_of(m, i) * pieces_of(m, i) + 1;
    }
    if (first != NULL)
        first[m->scene->members] = count;
    return count;
}

typedef struct span {
    int nodes;
    const double *place; /* positions of the nodes */
    double length;
    node_state x[ELEMENT_MAX_NODES];
    double q[ELEMENT_MAX_NODES][4];
    double force[ELEMENT_MAX_COORDINATES];
} span;

static void span_of(const model *m, const model_state *s, int element, span *out)
{
    const mesh_element *el = &m->mesh.element[element];
    const element_data *data = m->mesh.kind[el->kind].data;
    const double *sigma = &s->sigma[(size_t)element * (size_t)m->mesh.strains];
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    memset(out, 0, sizeof *out);
    out->nodes = m->mesh.nodes;
    out->place = m->mesh.place;
    out->length = m->mesh.kind[el->kind].length;
    kinematics_gather(m, s, el, out->x);
    for (int k = 0; k < m->mesh.nodes; k++)
        rotation_from_matrix(out->x[k].R, out->q[k]);
    m->mesh.type->strain(data, out->x,
                         &(strain_output){.J = J, .history = model_history_of(m, s, element)});
    dense_add_transpose_mul(m->mesh.coordinates, m->mesh.strains, 1, J, sigma, out->force);
}

static void cubic(const span *e, int k, double t, double r[3], double direction[3])
{
    const double *p = e->x[k].r, *q = e->x[k + 1].r, u = 1 - t,
                 gap = e->length * (e->place[k + 1] - e->place[k]);
    for (int i = 0; i < 3; i++) {
        const double a = gap * e->x[k].R[3 * i], b = gap * e->x[k + 1].R[3 * i];
        r[i] = p[i] + t * t * (3 - 2 * t) * (q[i] - p[i]) + t * u * (u * a - t * b);
        direction[i] = 6 * t * u * (q[i] - p[i]) + u * (1 - 3 * t) * a + t * (3 * t - 2) * b;
    }
}

/* Computes the orientation: interpolates along the shortest rotation between the two triads, then
 * applies the shortest rotation of the x axis to the direction of the line. */
static void orientation(const span *e, int k, double t, const double direction[3], double q[4])
{
    double rotation_vector[3], step[4], x[3] = {1, 0, 0}, axis[3];
    rotation_between(e->q[k], e->q[k + 1], rotation_vector);
    for (int i = 0; i < 3; i++)
        rotation_vector[i] *= t;
    rotation_exp(rotation_vector, step);
    rotation_compose(step, e->q[k], q);
    rotation_apply(q, x, x);
    vec3_cross(x, direction, axis);
    const double sine = vec3_norm(axis), angle = atan2(sine, vec3_dot(x, direction));
    for (int i = 0; i < 3; i++)
        rotation_vector[i] = sine > 0 ? axis[i] / sine * angle : 0;
    rotation_exp(rotation_vector, step);
    rotation_compose(step, q, q);
}

static void resultants(const span *e, int k, double t, centreline_point *p)
{
    double force[3] = {0}, moment[3] = {0}, R[9];
    const double along = e->place[k] + t * (e->place[k + 1] - e->place[k]);
    for (int beyond = k + 1; beyond < e->nodes; beyond++) {
        const double *f = &e->force[NODE_COORDINATES * beyond];
        double arm[3], more[3];
        for (int i = 0; i < 3; i++)
            arm[i] = e->x[beyond].r[i] - p->r[i];
        vec3_cross(arm, f, more);
        for (int i = 0; i < 3; i++) {
            force[i] += f[i];
            moment[i] += f[3 + i] + more[i];
        }
    }
    rotation_matrix(p->q, R);
    mat3_transpose_mul_vec(R, force, p->force);
    mat3_transpose_mul_vec(R, moment, p->moment);
    p->bimoment = along * e->force[NODE_COORDINATES * e->nodes - 1] - (1 - along) * e->force[6];
}

static void point_at(const span *e, int k, double t, centreline_point *p)
{
    double direction[3];
    cubic(e, k, t, p->r, direction);
    orientation(e, k, t, direction, p->q);
    resultants(e, k, t, p);
}

void centreline_fill(const model *m, const model_state *s, centreline_point out[])
{
    for (int member = 0; member < m->scene->members; member++) {
        const int last = m->mesh.first_element[member + 1] - 1, pieces = pieces_of(m, member);
        for (int i = m->mesh.first_element[member]; i <= last; i++) {
            span e;
            span_of(m, s, i, &e);
            for (int k = 0; k + 1 < e.nodes; k++)
                for (int piece = 0; piece < pieces; piece++)
                    point_at(&e, k, (double)piece / pieces, out++);
            if (i == last)
                point_at(&e, e.nodes - 2, 1, out++);
        }
    }
}

void centreline_nodes(const model *m, const model_state *s, double out[])
{
    for (int i = 0; i < m->scene->nodes; i++)
        kinematics_position(m, s, i, out + 3 * i);
}

static void increment_of_node(const model *m, const model_state *s, int node, const double x[],
                              double out[])
{
    int index[6];
    double T[36];
    const int count = kinematics_node_jacobian(m, s, node, 6, index, T);
    for (int i = 0; i < 6; i++) {
        out[6 * node + i] = 0;
        for (int k = 0; k < count; k++)
            out[6 * node + i] += T[i * count + k] * x[index[k]];
    }
}

static void increments_of(const model *m, const model_state *s, const double x[], double out[])
{
    for (int i = 0; i < m->mesh.elements; i++) {
        double local[ELEMENT_MAX_COORDINATES];
        kinematics_local(m, s, &m->mesh.element[i], x, local);
        for (int k = 0; k < m->mesh.nodes; k++)
            memcpy(&out[6 * m->mesh.element[i].vertex[k]], &local[NODE_COORDINATES * k],
                   6 * sizeof(double));
    }
    for (int i = m->mesh.first_release; i < m->mesh.vertices; i++)
        increment_of_node(m, s, m->mesh.release[i - m->mesh.first_release].node, x, out);
}

void centreline_increments(const model *m, const double x[], double out[])
{
    increments_of(m, m->rest, x, out);
    for (int i = 0; i < m->scene->nodes; i++)
        increment_of_node(m, m->rest, i, x, out);
}

/* Returns a scale that makes a mode visible. */
static double visible_scale(const model *m, const double increment[])
{
    double scale = INFINITY;
    for (int v = 0; v < m->mesh.vertices; v++)
        scale = fmin(scale, fmin(drawn_part * m->size / vec3_norm(&increment[6 * v]),
                                 drawn_rotation / vec3_norm(&increment[6 * v + 3])));
    return isfinite(scale) ? scale : 1;
}

/* Moves the state s by `scale` times the increments[vertices x 6]. */
static void displace(const model *m, double scale, const double increment[], model_state *s)
{
    for (int v = 0; v < m->mesh.vertices; v++) {
        double rotation_vector[3], q[4];
        for (int i = 0; i < 3; i++) {
            s->u[3 * v + i] += scale * increment[6 * v + i];
            rotation_vector[i] = scale * increment[6 * v + 3 + i];
        }
        rotation_exp(rotation_vector, q);
        rotation_compose(q, &s->q[4 * v], &s->q[4 * v]);
    }
}

status centreline_displaced(const model *m, const model_state *from, const double x[],
                            const double sigma[], double *scale, model_state **out, fault *f)
{
    TRY(kinematics_state_alloc(m, out, f));
    double *increment = calloc((size_t)m->mesh.vertices * 6 + 1, sizeof *increment);
    if (increment == NULL)
        return fault_memory(f, "a picture");
    kinematics_state_copy(m, from, *out);
    increments_of(m, from, x, increment);
    if (*scale == 0)
        *scale = visible_scale(m, increment);
    displace(m, *scale, increment, *out);
    if (sigma != NULL)
        memcpy((*out)->sigma, sigma,
               (size_t)m->mesh.elements * (size_t)m->mesh.strains * sizeof *sigma);
    free(increment);
    return STATUS_OK;
}

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

/* Returns |d - P d|^2, with P = 0 if the argument P is NULL. */
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
