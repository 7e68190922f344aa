/* Loads and drivers along the path. */
#include "harness/model/loads.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"

static double interpolate(int stations, const double at[], const double value[], double path)
{
    if (path <= at[0])
        return value[0];
    for (int i = 1; i < stations; i++)
        if (path <= at[i]) {
            const double t = (path - at[i - 1]) / (at[i] - at[i - 1]);
            return t == 1 ? value[i] : value[i - 1] + t * (value[i] - value[i - 1]);
        }
    return value[stations - 1];
}

double loads_factor(const scene_load *load, double path)
{
    return load->stations > 0 ? interpolate(load->stations, load->path, load->factor, path) : path;
}

/* Derivative of the factor by the path parameter; at a station: of what follows. */
static double rate_along_path(const scene_load *load, double path)
{
    if (load->stations == 0)
        return 1;
    for (int i = 1; i < load->stations; i++)
        if (path >= load->path[i - 1] && path < load->path[i])
            return (load->factor[i] - load->factor[i - 1]) / (load->path[i] - load->path[i - 1]);
    return 0;
}

double loads_driver_value(const scene_driver *d, double path)
{
    return interpolate(d->stations, d->path, d->value, path);
}

static void add_at_vertex(const model *m, const model_state *s, int vertex, const double F[6],
                          double out[])
{
    int index[6];
    double T[36];
    const int n = kinematics_node_jacobian(m, s, vertex, 6, index, T);
    for (int k = 0; k < n; k++)
        for (int i = 0; i < 6; i++)
            out[index[k]] += T[i * n + k] * F[i];
}

/* Dead load per initial length, lumped: 1/2, 1/2, or Simpson's weights with a middle node. */
static void add_distributed(const model *m, const model_state *s, const scene_load *load,
                            double scale, double out[])
{
    static const double two[] = {0.5, 0.5}, three[] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
    for (int i = m->first_element[load->where]; i < m->first_element[load->where + 1]; i++)
        for (int k = 0; k < m->nodes; k++) {
            const double weight =
                scale * (m->nodes == 2 ? two : three)[k] * m->kind[m->element[i].kind].length;
            const double F[6] = {weight * load->vector[0], weight * load->vector[1],
                                 weight * load->vector[2]};
            add_at_vertex(m, s, m->element[i].vertex[k], F, out);
        }
}

static void node_vector(const scene_load *load, double scale, double F[6])
{
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < 3; i++)
        F[(load->kind == SCENE_MOMENT ? 3 : 0) + i] = scale * load->vector[i];
}

static void add_load(const model *m, const model_state *s, const scene_load *load, double scale,
                     double out[])
{
    double F[6];
    if (load->kind == SCENE_DISTRIBUTED) {
        add_distributed(m, s, load, scale, out);
    } else {
        node_vector(load, scale, F);
        add_at_vertex(m, s, load->where, F, out);
    }
}

void loads_add(const model *m, const model_state *s, double path, double out[])
{
    for (int i = 0; i < m->scene->loads; i++)
        add_load(m, s, &m->scene->load[i], loads_factor(&m->scene->load[i], path), out);
}

void loads_rate(const model *m, const model_state *s, double path, double out[])
{
    memset(out, 0, (size_t)(m->free + m->driven) * sizeof *out);
    for (int i = 0; i < m->scene->loads; i++)
        add_load(m, s, &m->scene->load[i], rate_along_path(&m->scene->load[i], path), out);
}

static void subtract(sparse *K, int row, int column, double value)
{
    if (row < 0 || column < 0 || row >= K->n || column >= K->n || (K->symmetric && row > column))
        return;
    double *entry = assemble_entry(K, row, column);
    if (entry != NULL)
        *entry -= value;
}

/* Derivative of the generalized load of a force F at offset rho and a spatial moment m on one
 * body's rotations. */
