/* Vertices, elements and the data that identical elements share. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/algebra/memory.h"
#include "harness/model/model_impl.h"

/* An arc of constant torsion and curvature between two points (straight when these are zero). */
typedef struct arc {
    double length;         /* along the arc [m] */
    double start[3], R[9]; /* position and triad at p */
    double k[3];           /* [1/m] */
} arc;

/* int_0^s exp(t k~) e_x dt in the triad at p. */
static void arc_chord(const double k[3], double s, double c[3])
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

/* From the axes in which a section is described, about which the scene speaks, to its principal
 * ones. */
static void turn_to_principal(double angle, arc *a)
{
    const double c = cos(angle), d = sin(angle), ky = a->k[1];
    if (d == 0)
        return;
    for (int i = 0; i < 9; i += 3) {
        const double y = a->R[i + 1];
        a->R[i + 1] = c * y + d * a->R[i + 2];
        a->R[i + 2] = c * a->R[i + 2] - d * y;
    }
    a->k[1] = c * ky + d * a->k[2];
    a->k[2] = c * a->k[2] - d * ky;
}

/* The length of a curved arc whose ends are so far apart. */
static status find_length(int member, double distance, arc *a, fault *f)
{
    double c[3];
    for (int i = 0; i < 60; i++) {
        arc_chord(a->k, a->length, c);
        const double error = distance - vec3_norm(c);
        a->length += error;
        if (!(a->length > 0) || vec3_norm(a->k) * a->length > 6.28)
            return fault_set(
                f, STATUS_REFUSED,
                "member %d: no arc of that curvature joins its ends; give a smaller one", member);
        if (fabs(error) <= 1e-16 * distance)
            break;
    }
    return STATUS_OK;
}

/* axes_angle [rad]: of its section. */
static status arc_of(const scene *s, int member, double axes_angle, arc *out, fault *f)
{
    const scene_member *m = &s->member[member];
    double chord[3], c[3], B[9], local[9];
    for (int i = 0; i < 3; i++)
        chord[i] = s->node[m->q].position[i] - s->node[m->p].position[i];
    const double distance = vec3_norm(chord);
    memcpy(out->start, s->node[m->p].position, sizeof out->start);
    memcpy(out->k, m->curvature, sizeof out->k);
    out->length = distance;
    if (vec3_norm(out->k) > 0)
        TRY(find_length(member, distance, out, f));
    if (rotation_triad(chord, m->y_axis, B) != 0)
        return fault_set(f, STATUS_REFUSED, "member %d: its y axis is parallel to it", member);
    const double ey[3] = {0, 1, 0};
    arc_chord(out->k, out->length, c);
    if (rotation_triad(c, ey, local) != 0)
        return fault_set(f, STATUS_REFUSED, "member %d: its arc turns into its own y axis", member);
    for (int i = 0; i < 3; i++) /* R = B local^T */
        for (int j = 0; j < 3; j++)
            out->R[3 * i + j] = vec3_dot(&B[3 * i], &local[3 * j]);
    turn_to_principal(axes_angle, out);
    return STATUS_OK;
}

static void arc_at(const arc *a, double s, double position[3], double R[9])
{
    double c[3], rotation_vector[3], q[4], along[9];
    arc_chord(a->k, s, c);
    mat3_mul_vec(a->R, c, position);
    for (int i = 0; i < 3; i++) {
        position[i] += a->start[i];
        rotation_vector[i] = a->k[i] * s;
    }
    rotation_exp(rotation_vector, q);
    rotation_matrix(q, along);
    mat3_mul(a->R, along, R);
}

static int divisions(const scene *s, int member, int elements)
{
    return s->member[member].divisions > 0 ? s->member[member].divisions : elements;
}

/* Of a sequence's next angle; any length. */
static void add_axis(const double axis[3], mesh_vertex *v)
{
    const double length = vec3_norm(axis);
    for (int k = 0; k < 3; k++)
        v->axis[v->angles][k] = axis[k] / length;
    v->angles++;
}

