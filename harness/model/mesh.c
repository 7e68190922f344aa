#include "harness/model/model_impl.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/shared/masses.h"

static void add_axis(const double axis[3], mesh_vertex *v)
{
    const double length = vec3_norm(axis);
    for (int k = 0; k < 3; k++)
        v->axis[v->angles][k] = axis[k] / length;
    v->angles++;
}

/* Fixes the rotation of a node about an idle axis (scene_idle_turn). If all rotations are idle, or
 * if not all three are free, the free angles are fixed. Otherwise the rotation is restricted to two
 * axes perpendicular to the idle axis, which rotates with the last of the two angles. */
static void hold_idle(const scene *s, int node, mesh_vertex *v)
{
    double axis[3], across[2][3];
    const int what = scene_idle_turn(s, node, axis);
    if (what == 0)
        return;
    if (v->angles == 1) {
        v->idle = 1;
        return;
    }
    for (int k = 0; k < 3; k++)
        v->idle |= (s->node[node].angle[k] == SCENE_FREE) << k;
    if (what == SCENE_IDLE_ALL || v->idle != 7)
        return;
    v->idle = 0;
    const int least = fabs(axis[0]) < fabs(axis[1]) ? 0 : 1,
              k = fabs(axis[2]) < fabs(axis[least]) ? 2 : least;
    const double other[3] = {k == 0, k == 1, k == 2};
    vec3_cross(axis, other, across[0]);
    vec3_cross(axis, across[0], across[1]);
    add_axis(across[0], v);
    add_axis(across[1], v);
}

static int is_free(const scene_node *n)
{
    return n->translation[0] == SCENE_FREE && n->translation[1] == SCENE_FREE &&
           n->translation[2] == SCENE_FREE;
}

/* Treats components that are multiples of another coordinate. A translation is then along an axis
 * with the length of this multiple. A rotation about a fixed axis becomes an angle about such an
 * axis. */
static void stretch_axes(const model *m, int node, mesh_vertex *v)
{
    for (int c = 0; c < VERTEX_COORDINATES; c++) {
        const scene_tie *tie = model_tie(m, node, c);
        const int turn = c - SCENE_RX;
        if (tie == NULL || tie->ratio == 1)
            continue;
        if (c < SCENE_RX) {
            v->turned = 1;
            for (int i = 0; i < 3; i++)
                v->along[3 * i + c] *= tie->ratio;
            continue;
        }
        if (v->angles == 0)
            add_axis((const double[3]){turn == 0, turn == 1, turn == 2}, v);
        for (int i = 0; i < 3; i++)
            v->axis[0][i] *= tie->ratio;
    }
}

static int is_tied(const model *m, int node)
{
    int tied = 0;
    for (int c = 0; c < SCENE_RX; c++)
        tied |= model_tie(m, node, c) != NULL;
    return tied;
}

static void lead_vertices(model *m)
{
    const scene *s = m->scene;
    for (int i = 0; i < s->constraints; i++)
        for (int k = 0; k < s->constraint[i].nodes && s->constraint[i].master != SCENE_NONE; k++) {
            mesh_vertex *v = &m->mesh.vertex[s->constraint[i].node[k]];
            const double *from = m->mesh.vertex[s->constraint[i].master].position;
            for (int c = 0; c < 3; c++)
                v->arm[c] = c == s->constraint[i].normal ? 0 : v->position[c] - from[c];
            v->led = vec3_norm(v->arm) > 0;
            v->leader = s->constraint[i].master;
        }
}

static void scene_vertices(model *m)
{
    const scene *s = m->scene;
    for (int i = 0; i < s->nodes; i++) {
        mesh_vertex *v = &m->mesh.vertex[i];
        const scene_node *n = &s->node[i];
        memcpy(v->position, n->position, sizeof v->position);
        v->body = n->attached == SCENE_NONE ? i : n->attached;
        v->leader = NONE;
        for (int k = 0; k < 3; k++) {
            v->offset[k] = n->position[k] - s->node[v->body].position[k];
            v->vector_driver[k] = n->rotation == SCENE_ROTATION_VECTOR ? n->angle[k] : NONE;
        }
        if (n->rotation == SCENE_ROTATION_FORK) {
            double normal[3];
            vec3_cross(n->axis[1], n->axis[0], normal);
            add_axis(normal, v);
            add_axis(n->axis[1], v);
        }
        if (n->rotation == SCENE_ROTATION_SEQUENCE)
            while (v->angles < 3 && vec3_norm(n->axis[v->angles]) > 0)
                add_axis(n->axis[v->angles], v);
        hold_idle(s, i, v);
        v->turned = scene_node_axes(n, v->along) &&
                    !(is_free(n) && s->plane == SCENE_SPACE && !is_tied(m, i));
        stretch_axes(m, i, v);
    }
    lead_vertices(m);
}

