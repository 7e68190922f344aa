#include "harness/model/model_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

void kinematics_position(const model *m, const model_state *s, int index, double r[3])
{
    for (int i = 0; i < 3; i++)
        r[i] = m->mesh.vertex[index].position[i] + s->u[3 * index + i];
}

void kinematics_offset(const model *m, const model_state *s, int index, double rho[3])
{
    const mesh_vertex *v = &m->mesh.vertex[index];
    rotation_apply(&s->q[4 * v->body], v->offset, rho);
}

/* Computes the orientation for the current angles of a sequence, and its spatial axes b (NULL: not
 * needed). */
static void sequence_orientation(const model *m, const model_state *s, int index, double b[][3],
                                 double q[4])
{
    const mesh_vertex *v = &m->mesh.vertex[index];
    rotation_identity(q);
    for (int k = 0; k < v->angles; k++) {
        double turn[3], step[4];
        if (b != NULL)
            rotation_apply(q, v->axis[k], b[k]);
        for (int i = 0; i < 3; i++)
            turn[i] = v->axis[k][i] * s->angle[3 * index + k];
        rotation_exp(turn, step);
        rotation_compose(q, step, q);
    }
}

void kinematics_axes(const model *m, const model_state *s, int index, double b[3][3])
{
    double q[4];
    sequence_orientation(m, s, index, b, q);
}

void kinematics_arm(const model *m, const model_state *s, int vertex, double moved[3])
{
    const mesh_vertex *v = &m->mesh.vertex[vertex];
    const double angle = s->angle[3 * vertex];
    double across[3];
    vec3_cross(v->axis[0], v->arm, across);
    for (int i = 0; i < 3; i++)
        moved[i] = across[i] * cos(angle) - v->arm[i] * sin(angle);
}

void kinematics_swing(const model *m, const model_state *s, int vertex, double more, double by[3])
{
    const mesh_vertex *v = &m->mesh.vertex[vertex];
    const double mean = s->angle[3 * vertex] + more / 2, twice = 2 * sin(more / 2);
    double across[3];
    vec3_cross(v->axis[0], v->arm, across);
    for (int i = 0; i < 3; i++)
        by[i] = twice * (across[i] * cos(mean) - v->arm[i] * sin(mean));
}

/* Moves a vertex in the plane of its diaphragm: u = u_master + (R - 1) arm. */
static void follow_leader(const model *m, model_state *s, int vertex)
{
    const mesh_vertex *v = &m->mesh.vertex[vertex];
    const double angle = s->angle[3 * vertex], half = sin(angle / 2);
    double across[3];
    vec3_cross(v->axis[0], v->arm, across);
    for (int i = 0; i < 3; i++)
        if (!(fabs(v->axis[0][i]) > 0.5))
            s->u[3 * vertex + i] =
                s->u[3 * v->leader + i] + across[i] * sin(angle) - 2 * half * half * v->arm[i];
}

void kinematics_follow(const model *m, model_state *s)
{
    for (int i = 0; i < m->scene->nodes; i++)
        if (m->mesh.vertex[i].angles > 0)
            sequence_orientation(m, s, i, NULL, &s->q[4 * i]);
    for (int i = 0; i < m->scene->nodes; i++) {
        const mesh_vertex *v = &m->mesh.vertex[i];
        if (v->led)
            follow_leader(m, s, i);
    }
    for (int i = 0; i < m->scene->nodes; i++) {
        const mesh_vertex *v = &m->mesh.vertex[i];
        if (v->body == i)
            continue;
        double rho[3];
        kinematics_offset(m, s, i, rho);
        for (int k = 0; k < 3; k++)
            s->u[3 * i + k] = s->u[3 * v->body + k] + (rho[k] - v->offset[k]);
        memcpy(&s->q[4 * i], &s->q[4 * v->body], 4 * sizeof(double));
    }
    release_follow(m, s);
    turns_follow(m, s);
}