static void scene_vertices(model *m)
{
    const scene *s = m->scene;
    for (int i = 0; i < s->nodes; i++) {
        mesh_vertex *v = &m->vertex[i];
        const scene_node *n = &s->node[i];
        memcpy(v->position, n->position, sizeof v->position);
        v->body = n->attached == SCENE_NONE ? i : n->attached;
        for (int k = 0; k < 3; k++) {
            v->offset[k] = n->position[k] - s->node[v->body].position[k];
            v->vector_driver[k] = n->rotation == SCENE_ROTATION_VECTOR ? n->angle[k] : NONE;
        }
        if (n->rotation == SCENE_ROTATION_FORK) {
            double normal[3]; /* of the guides */
            vec3_cross(n->axis[1], n->axis[0], normal);
            add_axis(normal, v);
            add_axis(n->axis[1], v);
        }
        if (n->rotation == SCENE_ROTATION_SEQUENCE)
            while (v->angles < 3 && vec3_norm(n->axis[v->angles]) > 0)
                add_axis(n->axis[v->angles], v);
    }
}

static int same_vector(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Index of the kind of element of a member with this length and curvature; made when it is new. */
static status kind_of(model *m, const scene_member *member, double length,
                      const double curvature[3], int *out, fault *f)
{
    const int profile = member->section;
    for (int i = 0; i < m->kinds; i++)
        if (m->kind[i].section == profile && fabs(m->kind[i].length - length) <= 1e-12 * length &&
            same_vector(m->kind[i].curvature, curvature) &&
            same_vector(m->kind[i].strain, member->strain)) {
            *out = i;
            return STATUS_OK;
        }
    mesh_kind *k = &m->kind[m->kinds];
    element_request request = {
        .section = &m->section[profile], .length = length, .options = m->options};
    memcpy(request.curvature, curvature, sizeof request.curvature);
    memcpy(request.strain, member->strain, sizeof request.strain);
    TRY(features_of_section(m, profile, &request.features, f));
    k->section = profile;
    k->length = length;
    memcpy(k->curvature, curvature, sizeof k->curvature);
    memcpy(k->strain, member->strain, sizeof k->strain);
    k->data = calloc(1, m->type->data_size(&request));
    if (k->data == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for an element");
    *out = m->kinds++;
    return m->type->prepare(&request, k->data, f);
}

/* The vertices of one element of n along an arc: positions, triads, warping comes later. */
static status add_element(model *m, const arc *a, int member, int number, int n, int inner_vertex,
                          fault *f)
{
    mesh_element *el = &m->element[m->elements];
    const int curved = (m->type->offers & FEATURE_CURVATURE) && vec3_norm(a->k) > 0,
              last = m->nodes - 1;
    const double straight[3] = {0, 0, 0};
    el->member = member;
    el->nodes = m->nodes;
    for (int k = 0; k <= last; k++) {
        const int at_start = number == 0 && k == 0, at_end = number == n - 1 && k == last;
        el->vertex[k] = inner_vertex + number * last + k - 1;
        if (at_start)
            el->vertex[k] = m->scene->member[member].p;
        else if (at_end)
            el->vertex[k] = m->scene->member[member].q;
        mesh_vertex *v = &m->vertex[el->vertex[k]];
        double position[3], between[3];
        arc_at(a, a->length * (number * last + k) / (n * last), position, el->triad[k]);
        if (!at_start && !at_end) {
            v->body = el->vertex[k];
            memcpy(v->position, position, sizeof position);
            for (int i = 0; i < 3; i++)
                v->vector_driver[i] = NONE;
        }
        if (k < last || curved)
            continue;
        /* Not curved: one triad along the chord. */
        const double *p = m->vertex[el->vertex[0]].position;
        double y[3];
        for (int i = 0; i < 3; i++) {
            between[i] = v->position[i] - p[i];
            y[i] = el->triad[0][3 * i + 1] + el->triad[last][3 * i + 1];
        }
        if (rotation_triad(between, y, el->triad[0]) != 0)
            return fault_set(f, STATUS_REFUSED,
                             "member %d: its elements turn too far; use more of them", member);
        for (int i = 1; i <= last; i++)
            memcpy(el->triad[i], el->triad[0], sizeof el->triad[0]);
        m->elements++;
        return kind_of(m, &m->scene->member[member], vec3_norm(between), straight, &el->kind, f);
    }
    m->elements++;
    return kind_of(m, &m->scene->member[member], a->length / n, a->k, &el->kind, f);
}

/* Warping slot of a member's end: shared by name, own, or none. */
static int end_warp(model *m, int name, int *named)
{
    if (name == SCENE_WARP_FIXED)
        return NONE;
    if (name < 0)
        return m->warps++;
    if (named[name] == NONE)
        named[name] = m->warps++;
    return named[name];
}

static void add_warps(model *m, int *named)
{
    const int last = m->nodes - 1;
    for (int member = 0; member < m->scene->members; member++) {
        const scene_member *sm = &m->scene->member[member];
        unsigned features;
        features_of_section(m, sm->section, &features, NULL);
        const int warps = (features & FEATURE_WARPING) != 0,
                  nothing_warps = m->section[sm->section].Iw <= 0;
        for (int i = m->first_element[member]; i < m->first_element[member + 1]; i++)
            for (int k = 0; k <= last; k++) {
                mesh_element *el = &m->element[i];
                const int at_start = i == m->first_element[member] && k == 0,
                          at_end = i + 1 == m->first_element[member + 1] && k == last;
                if (!warps)
                    el->warp[k] = NONE;
                else if (nothing_warps) /* kept although nothing warps: an amplitude of its own
                                           changes nothing */
                    el->warp[k] = m->warps++;
                else if (at_start || at_end)
                    el->warp[k] = end_warp(m, at_start ? sm->warp_p : sm->warp_q, named);
                else
                    el->warp[k] = k == 0 ? m->element[i - 1].warp[last] : m->warps++;
            }
    }
}

static int largest_name(const scene *s)
{
    int largest = -1;
    for (int i = 0; i < s->members; i++) {
        largest = s->member[i].warp_p > largest ? s->member[i].warp_p : largest;
        largest = s->member[i].warp_q > largest ? s->member[i].warp_q : largest;
    }
    return largest;
}

static status allocate(model *m, int elements, fault *f)
{
    const scene *s = m->scene;
    const double most = 1e8;
    double total = 0;
    for (int i = 0; i < s->members; i++)
        total += divisions(s, i, elements);
    const double per_element = 8e3; /* bytes of an element with its share of matrices and factors,
                                       measured on straight members */
    char what[80];
    snprintf(what, sizeof what, "%.0f elements", total);
    TRY(memory_check(total * per_element, what, "give fewer", f));
    if (total > most)
        return fault_set(f, STATUS_REFUSED, "%.0f elements: at most %.0f can be numbered", total,
                         most);
    m->vertices = s->nodes + (int)total * (m->nodes - 1) - s->members;
    m->vertex = calloc((size_t)m->vertices, sizeof *m->vertex);
    m->element = calloc((size_t)total, sizeof *m->element);
    m->kind = calloc((size_t)total, sizeof *m->kind);
    m->warp = calloc((size_t)total * ELEMENT_MAX_NODES, sizeof *m->warp);
    m->first_element = calloc((size_t)s->members + 1, sizeof *m->first_element);
    if (m->vertex == NULL || m->element == NULL || m->kind == NULL || m->warp == NULL ||
        m->first_element == NULL)
        return fault_set(f, STATUS_REFUSED, "%.0f elements: more than memory allows; give fewer",
                         total);
    return STATUS_OK;
}

status mesh_build(model *m, int elements, fault *f)
{
    const scene *s = m->scene;
    if (elements < 1)
        return fault_set(f, STATUS_REFUSED, "%d elements: give at least 1", elements);
    if (s->members < 1)
        return fault_set(f, STATUS_REFUSED, "scene %s: it has no member", s->name);
    TRY(allocate(m, elements, f));
    scene_vertices(m);
    int inner_vertex = s->nodes;
    for (int member = 0; member < s->members; member++) {
        const int n = divisions(s, member, elements);
        arc a;
        TRY(arc_of(s, member, m->section[s->member[member].section].axes_angle, &a, f));
        m->first_element[member] = m->elements;
        for (int i = 0; i < n; i++)
            TRY(add_element(m, &a, member, i, n, inner_vertex, f));
        inner_vertex += n * (m->nodes - 1) - 1;
        m->size = a.length > m->size ? a.length : m->size;
    }
    m->first_element[s->members] = m->elements;
    const int names = largest_name(s) + 1;
    int *named = malloc((size_t)(names > 0 ? names : 1) * sizeof *named);
    if (named == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for warping coordinates");
    for (int i = 0; i < names; i++)
        named[i] = NONE;
    add_warps(m, named);
    free(named);
    return STATUS_OK;
}