static int same_vector(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static status set_inner(const model *m, const element_request *request, mesh_kind *k, fault *f)
{
    int modal = 0;
    for (int i = 0; i < m->scene->analyses; i++)
        modal |= m->scene->analysis[i].kind == SCENE_MODAL ||
                 m->scene->analysis[i].kind == SCENE_HARMONIC;
    if (!modal || m->scene->lumped || m->mesh.nodes != 2 || m->mesh.type->mass_of_field == NULL ||
        !m->mesh.type->mass_of_field(m->options))
        return STATUS_OK;
    k->inner = malloc(FIELD_INNER * FIELD_INNER * sizeof *k->inner);
    if (k->inner == NULL)
        return fault_memory(f, "an element");
    field_inner(request, &k->field, k->inner);
    return STATUS_OK;
}

typedef struct unstressed {
    double strain[3], free[3];
} unstressed;

static status unstressed_of(const model *m, int member, int profile, double length, unstressed *out,
                            fault *f)
{
    const scene_member *sm = &m->scene->member[member];
    const double *k = sm->free_curvature, angle = m->section[profile].axes_angle, c = cos(angle),
                 d = sin(angle);
    memcpy(out->strain, sm->strain, sizeof out->strain);
    out->free[1] = c * k[0] + d * k[1];
    out->free[2] = c * k[1] - d * k[0];
    return scene_member_elongation(m->scene, member, length, &out->free[0], f);
}

static status kind_of(model *m, const unstressed *own, int profile, double length, double rounding,
                      const double curvature[3], int *out, fault *f)
{
    int *end = &m->kind_of_section[profile];
    for (; *end != NONE; end = &m->mesh.kind[*end].next)
        if (fabs(m->mesh.kind[*end].length - length) <= 1e-12 * length + rounding &&
            same_vector(m->mesh.kind[*end].curvature, curvature) &&
            same_vector(m->mesh.kind[*end].strain, own->strain) &&
            same_vector(m->mesh.kind[*end].free, own->free)) {
            *out = *end;
            return STATUS_OK;
        }
    mesh_kind *k = &m->mesh.kind[m->mesh.kinds];
    element_request request = {
        .section = &m->section[profile], .length = length, .options = m->options, .type = m->given};
    memcpy(request.curvature, curvature, sizeof request.curvature);
    memcpy(request.strain, own->strain, sizeof request.strain);
    TRY(features_of_section(m, profile, &request.features, f));
    k->section = profile;
    k->next = NONE;
    k->length = length;
    memcpy(k->curvature, curvature, sizeof k->curvature);
    memcpy(k->strain, own->strain, sizeof k->strain);
    memcpy(k->free, own->free, sizeof k->free);
    k->data_size = m->mesh.type->data_size(&request);
    k->data = calloc(1, k->data_size);
    if (k->data == NULL)
        return fault_memory(f, "an element");
    *out = *end = m->mesh.kinds++;
    field_prepare(&request, m->mesh.nodes, &k->field);
    TRY(set_inner(m, &request, k, f));
    return m->mesh.type->prepare(&request, k->data, f);
}

static status arc_of_element(const model *m, int member, int profile, const member_arc *along,
                             member_arc *out, fault *f)
{
    *out = *along;
    if (!scene_member_tapers(&m->scene->member[member]))
        return STATUS_OK;
    return member_arc_of(imperfect_lines(m), member, m->section[profile].axes_angle, out, f);
}

static mesh_triad *keep_triads(model *m, mesh_triad triad[])
{
    const size_t size = (size_t)m->mesh.nodes * sizeof *triad;
    mesh_triad *next = m->triad + m->triads;
    if (m->triads > 0 && memcmp(next - m->mesh.nodes, triad, size) == 0)
        return next - m->mesh.nodes;
    m->triads += m->mesh.nodes;
    memcpy(next, triad, size);
    return next;
}

/* Returns the arc of an element between two points of the bow of a straight member, including the
 * rotation of the bow between these points. chord, triad: length and triad of the vector between
 * the points. */
static member_arc arc_of_bow(const member_arc *a, const double ends[2], const double start[3],
                             double chord, const double triad[9])
{
    const double size = hypot(a->bow[0], a->bow[1]), wave = a->half_waves * PI / a->length,
                 half = (atan(size * wave * cos(wave * ends[1])) -
                         atan(size * wave * cos(wave * ends[0]))) /
                        2;
    member_arc out = {.length = half != 0 ? chord * half / sin(half) : chord};
    const double axis[3] = {0, -a->bow[1] / size, a->bow[0] / size};
    double back[3], q[4], turned[9];
    for (int i = 0; i < 3; i++) {
        out.start[i] = start[i];
        out.k[i] = 2 * half / out.length * axis[i];
        back[i] = -half * axis[i];
    }
    rotation_exp(back, q);
    rotation_matrix(q, turned);
    mat3_mul(triad, turned, out.R);
    return out;
}

static status add_element(model *m, const member_arc *along, int member, int number,
                          int inner_vertex, fault *f)
{
    mesh_element *el = &m->mesh.element[m->mesh.elements];
    const scene_member *sm = &m->scene->member[member];
    const int profile = profile_at(m, member, number), n = division_elements(&m->division, member),
              each = m->division.each[member];
    double ends[2], at[ELEMENT_MAX_NODES], place[ELEMENT_MAX_NODES];
    const int in_piece = division_piece(&m->division, member, number, ends);
    member_arc here;
    unstressed own;
    TRY(arc_of_element(m, member, profile, along, &here, f));
    TRY(unstressed_of(m, member, profile, here.length, &own, f));
    const member_arc *a = &here;
    const int bowed = a->bow[0] != 0 || a->bow[1] != 0, bends = vec3_norm(a->k) > 0,
              curves = (m->mesh.type->offers & FEATURE_CURVATURE) != 0,
              curved = curves && bends && !bowed && m->imperfect == NULL, last = m->mesh.nodes - 1;
    mesh_triad triad[ELEMENT_MAX_NODES];
    double first[3] = {0};
    el->member = member;
    el->nodes = m->mesh.nodes;
    for (int k = 0; k <= last; k++) {
        const int at_start = number == 0 && k == 0, at_end = number == n - 1 && k == last;
        el->vertex[k] = inner_vertex + number * last + k - 1;
        if (at_start)
            el->vertex[k] = sm->p;
        else if (at_end)
            el->vertex[k] = sm->q;
        mesh_vertex *v = &m->mesh.vertex[el->vertex[k]];
        double position[3], between[3];
        at[k] = a->length * ends[0] +
                a->length * (ends[1] - ends[0]) * (in_piece + m->mesh.place[k]) / each;
        place[k] = ends[0] + (ends[1] - ends[0]) * (in_piece + m->mesh.place[k]) / each;
        member_arc_at(a, at[k], position, triad[k]);
        imperfect_move(m, member, place[k], position, triad[k]);
        if (!at_start && !at_end) {
            v->body = el->vertex[k];
            memcpy(v->position, position, sizeof position);
            for (int i = 0; i < 3; i++)
                v->vector_driver[i] = NONE;
        }
        memcpy(position, v->position, sizeof position);
        if (at_start || at_end)
            scene_end(m->scene, member, at_end, position);
        if (k == 0)
            memcpy(first, position, sizeof first);
        if (k < last || curved)
            continue;
        const double y_start[3] = {triad[0][1], triad[0][4], triad[0][7]};
        double y[3];
        for (int i = 0; i < 3; i++) {
            between[i] = position[i] - first[i];
            y[i] = triad[0][3 * i + 1] + triad[last][3 * i + 1];
        }
        if (rotation_triad(between, y, triad[0]) != 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: the elements bend by too large an angle; use more elements",
                             scene_called(m->scene, SCENE_MEMBERS, member).text);
        for (int i = 1; i <= last && i < ELEMENT_MAX_NODES; i++)
            memcpy(triad[i], triad[0], sizeof triad[0]);
        member_arc arc = {.length = vec3_norm(between)};
        if (bowed || m->imperfect != NULL) {
            const int arcs = curves && !bends && bowed;
            if (arcs)
                arc =
                    arc_of_bow(a, (const double[2]){at[0], at[last]}, first, arc.length, triad[0]);
            else {
                memcpy(arc.start, first, sizeof arc.start);
                memcpy(arc.R, triad[0], sizeof arc.R);
            }
            if (curves && m->imperfect != NULL) {
                if (bends && !bowed)
                    memcpy(arc.k, a->k, sizeof arc.k);
                double turn[3];
                imperfect_turn(m, member, (const double[2]){place[0], place[last]}, turn);
                for (int i = 0; i < 3; i++)
                    for (int j = 0; j < 3; j++)
                        arc.k[i] += triad[0][3 * j + i] * turn[j] / arc.length;
                TRY(member_arc_between(m->scene, member, between, y_start, &arc, f));
            }
            for (int j = 0; j <= last; j++) {
                double inside[3];
                member_arc_at(&arc, arc.length * m->mesh.place[j], inside, triad[j]);
                if (j > 0 && j < last)
                    memcpy(m->mesh.vertex[el->vertex[j]].position, inside, sizeof inside);
            }
        }
        m->mesh.elements++;
        el->triad = keep_triads(m, triad);
        return kind_of(m, &own, profile, arc.length, 4 * DBL_EPSILON * vec3_norm(position), arc.k,
                       &el->kind, f);
    }
    m->mesh.elements++;
    el->triad = keep_triads(m, triad);
    return kind_of(m, &own, profile, a->length * (ends[1] - ends[0]) / each, 0, a->k, &el->kind, f);
}

/* Returns the warping amplitude of the end of a member: an amplitude shared by name, or a separate
 * amplitude; NONE: held at zero. */
static int end_warp(model *m, int name, int *named)
{
    if (name == SCENE_WARP_FIXED)
        return NONE;
    if (name < 0)
        return m->mesh.warps++;
    if (named[name] == NONE)
        named[name] = m->mesh.warps++;
    return named[name];
}

static void add_warps(model *m, int *named)
{
    const int last = m->mesh.nodes - 1;
    for (int member = 0; member < m->scene->members; member++) {
        const scene_member *sm = &m->scene->member[member];
        const int profile = profile_at(m, member, 0);
        unsigned features;
        features_of_section(m, profile, &features, NULL);
        const int warps = (features & FEATURE_WARPING) != 0 && m->scene->plane == SCENE_SPACE,
                  nothing_warps = m->section[profile].Iw <= 0;
        for (int i = m->mesh.first_element[member]; i < m->mesh.first_element[member + 1]; i++)
            for (int k = 0; k <= last; k++) {
                mesh_element *el = &m->mesh.element[i];
                const int at_start = i == m->mesh.first_element[member] && k == 0,
                          at_end = i + 1 == m->mesh.first_element[member + 1] && k == last;
                if (!warps)
                    el->warp[k] = NONE;
                else if (nothing_warps)
                    el->warp[k] = m->mesh.warps++;
                else if (at_start || at_end)
                    el->warp[k] = end_warp(m, at_start ? sm->warp_p : sm->warp_q, named);
                else
                    el->warp[k] = k == 0 ? m->mesh.element[i - 1].warp[last] : m->mesh.warps++;
            }
    }
}

/* Returns the index of the first of new additional unknowns of a node. */
static int new_scalars(model *m, unsigned held)
{
    const int first = m->mesh.warps;
    m->mesh.warps += m->mesh.scalars - __builtin_popcount(held);
    for (int i = first; i < m->mesh.warps; i++)
        m->mesh.warp[i].scalar = 1;
    return first;
}

static int same_axes(const mesh_triad a, const mesh_triad b)
{
    const double rounding = 1e-9;
    double apart = 0;
    for (int i = 0; i < 9; i++)
        apart = fmax(apart, fabs(a[i] - b[i]));
    return apart <= rounding;
}

static void end_scalars(model *m, int element, int k, int warping, int (*named)[2])
{
    mesh_element *el = &m->mesh.element[element];
    const unsigned all = (1U << m->mesh.scalars) - 1;
    if (warping == SCENE_WARP_FIXED)
        el->held[k] = m->mesh.type->held & all;
    if (warping >= 0 && named[warping][0] != NONE) {
        const mesh_element *first = &m->mesh.element[named[warping][0]];
        const int node = named[warping][1];
        if (same_axes(first->triad[node], el->triad[k])) {
            el->scalar[k] = first->scalar[node];
            return;
        }
    }
    el->scalar[k] = new_scalars(m, el->held[k]);
    if (warping >= 0 && named[warping][0] == NONE) {
        named[warping][0] = element;
        named[warping][1] = k;
    }
}

static void add_scalars(model *m, int (*named)[2])
{
    const int last = m->mesh.nodes - 1;
    for (int i = 0; i < m->mesh.elements && m->mesh.scalars > 0; i++) {
        mesh_element *el = &m->mesh.element[i];
        const scene_member *sm = &m->scene->member[el->member];
        const int at_start = i == m->mesh.first_element[el->member],
                  at_end = i + 1 == m->mesh.first_element[el->member + 1];
        el->scalars = m->mesh.scalars;
        for (int k = 0; k <= last; k++) {
            if ((k == 0 && at_start) || (k == last && at_end))
                end_scalars(m, i, k, k == 0 ? sm->warp_p : sm->warp_q, named);
            else
                el->scalar[k] = k == 0 ? m->mesh.element[i - 1].scalar[last] : new_scalars(m, 0);
        }
    }
}

/* Returns the weight of a node near the end of n equal lengths. The rules are Gregory's for n >= 6
 * and the closed Newton-Cotes rules for n < 6. */
static double weight_of(int n, int node)
{
    static const double closed[][3] = {{0.5, 0, 0},
                                       {1 / 3.0, 4 / 3.0, 0},
                                       {3 / 8.0, 9 / 8.0, 0},
                                       {14 / 45.0, 64 / 45.0, 24 / 45.0},
                                       {95 / 288.0, 375 / 288.0, 250 / 288.0},
                                       {3 / 8.0, 7 / 6.0, 23 / 24.0}};
    const int most = sizeof closed / sizeof *closed, from_end = node < n - node ? node : n - node;
    return from_end < 3 ? closed[(n < most ? n : most) - 1][from_end] : 1;
}

/* Sets `share` and `couple` at an end of the element after node i. Together with the masses at the
 * nodes beyond node i, they give the inertia force of all mass beyond node i for a linear
 * acceleration, and its moment for a uniform acceleration. */
static void set_end(mesh_element *el, int end, int n, int i, double beyond, double first)
{
    const double length = n - i;
    el->share[end] = length - beyond;
    el->couple[end] = length * length / 2 - first;
}

static void set_shares(mesh_element *el, int count)
{
    double beyond = 0, first = 0;
    for (int i = count - 1; i >= 0; i--) {
        beyond += weight_of(count, i + 1);
        first += beyond;
        set_end(&el[i], 0, count, i, beyond, first);
        set_end(&el[count - 1 - i], 1, count, i, beyond, first);
    }
}

static int runs_on(const model *m, int first, int next)
{
    const mesh_element *a = &m->mesh.element[first], *b = &m->mesh.element[next];
    if (a->member != b->member)
        return 0;
    const scene_member *sm = &m->scene->member[a->member];
    const int begin = m->mesh.first_element[a->member], each = m->division.each[a->member];
    return a->kind == b->kind ||
           ((sm->bow[0] != 0 || sm->bow[1] != 0 || m->imperfect != NULL) &&
            !scene_member_tapers(sm) && (first - begin) / each == (next - begin) / each);
}

static void share_mass(model *m)
{
    for (int i = 0, next; i < m->mesh.elements; i = next) {
        mesh_element *el = &m->mesh.element[i];
        for (next = i + 1; next < m->mesh.elements && runs_on(m, i, next);)
            next++;
        if (m->mesh.nodes == 2)
            set_shares(el, next - i);
        else
            for (int k = i; k < next; k++)
                memcpy(m->mesh.element[k].share, m->mesh.share, sizeof m->mesh.share);
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

static status allocate(model *m, fault *f)
{
    const scene *s = m->scene;
    const double most = 1e8;
    double total = 0;
    for (int i = 0; i < s->members; i++)
        total += (double)division_pieces(&m->division, i) * m->division.each[i];
    /* bytes per element, including its share of matrices and factors, as measured for straight
     * members */
    const double per_element = 8e3;
    char what[80];
    snprintf(what, sizeof what, "%.0f elements", total);
    TRY(memory_check(total * per_element, what, "give fewer", f));
    if (total > most)
        return fault_set(f, STATUS_REFUSED, "%.0f elements are too many; give at most %.0f", total,
                         most);
    const int ends = release_count(s);
    m->mesh.first_release = s->nodes + (int)total * (m->mesh.nodes - 1) - s->members;
    m->mesh.vertices = m->mesh.first_release + ends;
    m->mesh.release = calloc((size_t)ends + 1, sizeof *m->mesh.release);
    m->mesh.vertex = calloc((size_t)m->mesh.vertices, sizeof *m->mesh.vertex);
    m->mesh.element = calloc((size_t)total, sizeof *m->mesh.element);
    m->triad = malloc((size_t)total * (size_t)m->mesh.nodes * sizeof *m->triad);
    m->mesh.kind = calloc((size_t)total, sizeof *m->mesh.kind);
    m->mesh.warp = calloc((size_t)total * (size_t)m->mesh.nodes * (size_t)(1 + m->mesh.scalars),
                          sizeof *m->mesh.warp);
    m->mesh.first_element = calloc((size_t)s->members + 1, sizeof *m->mesh.first_element);
    if (m->mesh.release == NULL || m->mesh.vertex == NULL || m->mesh.element == NULL ||
        m->triad == NULL || m->mesh.kind == NULL || m->mesh.warp == NULL ||
        m->mesh.first_element == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "%.0f elements require more memory than is available; use fewer", total);
    return STATUS_OK;
}

static status profiles(model *m, fault *f)
{
    int sections;
    TRY(profile_members(m, &sections, f));
    m->kind_of_section = malloc(((size_t)sections + 1) * sizeof *m->kind_of_section);
    if (m->kind_of_section == NULL)
        return fault_memory(f, "the sections of members");
    for (int i = 0; i < sections; i++)
        m->kind_of_section[i] = NONE;
    return STATUS_OK;
}

status mesh_build(model *m, fault *f)
{
    const scene *s = m->scene;
    TRY(allocate(m, f));
    TRY(profiles(m, f));
    scene_vertices(m);
    int inner_vertex = s->nodes;
    for (int member = 0; member < s->members; member++) {
        const int n = division_elements(&m->division, member);
        member_arc a;
        TRY(member_arc_of(imperfect_lines(m), member,
                          m->section[s->member[member].section].axes_angle, &a, f));
        m->mesh.first_element[member] = m->mesh.elements;
        if ((a.bow[0] != 0 || a.bow[1] != 0) && n < 2 * a.half_waves)
            return fault_set(f, STATUS_REFUSED,
                             "%s: the number of elements, %d, is too small for an imperfection "
                             "with half_waves: %d; use at least %d",
                             scene_called(s, SCENE_MEMBERS, member).text, n, a.half_waves,
                             2 * a.half_waves);
        for (int i = 0; i < n; i++)
            TRY(add_element(m, &a, member, i, inner_vertex, f));
        inner_vertex += n * (m->mesh.nodes - 1) - 1;
        m->size = a.length > m->size ? a.length : m->size;
    }
    m->mesh.first_element[s->members] = m->mesh.elements;
    share_mass(m);
    TRY(release_build(m, f));
    const int names = largest_name(s) + 1;
    int *named = malloc((size_t)(names + 1) * sizeof *named),
        (*first)[2] = malloc((size_t)(names + 1) * sizeof *first);
    for (int i = 0; i < names && named != NULL && first != NULL; i++)
        named[i] = first[i][0] = NONE;
    const int good = named != NULL && first != NULL;
    if (good) {
        add_warps(m, named);
        add_scalars(m, first);
    }
    free(named);
    free(first);
    if (!good)
        return fault_memory(f, "warping coordinates");
    return STATUS_OK;
}