void kinematics_gather(const model *m, const model_state *s, const mesh_element *el, node_state x[])
{
    for (int k = 0; k < el->nodes; k++) {
        const int v = el->vertex[k];
        double R[9];
        kinematics_position(m, s, v, x[k].r);
        memcpy(x[k].u, &s->u[3 * v], sizeof x[k].u);
        rotation_matrix(&s->q[4 * v], R);
        mat3_mul(R, el->triad[k], x[k].R);
        x[k].a = el->warp[k] == NONE ? 0 : s->warp[el->warp[k]];
        for (int i = 0; i < el->scalars; i++)
            x[k].scalar[i] = mesh_scalar(el, k, i) == NONE ? 0 : s->warp[mesh_scalar(el, k, i)];
    }
}

void kinematics_turn_back(const mesh_vertex *v, double A[9])
{
    double half[9];
    if (!v->turned)
        return;
    mat3_mul(v->along, A, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = vec3_dot(&half[3 * i], &v->along[3 * j]);
}

void kinematics_turn_matrix(const mesh_vertex *v, int n, int at, double K[])
{
    if (!v->turned)
        return;
    for (int i = 0; i < n; i++)
        kinematics_to_own(v, K + i * n + at);
    for (int j = 0; j < n; j++) {
        double column[3] = {K[at * n + j], K[(at + 1) * n + j], K[(at + 2) * n + j]};
        kinematics_to_own(v, column);
        for (int i = 0; i < 3; i++)
            K[(at + i) * n + j] = column[i];
    }
}

static void body_increment(const model *m, const model_state *s, int body, const double dx[],
                           double out[6])
{
    const mesh_vertex *v = &m->mesh.vertex[body];
    double d[6];
    for (int c = 0; c < 6; c++)
        d[c] = v->coordinate[c] == NONE ? 0 : dx[v->coordinate[c]];
    kinematics_to_fixed(v, d);
    memcpy(out, d, 6 * sizeof(double));
    if (v->led) {
        double moved[3];
        kinematics_arm(m, s, body, moved);
        for (int i = 0; i < 3; i++)
            out[i] += moved[i] * d[3];
    }
    if (v->angles > 0) {
        double b[3][3];
        kinematics_axes(m, s, body, b);
        for (int i = 0; i < 3; i++) {
            out[3 + i] = 0;
            for (int k = 0; k < v->angles; k++)
                out[3 + i] += b[k][i] * d[3 + k];
        }
    }
}

void kinematics_local(const model *m, const model_state *s, const mesh_element *el,
                      const double dx[], double local[])
{
    for (int k = 0; k < el->nodes; k++) {
        double *d = &local[NODE_COORDINATES * k];
        for (int c = 0; c < 7; c++)
            d[c] = el->index[NODE_COORDINATES * k + c] == NONE
                       ? 0
                       : dx[el->index[NODE_COORDINATES * k + c]];
        if (el->plain)
            continue;
        const int v = el->vertex[k], body = m->mesh.vertex[v].body;
        body_increment(m, s, body, dx, d);
        if (body != v) {
            double rho[3], moved[3];
            kinematics_offset(m, s, v, rho);
            vec3_cross(d + 3, rho, moved);
            for (int i = 0; i < 3; i++)
                d[i] += moved[i];
        }
        if (release_of(m, v) != NULL)
            release_add_local(m, s, v, dx, d);
    }
    for (int c = NODE_COORDINATES * el->nodes; c < mesh_own_coordinates(el); c++)
        local[c] = el->index[c] == NONE ? 0 : dx[el->index[c]];
}

void kinematics_frame(const model *m, const model_state *s, int node, double r[3], double q[4])
{
    kinematics_position(m, s, node, r);
    memcpy(q, &s->q[4 * node], 4 * sizeof(double));
}

double kinematics_component(const model *m, const model_state *s, int node, int component)
{
    if (component < SCENE_RX)
        return s->u[3 * node + component];
    const mesh_vertex *v = &m->mesh.vertex[node];
    if (v->body == node && v->angles == 0 && v->vector_driver[0] == NONE &&
        m->scene->node[node].angle[component - SCENE_RX] != SCENE_FREE)
        return s->angle[3 * node + component -
                        SCENE_RX]; /* an angle about a fixed axis, which may exceed pi */
    return turns_of_node(s, node)[component - SCENE_RX];
}

/* Returns a component of R^T (r - r_from) - (r - r_from)_0 with the rotation R of `from`, or of the
 * relative rotation vector. */
double kinematics_relative(const model *m, const model_state *s, int from, int node, int component)
{
    double back[4], q[4], t[3], apart[3], first[3], turned[3];
    rotation_conjugate(&s->q[4 * from], back);
    if (component >= SCENE_RX) {
        const double *followed = turns_between(m, s, from, node);
        if (followed != NULL)
            return followed[component - SCENE_RX];
        rotation_compose(back, &s->q[4 * node], q);
        rotation_log(q, t);
        return t[component - SCENE_RX];
    }
    for (int i = 0; i < 3; i++) {
        first[i] = m->mesh.vertex[node].position[i] - m->mesh.vertex[from].position[i];
        apart[i] = first[i] + (s->u[3 * node + i] - s->u[3 * from + i]);
    }
    rotation_apply(back, apart, turned);
    return turned[component] - first[component];
}

double kinematics_driver_value(const model *m, const model_state *s, int driver)
{
    (void)m;
    return s->driver[driver];
}

/* Returns the cosine of the angle between the chord of an element and the x axis of one of its
 * nodes. */
static double chord_cosine(const model *m, const model_state *s, const mesh_element *el, int node)
{
    double p[3], q[3], d[3], axis[3];
    const double *triad = el->triad[node], x[3] = {triad[0], triad[3], triad[6]};
    kinematics_position(m, s, el->vertex[0], p);
    kinematics_position(m, s, el->vertex[m->mesh.nodes - 1], q);
    for (int i = 0; i < 3; i++)
        d[i] = q[i] - p[i];
    rotation_apply(&s->q[4 * el->vertex[node]], x, axis);
    return vec3_dot(d, axis) / vec3_norm(d);
}

/* Returns the cosine of half the angle between the ends of an element. chords 1: or, if it is
 * smaller, that of the larger angle between the chord and the x axis of an end. */
static double half_cosine(const model *m, const model_state *s, const mesh_element *el, int chords)
{
    double turn = 0, least = 1;
    for (int k = 0; k + 1 < m->mesh.nodes; k++) {
        const double *p = &s->q[4 * el->vertex[k]], *q = &s->q[4 * el->vertex[k + 1]];
        least = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
        if (m->mesh.nodes > 2)
            turn += acos(fmax(-1, fmin(1, least)));
    }
    if (m->mesh.nodes > 2)
        least = cos(fmin(turn, PI));
    if (!chords)
        return least;
    const double cosine =
        fmin(chord_cosine(m, s, el, 0), chord_cosine(m, s, el, m->mesh.nodes - 1));
    return fmin(least, sqrt(fmax(0, (1 + cosine) / 2)));
}

double kinematics_largest_turn(const model *m, const model_state *s, int chords, int *index)
{
    double least = 1;
    *index = 0;
    for (int i = 0; i < m->mesh.elements; i++) {
        const double half = half_cosine(m, s, &m->mesh.element[i], chords);
        if (!(half >= least)) {
            least = half;
            *index = i;
        }
    }
    return 2 * acos(fmax(-1, least));
}

/* Returns the twist [rad] of the last node of an element relative to the first node, about the
 * undeformed x axis. */
static double twist_of(const model *m, const model_state *s, const mesh_element *el)
{
    double back[4], q[4];
    const double *triad = el->triad[0], x[3] = {triad[0], triad[3], triad[6]};
    rotation_conjugate(&s->q[4 * el->vertex[0]], back);
    rotation_compose(back, &s->q[4 * el->vertex[m->mesh.nodes - 1]], q);
    const double angle = fabs(2 * atan2(vec3_dot(q + 1, x), q[0]));
    return angle > PI ? 2 * PI - angle : angle;
}

double kinematics_largest_rise(const model *m, int *index)
{
    double largest = 0;
    *index = 0;
    for (int i = 0; i < m->mesh.elements; i++) {
        const mesh_kind *k = &m->mesh.kind[m->mesh.element[i].kind];
        const section *c = &m->section[k->section];
        const double square = c->matrices ? c->stiffness[35] / c->stiffness[0] : c->Iz / c->A,
                     rise = k->length * k->length * fabs(k->curvature[2]) / 8 / sqrt(square);
        if (rise > largest) {
            largest = rise;
            *index = i;
        }
    }
    return largest;
}

double kinematics_largest_twist(const model *m, const model_state *s, int *index)
{
    double largest = 0;
    *index = 0;
    for (int i = 0; i < m->mesh.elements; i++) {
        const double twist = twist_of(m, s, &m->mesh.element[i]);
        if (!(twist <= largest)) {
            largest = twist;
            *index = i;
        }
    }
    return largest;
}

int kinematics_coordinate(const model *m, int node, int component)
{
    return m->mesh.vertex[node].body == node ? m->mesh.vertex[node].coordinate[component] : NONE;
}

/* Appends the coordinates of a released end to those of its body, rotations first. Returns their
 * number. */
static int append_own(const model *m, int vertex, int size, int count, int index[])
{
    const mesh_release *r = release_of(m, vertex);
    for (int k = 0; r != NULL && k < r->turns && count < size; k++)
        index[count++] = m->mesh.vertex[vertex].coordinate[SCENE_RX + k];
    for (int k = 0; r != NULL && k < r->slides && count < size; k++)
        index[count++] = m->mesh.vertex[vertex].coordinate[k];
    return count;
}

int kinematics_node_jacobian(const model *m, const model_state *s, int node, int size, int index[],
                             double T[])
{
    const model_state *state = s != NULL ? s : m->rest;
    const mesh_vertex *v = &m->mesh.vertex[node], *body = &m->mesh.vertex[v->body];
    int count = 0, slot[6];
    for (int c = 0; c < 6; c++) {
        slot[c] = NONE;
        if (body->coordinate[c] == NONE || count >= size)
            continue;
        for (int k = 0; k < count; k++)
            if (index[k] == body->coordinate[c])
                slot[c] = k;
        if (slot[c] == NONE) {
            slot[c] = count;
            index[count++] = body->coordinate[c];
        }
    }
    const int first_own = count;
    count = append_own(m, node, size, count, index);
    memset(T, 0, 6 * (size_t)count * sizeof *T);
    double b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, rho[3];
    if (body->angles > 0)
        kinematics_axes(m, state, v->body, b);
    kinematics_offset(m, state, node, rho);
    for (int c = 0; c < 6; c++) {
        if (slot[c] == NONE)
            continue;
        if (c < 3) {
            for (int i = 0; i < 3; i++)
                T[i * count + slot[c]] += body->turned ? body->along[3 * i + c] : i == c;
            continue;
        }
        double moved[3], swung[3] = {0, 0, 0};
        vec3_cross(b[c - 3], rho, moved);
        if (body->led && c == 3)
            kinematics_arm(m, state, v->body, swung);
        for (int i = 0; i < 3; i++) {
            T[i * count + slot[c]] += swung[i] + (v->body != node ? moved[i] : 0);
            T[(3 + i) * count + slot[c]] += b[c - 3][i];
        }
    }
    if (count > first_own)
        release_jacobian(m, state, node, count, first_own, T);
    return count;
}

const model_state *kinematics_rest(const model *m)
{
    return m->rest;
}

double kinematics_state_path(const model_state *s)
{
    return s->path;
}

const double *kinematics_strains(const model_state *s)
{
    return s->e;
}

static status block_alloc(size_t size, model_state **out, fault *f)
{
    model_state *s = *out = calloc(1, sizeof *s);
    if (s != NULL)
        s->block = calloc(size + 1, sizeof *s->block);
    if (s != NULL && s->block != NULL) {
        s->size = size;
        return STATUS_OK;
    }
    free(s);
    *out = NULL;
    return fault_memory(f, "a state");
}

status kinematics_nodes_alloc(const model *m, const model_state *from, model_state **out, fault *f)
{
    const size_t N = (size_t)m->scene->nodes, drivers = (size_t)m->scene->drivers;
    const size_t turns = 3 * (size_t)m->mesh.turns;
    TRY(block_alloc(10 * N + drivers + turns, out, f));
    model_state *s = *out;
    s->path = from->path;
    s->u = s->block;
    s->q = s->u + 3 * N;
    s->angle = s->q + 4 * N;
    s->driver = s->angle + 3 * N;
    s->turn = s->driver + drivers;
    memcpy(s->u, from->u, 3 * N * sizeof *s->u);
    memcpy(s->q, from->q, 4 * N * sizeof *s->q);
    memcpy(s->angle, from->angle, 3 * N * sizeof *s->angle);
    memcpy(s->driver, from->driver, drivers * sizeof *s->driver);
    memcpy(s->turn, from->turn, turns * sizeof *s->turn);
    return STATUS_OK;
}

static void begin_history(const model *m, model_state *s)
{
    const size_t each = (size_t)m->mesh.history;
    if (m->rest != NULL && m->rest != s)
        memcpy(s->history, m->rest->history, (size_t)m->mesh.elements * each * sizeof *s->history);
    for (int i = 0; i < m->mesh.elements && m->rest == s && m->mesh.type->begin != NULL; i++) {
        const mesh_element *el = &m->mesh.element[i];
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, el, x);
        m->mesh.type->begin(m->mesh.kind[el->kind].data, x, &s->history[(size_t)i * each]);
    }
}

