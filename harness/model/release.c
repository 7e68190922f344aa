#include "harness/model/model_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

/* Computes the chord c = int_0^s exp(t k~) e_x dt of an arc of length s, in the triad at p. k~ is
 * the cross-product matrix of its torsion and curvatures k. */
static void chord_of(const double k[3], double s, double c[3])
{
    const double w = vec3_norm(k), angle = w * s;
    double first[3], second[3];
    const double e[3] = {1, 0, 0};
    vec3_cross(k, e, first);
    vec3_cross(k, first, second);
    const double half = sin(angle / 2);
    const double a =
        angle < 1e-4 ? s * s / 2 * (1 - angle * angle / 12) : 2 * half * half / (w * w);
    const double b = angle < 1e-2
                         ? s * s * s / 6 * (1 - angle * angle / 20 * (1 - angle * angle / 42))
                         : (angle - sin(angle)) / (w * w * w);
    for (int i = 0; i < 3; i++)
        c[i] = s * e[i] + a * first[i] + b * second[i];
}

/* Rotates the triad, bow and curvatures of an arc from the axes in which the scene describes the
 * section to its principal axes. */
static void turn_to_principal(double angle, member_arc *a)
{
    const double c = cos(angle), d = sin(angle), ky = a->k[1];
    if (d == 0)
        return;
    for (int i = 0; i < 9; i += 3) {
        const double y = a->R[i + 1];
        a->R[i + 1] = c * y + d * a->R[i + 2];
        a->R[i + 2] = c * a->R[i + 2] - d * y;
    }
    const double by = a->bow[0];
    a->bow[0] = c * by + d * a->bow[1];
    a->bow[1] = c * a->bow[1] - d * by;
    a->k[1] = c * ky + d * a->k[2];
    a->k[2] = c * a->k[2] - d * ky;
}

/* Finds the length of a curved arc from the distance between its ends. REFUSED: there is no such
 * arc. */
static status find_length(const scene *s, int member, double distance, member_arc *a, fault *f)
{
    double c[3];
    for (int i = 0; i < 60; i++) {
        chord_of(a->k, a->length, c);
        const double error = distance - vec3_norm(c);
        a->length += error;
        if (!(a->length > 0) || vec3_norm(a->k) * a->length > 6.28)
            return fault_set(f, STATUS_REFUSED,
                             "%s: no arc of that curvature joins the ends of the member; give a "
                             "smaller curvature",
                             scene_called(s, SCENE_MEMBERS, member).text);
        if (fabs(error) <= 1e-16 * distance)
            break;
    }
    return STATUS_OK;
}

status member_arc_between(const scene *s, int member, const double chord[3], const double y[3],
                          member_arc *out, fault *f)
{
    double c[3], B[9], local[9];
    const double distance = vec3_norm(chord);
    out->length = distance;
    if (vec3_norm(out->k) > 0)
        TRY(find_length(s, member, distance, out, f));
    if (rotation_triad(chord, y, B) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the y axis is parallel to the member; give another direction",
                         scene_called(s, SCENE_MEMBERS, member).text);
    const double ey[3] = {0, 1, 0};
    chord_of(out->k, out->length, c);
    if (rotation_triad(c, ey, local) != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the arc of the member becomes parallel to its y axis; give another direction",
            scene_called(s, SCENE_MEMBERS, member).text);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->R[3 * i + j] = vec3_dot(&B[3 * i], &local[3 * j]);
    return STATUS_OK;
}

status member_arc_of(const scene *s, int member, double axes_angle, member_arc *out, fault *f)
{
    const scene_member *m = &s->member[member];
    double chord[3];
    scene_chord(s, member, chord);
    scene_end(s, member, 0, out->start);
    memcpy(out->k, m->curvature, sizeof out->k);
    memcpy(out->bow, m->bow, sizeof out->bow);
    out->half_waves = m->half_waves;
    TRY(member_arc_between(s, member, chord, m->y_axis, out, f));
    turn_to_principal(axes_angle, out);
    return STATUS_OK;
}

void member_arc_at(const member_arc *a, double s, double position[3], double R[9])
{
    double c[3], rotation_vector[3], q[4], along[9];
    chord_of(a->k, s, c);
    mat3_mul_vec(a->R, c, position);
    for (int i = 0; i < 3; i++) {
        position[i] += a->start[i];
        rotation_vector[i] = a->k[i] * s;
    }
    rotation_exp(rotation_vector, q);
    rotation_matrix(q, along);
    mat3_mul(a->R, along, R);
    if (a->bow[0] == 0 && a->bow[1] == 0)
        return;
    const double wave = sin(a->half_waves * PI * s / a->length);
    for (int i = 0; i < 3; i++)
        position[i] += wave * (a->bow[0] * R[3 * i + 1] + a->bow[1] * R[3 * i + 2]);
}