static void subtract_at(const model *m, const model_state *s, int node, const double F[6],
                        sparse *K)
{
    const mesh_vertex *v = &m->vertex[node], *body = &m->vertex[v->body];
    double rho[3], D[9], moment[3] = {0, 0, 0}, b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    kinematics_offset(m, s, node, rho);
    const double dot = vec3_dot(F, rho);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            D[3 * i + j] = (F[i] * rho[j] + rho[i] * F[j]) / 2 - (i == j ? dot : 0);
    if (body->angles > 0) {
        kinematics_axes(m, s, v->body, b);
        vec3_cross(rho, F, moment);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double Db[3], cross[3];
            mat3_mul_vec(D, b[j], Db);
            vec3_cross(b[j], b[i], cross);
            double value = vec3_dot(b[i], Db);
            if (body->angles >
                0) /* conservative part symmetric, dead moment only through earlier axes */
                value += (i > j ? 1 : -1) * vec3_dot(moment, cross) / 2 +
                         (j < i ? vec3_dot(F + 3, cross) : 0);
            else
                value += vec3_dot(F + 3, cross) / 2;
            subtract(K, body->coordinate[3 + i], body->coordinate[3 + j], value);
        }
}

void loads_subtract_stiffness(const model *m, const model_state *s, double path, sparse *K)
{
    for (int i = 0; i < m->scene->loads; i++) {
        const scene_load *load = &m->scene->load[i];
        double F[6];
        if (load->kind == SCENE_DISTRIBUTED ||
            (load->kind == SCENE_FORCE && m->vertex[load->where].body == load->where))
            continue;
        node_vector(load, loads_factor(load, path), F);
        subtract_at(m, s, load->where, F, K);
    }
}

void loads_release_moment(const model *m, const model_state *s, int node, const double M[3],
                          sparse *K)
{
    const mesh_vertex *v = &m->vertex[node];
    double b[3][3];
    if (v->angles == 0)
        return;
    kinematics_axes(m, s, node, b);
    for (int i = 0; i < v->angles; i++)
        for (int j = i + 1; j < v->angles; j++) {
            double cross[3];
            vec3_cross(b[i], b[j], cross);
            subtract(K, v->coordinate[3 + i], v->coordinate[3 + j], vec3_dot(M, cross) / 2);
            subtract(K, v->coordinate[3 + j], v->coordinate[3 + i], vec3_dot(M, cross) / 2);
        }
}

void loads_at_node(const model *m, const model_state *s, int node, double F[6])
{
    memset(F, 0, 6 * sizeof(double));
    for (int i = 0; i < m->scene->loads; i++) {
        const scene_load *load = &m->scene->load[i];
        if (load->kind == SCENE_DISTRIBUTED || m->vertex[load->where].body != node)
            continue;
        double at[6], rho[3], moment[3];
        node_vector(load, loads_factor(load, s->path), at);
        kinematics_offset(m, s, load->where, rho);
        vec3_cross(rho, at, moment);
        for (int k = 0; k < 6; k++)
            F[k] += at[k] + (k >= 3 && load->where != node ? moment[k - 3] : 0);
    }
}

void loads_drive(const model *m, const model_state *s, double path, double dx[])
{
    for (int d = 0; d < m->scene->drivers; d++)
        if (m->scene->driver[d].value != NULL && m->driver_coordinate[d] >= m->free)
            dx[m->driver_coordinate[d]] =
                loads_driver_value(&m->scene->driver[d], path) - s->driver[d];
    for (int i = 0; i < m->scene->nodes; i++) {
        const mesh_vertex *v = &m->vertex[i];
        if (v->vector_driver[0] == NONE || v->body != i)
            continue;
        double target[3], q[4], turn[3];
        for (int k = 0; k < 3; k++)
            target[k] = loads_driver_value(&m->scene->driver[v->vector_driver[k]], path);
        rotation_exp(target, q);
        rotation_between(&s->q[4 * i], q, turn);
        for (int k = 0; k < 3; k++)
            dx[v->coordinate[3 + k]] = turn[k];
    }
}

int loads_conditions(const model *m, const model_state *s, double path,
                     model_condition out[MODEL_MAX_CONDITIONS])
{
    int count = 0;
    for (int d = 0; d < m->scene->drivers && count < MODEL_MAX_CONDITIONS; d++) {
        const scene_driver *u = &m->scene->driver[d];
        if (u->value != NULL || m->driver_coordinate[d] == NONE)
            continue;
        out[count].unknown = m->driver_coordinate[d];
        out[count].coordinate = m->driver_coordinate[u->condition_driver];
        out[count++].increment = loads_driver_value(&m->scene->driver[u->condition_driver], path) -
                                 s->driver[u->condition_driver];
    }
    return count;
}

status loads_reference(model *m, double f[], fault *fl)
{
    (void)fl;
    memset(f, 0, (size_t)(m->free + m->driven) * sizeof *f);
    loads_add(m, m->rest, 1, f);
    return STATUS_OK;
}