status kinematics_state_alloc(const model *m, model_state **out, fault *f)
{
    const size_t V = (size_t)m->mesh.vertices, E = (size_t)m->mesh.elements;
    TRY(block_alloc(V * 10 + 3 * (size_t)m->mesh.releases + (size_t)m->mesh.warps +
                        (size_t)m->scene->drivers +
                        E * (size_t)(2 * m->mesh.strains + m->mesh.inner + m->mesh.history) +
                        3 * (size_t)m->mesh.turns +
                        (scene_has_feedback(m->scene) ? (size_t)m->scene->loads : 0),
                    out, f));
    model_state *s = *out;
    s->u = s->block;
    s->q = s->u + 3 * V;
    s->angle = s->q + 4 * V;
    s->shift = s->angle + 3 * V;
    s->warp = s->shift + 3 * m->mesh.releases;
    s->driver = s->warp + m->mesh.warps;
    s->e = s->driver + m->scene->drivers;
    s->sigma = s->e + E * (size_t)m->mesh.strains;
    s->inner = s->sigma + E * (size_t)m->mesh.strains;
    s->history = s->inner + E * (size_t)m->mesh.inner;
    s->turn = s->history + E * (size_t)m->mesh.history;
    s->feedback = s->turn + 3 * (size_t)m->mesh.turns;
    for (size_t i = 0; i < V; i++)
        rotation_identity(&s->q[4 * i]);
    if (m->mesh.type->rest != NULL)
        for (size_t i = 0; i < E; i++)
            m->mesh.type->rest(m->mesh.kind[m->mesh.element[i].kind].data,
                               &s->inner[i * (size_t)m->mesh.inner]);
    if (m->mesh.history > 0)
        begin_history(m, s);
    return STATUS_OK;
}

void kinematics_commit(const model *m, model_state *s)
{
    for (int i = 0; i < m->mesh.elements && m->mesh.history > 0; i++) {
        const mesh_element *el = &m->mesh.element[i];
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s, el, x);
        m->mesh.type->commit(m->mesh.kind[el->kind].data, x,
                             &s->history[(size_t)i * (size_t)m->mesh.history]);
    }
}

void kinematics_state_free(model_state *s)
{
    if (s == NULL)
        return;
    free(s->block);
    free(s);
}

void kinematics_state_copy(const model *m, const model_state *from, model_state *to)
{
    (void)m;
    memcpy(to->block, from->block, from->size * sizeof *from->block);
    to->path = from->path;
}