enum { BALL = 3 }; /* three rotations without order */

static int is_own(const scene_member *m, int end)
{
    return m->release[end].count > 0 || scene_is_beside(m, end);
}

int release_count(const scene *s)
{
    int count = 0;
    for (int i = 0; i < s->members; i++)
        for (int end = 0; end < 2; end++)
            count += is_own(&s->member[i], end);
    return count;
}

/* Adds the vertex of an end. R: axes of the member at this end. */
static void add_end(model *m, int member, int end, const double R[9])
{
    const scene_member *sm = &m->scene->member[member];
    const scene_release *what = &sm->release[end];
    const int node = end ? sm->q : sm->p, vertex = m->mesh.first_release + m->mesh.releases;
    mesh_element *el =
        &m->mesh
             .element[end ? m->mesh.first_element[member + 1] - 1 : m->mesh.first_element[member]];
    mesh_release *r = &m->mesh.release[m->mesh.releases++];
    r->node = node;
    m->mesh.vertex[vertex] = m->mesh.vertex[node]; /* position and body */
    m->mesh.vertex[vertex].angles = 0;
    for (int k = 0; k < 3; k++) {
        m->mesh.vertex[vertex].vector_driver[k] = NONE;
        m->mesh.vertex[vertex].position[k] += sm->offset[end][k];
        m->mesh.vertex[vertex].offset[k] += sm->offset[end][k];
    }
    el->vertex[end ? el->nodes - 1 : 0] = vertex;
    for (int k = 0; k < what->count; k++) {
        const int c = what->component[k], normal = scene_normal(m->scene);
        const int across = normal != SCENE_NONE && fabs(R[3 * normal + c % 3]) > 0.5;
        if (normal != SCENE_NONE && across != (c >= SCENE_RX))
            continue;
        *(c < SCENE_RX ? &r->slide_of[r->slides] : &r->turn_of[r->turns]) = c;
        double *axis = c < SCENE_RX ? r->slide[r->slides++] : r->turn[r->turns++];
        for (int i = 0; i < 3; i++)
            axis[i] = R[3 * i + c % 3];
    }
}

status release_build(model *m, fault *f)
{
    for (int i = 0; i < m->scene->members; i++)
        for (int end = 0; end < 2; end++) {
            member_arc axis;
            double position[3], R[9];
            if (!is_own(&m->scene->member[i], end))
                continue;
            TRY(member_arc_of(imperfect_lines(m), i, 0, &axis, f));
            member_arc_at(&axis, end * axis.length, position, R);
            imperfect_move(m, i, end, position, R);
            add_end(m, i, end, R);
        }
    return STATUS_OK;
}

/* Computes the orientation after the rotations of a released end. For a ball joint, this is the
 * orientation of the body. b[turns x 3]: spatial axes of the rotations, or the fixed axes for a
 * ball joint. */
static void follow_turns(const mesh_release *r, const double angle[3], const double body[4],
                         double b[3][3], double q[4])
{
    memcpy(q, body, 4 * sizeof *q);
    for (int k = 0; k < r->turns; k++) {
        double turn[3], step[4];
        for (int i = 0; i < 3; i++) {
            turn[i] = r->turn[k][i] * angle[k];
            b[k][i] = i == k;
        }
        if (r->turns == BALL)
            continue;
        rotation_apply(q, r->turn[k], b[k]);
        rotation_exp(turn, step);
        rotation_compose(q, step, q);
    }
}

void release_turn_axes(const model *m, const model_state *s, int vertex, double b[3][3])
{
    double q[4];
    follow_turns(release_of(m, vertex), &s->angle[3 * vertex],
                 &s->q[4 * m->mesh.vertex[vertex].body], b, q);
}

void release_slide_axes(const model *m, const model_state *s, int vertex, double along[3][3],
                        double apart[3])
{
    const mesh_release *r = release_of(m, vertex);
    memset(apart, 0, 3 * sizeof *apart);
    for (int k = 0; k < r->slides; k++) {
        rotation_apply(&s->q[4 * vertex], r->slide[k], along[k]);
        for (int i = 0; i < 3; i++)
            apart[i] += along[k][i] * s->shift[3 * (vertex - m->mesh.first_release) + k];
    }
}

void release_add_local(const model *m, const model_state *s, int vertex, const double dx[],
                       double d[6])
{
    const mesh_release *r = release_of(m, vertex);
    const int *coordinate = m->mesh.vertex[vertex].coordinate;
    double b[3][3], along[3][3], apart[3], moved[3];
    release_turn_axes(m, s, vertex, b);
    release_slide_axes(m, s, vertex, along, apart);
    for (int i = 0; i < 3; i++) {
        d[3 + i] = r->turns == BALL ? 0 : d[3 + i];
        for (int k = 0; k < r->turns; k++)
            d[3 + i] += b[k][i] * dx[coordinate[3 + k]];
    }
    vec3_cross(d + 3, apart, moved);
    for (int i = 0; i < 3 && r->slides > 0; i++) {
        d[i] += moved[i];
        for (int k = 0; k < r->slides; k++)
            d[i] += along[k][i] * dx[coordinate[k]];
    }
}

void release_jacobian(const model *m, const model_state *s, int vertex, int count, int own,
                      double T[])
{
    const mesh_release *r = release_of(m, vertex);
    double b[3][3], along[3][3], apart[3];
    release_turn_axes(m, s, vertex, b);
    release_slide_axes(m, s, vertex, along, apart);
    for (int k = 0; k < own && r->turns == BALL; k++)
        for (int i = 3; i < 6; i++)
            T[i * count + k] = 0;
    for (int k = 0; k < r->turns; k++)
        for (int i = 0; i < 3; i++)
            T[(3 + i) * count + own + k] = b[k][i];
    for (int k = 0; k < own + r->turns; k++) {
        const double turn[3] = {T[3 * count + k], T[4 * count + k], T[5 * count + k]};
        double moved[3];
        vec3_cross(turn, apart, moved);
        for (int i = 0; i < 3; i++)
            T[i * count + k] += moved[i];
    }
    for (int k = 0; k < r->slides; k++)
        for (int i = 0; i < 3; i++)
            T[i * count + own + r->turns + k] = along[k][i];
}

static int end_vertex(const model *m, int member, int end)
{
    const int *first = m->mesh.first_element;
    const mesh_element *el = &m->mesh.element[end ? first[member + 1] - 1 : first[member]];
    return el->vertex[end ? el->nodes - 1 : 0];
}

double release_value(const model *m, const model_state *s, int member, int end, int component)
{
    const double most = 3;
    const int vertex = end_vertex(m, member, end);
    const mesh_release *r = release_of(m, vertex);
    double back[4], q[4], t[3];
    if (r == NULL)
        return 0;
    for (int k = 0; k < r->slides; k++)
        if (r->slide_of[k] == component)
            return s->shift[3 * (vertex - m->mesh.first_release) + k];
    for (int k = 0; k < r->turns; k++) {
        if (r->turn_of[k] != component)
            continue;
        if (r->turns < BALL)
            return s->angle[3 * vertex + k];
        rotation_conjugate(&s->q[4 * m->mesh.vertex[vertex].body], back);
        rotation_compose(back, &s->q[4 * vertex], q);
        rotation_log(q, t);
        return vec3_norm(t) <= most ? vec3_dot(t, r->turn[k]) : NAN;
    }
    return 0;
}

double release_linear_value(const model *m, const model_state *rest, const double x[], int member,
                            int end, int component, double node[3])
{
    const int vertex = end_vertex(m, member, end);
    const mesh_release *r = release_of(m, vertex);
    const int *coordinate = m->mesh.vertex[vertex].coordinate;
    double sum = 0;
    memset(node, 0, 3 * sizeof *node);
    for (int k = 0; r != NULL && k < r->slides; k++)
        if (r->slide_of[k] == component)
            return x[coordinate[k]];
    for (int k = 0; r != NULL && k < r->turns; k++) {
        if (r->turn_of[k] != component)
            continue;
        if (r->turns < BALL)
            return x[coordinate[3 + k]];
        double b[3][3];
        release_turn_axes(m, rest, vertex, b);
        for (int i = 0; i < 3; i++) {
            node[i] = -r->turn[k][i];
            sum += x[coordinate[3 + i]] * vec3_dot(b[i], r->turn[k]);
        }
    }
    return sum;
}

double release_advance(const model *m, model_state *s, int vertex, const double dx[])
{
    const mesh_release *r = release_of(m, vertex);
    const int *coordinate = m->mesh.vertex[vertex].coordinate;
    double largest = 0, turn[3] = {0}, step[4];
    for (int k = 0; k < r->slides; k++) {
        s->shift[3 * (vertex - m->mesh.first_release) + k] += dx[coordinate[k]];
        largest = larger(largest, fabs(dx[coordinate[k]]) / m->size);
    }
    for (int k = 0; k < r->turns; k++) {
        turn[k] = dx[coordinate[3 + k]];
        s->angle[3 * vertex + k] += turn[k];
        largest = larger(largest, fabs(turn[k]));
    }
    if (r->turns == BALL) {
        rotation_exp(turn, step);
        rotation_compose(step, &s->q[4 * vertex], &s->q[4 * vertex]);
        rotation_normalise(&s->q[4 * vertex]);
    }
    return largest;
}

void release_follow(const model *m, model_state *s)
{
    for (int i = m->mesh.first_release; i < m->mesh.vertices; i++) {
        const mesh_vertex *v = &m->mesh.vertex[i];
        const mesh_release *r = release_of(m, i);
        const double *body = &s->q[4 * v->body];
        double rho[3], along[3][3], apart[3], b[3][3];
        if (r->turns < BALL)
            follow_turns(r, &s->angle[3 * i], body, b, &s->q[4 * i]);
        rotation_apply(body, v->offset, rho);
        release_slide_axes(m, s, i, along, apart);
        for (int k = 0; k < 3; k++)
            s->u[3 * i + k] = s->u[3 * v->body + k] + (rho[k] - v->offset[k]) + apart[k];
    }
}

void release_force(const model *m, const model_state *s, int vertex, double force[6], double own[])
{
    const mesh_release *r = release_of(m, vertex);
    double b[3][3], along[3][3], apart[3];
    release_turn_axes(m, s, vertex, b);
    release_slide_axes(m, s, vertex, along, apart);
    for (int k = 0; k < r->slides; k++)
        own[r->turns + k] = vec3_dot(along[k], force);
    if (r->slides > 0)
        offset_force(apart, force);
    for (int k = 0; k < r->turns; k++)
        own[k] = vec3_dot(b[k], force + 3);
    if (r->turns == BALL)
        memset(force + 3, 0, 3 * sizeof *force);
}

/* Replaces row and column `to` of K by the combination of the three rows and columns at `from`
 * along v. */
static void take_along(int n, int from, const double v[3], int to, double K[])
{
    for (int i = 0; i < n; i++)
        K[i * n + to] = vec3_dot(&K[i * n + from], v);
    for (int j = 0; j < n; j++)
        K[to * n + j] =
            v[0] * K[from * n + j] + v[1] * K[(from + 1) * n + j] + v[2] * K[(from + 2) * n + j];
}

static void add_pair(int n, int a, int b, double value, double K[])
{
    K[a * n + b] += value;
    K[b * n + a] += value;
}

/* Adds the second derivatives F . (theta x along), because the rotations of the end precede its
 * displacements. */
static void take_slides(const mesh_release *r, double along[3][3], const double apart[3], int n,
                        int at, int own, double force[6], double K[])
{
    for (int k = 0; k < r->slides; k++)
        take_along(n, at, along[k], own + r->turns + k, K);
    for (int k = 0; k < r->slides && force != NULL; k++) {
        double cross[3];
        vec3_cross(along[k], force, cross);
        for (int i = 0; i < 3; i++)
            add_pair(n, at + 3 + i, own + r->turns + k, cross[i], K);
    }
    offset_matrix(n, at, apart, force, K);
    if (force != NULL)
        offset_force(apart, force);
}

/* Adds the second derivatives M . (theta x b_j)/2 for rotations of the body, which precede those of
 * the end, and M . (b_i x b_j)/2 for rotations of the end. */
static void add_turned_moment(const mesh_release *r, double b[3][3], const double moment[3], int n,
                              int at, int own, double K[])
{
    for (int j = 0; j < r->turns; j++) {
        double cross[3];
        vec3_cross(b[j], moment, cross);
        for (int i = 0; i < 3; i++)
            add_pair(n, at + 3 + i, own + j, cross[i] / 2, K);
        for (int i = 0; i < j; i++) {
            vec3_cross(b[i], b[j], cross);
            add_pair(n, own + i, own + j, vec3_dot(moment, cross) / 2, K);
        }
    }
}

void release_matrix(const model *m, const model_state *s, int vertex, int n, int at, int own,
                    double force[6], double K[])
{
    const mesh_release *r = release_of(m, vertex);
    double b[3][3], along[3][3], apart[3];
    release_turn_axes(m, s, vertex, b);
    release_slide_axes(m, s, vertex, along, apart);
    if (r->slides > 0)
        take_slides(r, along, apart, n, at, own, force, K);
    for (int k = 0; k < r->turns; k++)
        take_along(n, at + 3, b[k], own + k, K);
    if (r->turns < BALL && force != NULL)
        add_turned_moment(r, b, force + 3, n, at, own, K);
    if (r->turns < BALL)
        return;
    for (int k = 0; k < 3; k++) {
        memset(&K[(at + 3 + k) * n], 0, (size_t)n * sizeof *K);
        for (int i = 0; i < n; i++)
            K[i * n + at + 3 + k] = 0;
    }
    if (force != NULL)
        memset(force + 3, 0, 3 * sizeof *force);
}
