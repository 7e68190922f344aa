#include "cases/scene/scene_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* Returns 1 if a straight member at the node is parallel to the direction. Also returns 1 if a
 * curved member or no member ends there. */
static int has_member_along(const scene *s, int node, const double direction[3])
{
    int ends = 0, along = 0;
    for (int i = 0; i < s->members; i++) {
        const scene_member *m = &s->member[i];
        if (m->p < 0 || m->q < 0 || m->p >= s->nodes || m->q >= s->nodes ||
            (m->p != node && m->q != node))
            continue;
        double d[3];
        scene_chord(s, i, d);
        ends++;
        along |= vec3_norm(m->curvature) > 0 ||
                 fabs(vec3_dot(d, direction)) >= (1 - 1e-9) * vec3_norm(d) * vec3_norm(direction);
    }
    return along || ends == 0;
}

static status check_fork(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    const double *axis = n->axis[0], *web = n->axis[1], lengths = vec3_norm(axis) * vec3_norm(web);
    for (int k = 0; k < 3; k++)
        if (n->angle[k] != SCENE_FREE)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: its fork determines all rotations, but r%c is also %s; remove one "
                "of them, or give 'rotation' with a sequence",
                scene_called(s, SCENE_NODES, i).text, "xyz"[k],
                n -> angle[k] == SCENE_HELD ? "fixed" : "driven");
    if (!(lengths > 0) || !(fabs(vec3_dot(axis, web)) <= 1e-9 * lengths))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the axis and the web of the fork are zero or not perpendicular; give two "
            "perpendicular directions",
            scene_called(s, SCENE_NODES, i).text);
    if (!has_member_along(s, i, axis))
        return fault_set(f, STATUS_REFUSED,
                         "%s: no member at this node runs along the axis of its fork; give the "
                         "member's direction",
                         scene_called(s, SCENE_NODES, i).text);
    return STATUS_OK;
}

/* Returns 1 if the inertia tensor is valid, which requires that no principal moment is negative or
 * exceeds the sum of the other two. */
static int is_inertia(const double I[6])
{
    const double half = (I[0] + I[1] + I[2]) / 2;
    const double A[3] = {half - I[0], half - I[1], half - I[2]}, xy = -I[3], yz = -I[4], zx = -I[5],
                 small = 1e-9 * half;
    const double determinant =
        A[0] * (A[1] * A[2] - yz * yz) - xy * (xy * A[2] - yz * zx) + zx * (xy * yz - A[1] * zx);
    return A[0] >= -small && A[1] >= -small && A[2] >= -small &&
           A[0] * A[1] - xy * xy >= -small * half && A[1] * A[2] - yz * yz >= -small * half &&
           A[2] * A[0] - zx * zx >= -small * half && determinant >= -small * half * half;
}

static status check_body(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    const double *I = n->body.inertia, *c = n->body.centre;
    if (n->body.mass == 0 && vec3_norm(c) > 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a centre is given without a mass; give the mass, or remove the centre",
            scene_called(s, SCENE_NODES, i).text);
    if (!is_inertia(I))
        return fault_set(f, STATUS_REFUSED,
                         "%s: no body has this inertia, because a principal moment exceeds the sum "
                         "of the other two; correct the inertia",
                         scene_called(s, SCENE_NODES, i).text);
    if (!scene_is_joined(s, i) && !scene_is_constrained(s, i, ~0u))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the body is not connected; join a member or a spring to the node, or "
                         "remove its mass and inertia",
                         scene_called(s, SCENE_NODES, i).text);
    return STATUS_OK;
}

status scene_validate_node(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    for (int k = 0; k < 3; k++) {
        if (n->translation[k] < SCENE_HELD || n->translation[k] >= s->drivers ||
            n->angle[k] < SCENE_HELD || n->angle[k] >= s->drivers)
            return fault_set(f, STATUS_REFUSED,
                             "%s: its motion does not exist; add the motion first",
                             scene_called(s, SCENE_NODES, i).text);
        if (n->rotation == SCENE_ROTATION_VECTOR && n->angle[k] < 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: a prescribed rotation vector requires three motions; drive all "
                             "three components",
                             scene_called(s, SCENE_NODES, i).text);
    }
    const double lengths = vec3_norm(n->axes[0]) * vec3_norm(n->axes[1]);
    if (vec3_norm(n->axes[0]) > 0 &&
        !(lengths > 0 && fabs(vec3_dot(n->axes[0], n->axes[1])) <= 1e-9 * lengths))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the axes of its supports are zero or not perpendicular; give two "
                         "perpendicular axes",
                         scene_called(s, SCENE_NODES, i).text);
    if (n->rotation == SCENE_ROTATION_FORK) {
        TRY(check_fork(s, i, f));
    }
    if (scene_has_body(n) || vec3_norm(n->body.centre) > 0) {
        TRY(check_body(s, i, f));
    }
    if (n->attached == SCENE_NONE)
        return STATUS_OK;
    if (n->attached == i)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the node is attached to itself; name another node in 'part_of'",
                         scene_called(s, SCENE_NODES, i).text);
    if (s->node[n->attached].attached != SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the node is attached to %s, which is itself attached to another "
                         "node; name the last node in this chain",
                         scene_called(s, SCENE_NODES, i).text,
                         scene_called(s, SCENE_NODES, n->attached).text);
    for (int k = 0; k < 3; k++)
        if (n->translation[k] != SCENE_FREE || n->angle[k] != SCENE_FREE)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: its supports prevent it from moving with %s; fix that node instead",
                scene_called(s, SCENE_NODES, i).text,
                scene_called(s, SCENE_NODES, n->attached).text);
    return STATUS_OK;
}

/* Relative deviation up to which directions and positions are treated as in the plane. */
static const double within = 1e-9;

static int is_across(const scene *s, const double v[3])
{
    return fabs(v[scene_normal(s)]) > within * vec3_norm(v);
}

/* Returns 1 if the vector is not zero and not along the normal. */
static int is_beside(const scene *s, const double v[3])
{
    double in[3] = {v[0], v[1], v[2]};
    in[scene_normal(s)] = 0;
    return vec3_norm(in) > within * vec3_norm(v);
}

static status refuse(const scene *s, scene_words owner_name, const char *what, fault *f)
{
    return fault_set(
        f, STATUS_REFUSED,
        "%s: %s, but the scene is confined to its plane; correct this, or remove plane: %s",
        owner_name.text, what, scene_plane_name(s));
}

static double size_of(const scene *s)
{
    double size = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++)
            size = fmax(size, fabs(s->node[i].position[k] - s->node[0].position[k]));
    return size;
}

/* Returns 1 if the position is outside the plane of the nodes. */
static int is_out(const scene *s, const double place[3])
{
    const int n = scene_normal(s);
    return fabs(place[n] - s->node[0].position[n]) > within * size_of(s);
}

static void axis_of(const scene_node *n, int k, double axis[3])
{
    memset(axis, 0, 3 * sizeof *axis);
    if (n->rotation == SCENE_ROTATION_SEQUENCE)
        memcpy(axis, n->axis[k], 3 * sizeof *axis);
    else
        axis[k] = 1;
}

static status check_turns(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    for (int k = 0; k < 3 && n->rotation != SCENE_ROTATION_FORK; k++) {
        double axis[3];
        axis_of(n, k, axis);
        if (n->angle[k] >= 0 && is_beside(s, axis))
            return refuse(s, scene_called(s, SCENE_NODES, i),
                          "a rotation out of the plane is prescribed", f);
        if (n->angle[k] == SCENE_FREE && is_beside(s, axis) && is_across(s, axis))
            return refuse(s, scene_called(s, SCENE_NODES, i),
                          "it rotates about an axis that is neither in the plane nor normal to it",
                          f);
    }
    if (n->rotation == SCENE_ROTATION_FORK && is_across(s, n->axis[0]))
        return refuse(s, scene_called(s, SCENE_NODES, i), "the axis of its fork leaves the plane",
                      f);
    if (n->rotation == SCENE_ROTATION_FORK && is_across(s, n->axis[1]) && is_beside(s, n->axis[1]))
        return refuse(s, scene_called(s, SCENE_NODES, i),
                      "the web of its fork is neither in the plane nor normal to it", f);
    return STATUS_OK;
}

static status check_node(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    const scene_words owner_name = scene_called(s, SCENE_NODES, i);
    if (is_out(s, n->position))
        return refuse(s, owner_name, "its position is outside the plane through the first node", f);
    double R[9];
    int along = scene_normal(s);
    scene_node_axes(n, R);
    for (int k = 0; k < 3; k++) {
        const double axis[3] = {R[k], R[3 + k], R[6 + k]};
        if (is_across(s, axis) && is_beside(s, axis))
            return refuse(s, owner_name,
                          "an axis of its supports is neither in the plane nor normal to it", f);
        along = is_across(s, axis) ? k : along;
    }
    if (n->translation[along] >= 0)
        return refuse(s, owner_name, "a displacement out of the plane is prescribed", f);
    if (scene_has_body(n) && is_across(s, n->body.centre))
        return refuse(s, owner_name, "the centre of its body is outside the plane", f);
    return check_turns(s, i, f);
}

/* Computes the axes at the start of a member, with x along the chord. For a member in the plane, y
 * or z is normal to the plane. */
static void axes_of(const scene *s, int member, double R[9])
{
    const scene_member *m = &s->member[member];
    double along[3];
    scene_chord(s, member, along);
    rotation_triad(along, m->y_axis, R);
}

static void to_fixed(const double R[9], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = vec3_dot(&R[3 * i], v);
}

static status check_release(const scene *s, int i, const double R[9], fault *f)
{
    for (int end = 0; end < 2; end++) {
        const scene_release *r = &s->member[i].release[end];
        for (int k = 0; k < r->count; k++) {
            const int c = r->component[k] % 3;
            const double axis[3] = {R[c], R[3 + c], R[6 + c]};
            if (is_across(s, axis) && is_beside(s, axis))
                return refuse(s, scene_called(s, SCENE_MEMBERS, i),
                              "it is released along or about an axis that is neither in the plane "
                              "nor normal to it",
                              f);
        }
    }
    return STATUS_OK;
}

static status check_member(const scene *s, int i, fault *f)
{
    const scene_member *m = &s->member[i];
    const scene_words owner_name = scene_called(s, SCENE_MEMBERS, i);
    const double own[3] = {0, m->free_curvature[0], m->free_curvature[1]};
    double R[9], curvature[3], strain[3], bow[3], bent[3];
    axes_of(s, i, R);
    to_fixed(R, (const double[3]){0, m->bow[0], m->bow[1]}, bow);
    to_fixed(R, m->curvature, curvature);
    to_fixed(R, m->strain, strain);
    to_fixed(R, own, bent);
    if (is_beside(s, curvature))
        return refuse(s, owner_name, "its initial curvature leaves the plane", f);
    if (is_across(s, bow))
        return refuse(s, owner_name, "its imperfection leaves the plane", f);
    if (is_beside(s, bent))
        return refuse(s, owner_name, "its free curvature leaves the plane", f);
    if (is_across(s, strain))
        return refuse(s, owner_name, "its initial strain leaves the plane", f);
    if (is_across(s, m->offset[0]) || is_across(s, m->offset[1]))
        return refuse(s, owner_name, "an offset of its ends leaves the plane", f);
    return check_release(s, i, R, f);
}

static status check_load(const scene *s, int i, fault *f)
{
    const scene_load *l = &s->load[i];
    const scene_words owner_name = scene_called(s, SCENE_LOADS, i);
    const int turns = scene_load_turns(l);
    double R[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, v[2][3], at[3];
    if (l->kind == SCENE_TEMPERATURE) {
        const double bends[3] = {0, l->gradient[1], -l->gradient[0]};
        axes_of(s, l->where, R);
        to_fixed(R, bends, at);
        return is_beside(s, at) ? refuse(s, owner_name, "its gradient bends out of the plane", f)
                                : STATUS_OK;
    }
    if (l->axes == SCENE_AXES_MEMBER && scene_load_along(l))
        axes_of(s, l->where, R);
    to_fixed(R, l->vector, v[0]);
    to_fixed(R, l->last, v[1]);
    to_fixed(R, l->at, at);
    for (int k = 0; k < 2; k++)
        if (turns ? is_beside(s, v[k]) : is_across(s, v[k]))
            return refuse(s, owner_name,
                          turns ? "its moment is not about the normal of the plane"
                                : "it acts out of the plane",
                          f);
    return is_across(s, at) ? refuse(s, owner_name, "it acts outside the plane", f) : STATUS_OK;
}

static status check_frame(const scene *s, int i, fault *f)
{
    const scene_rotating_frame *r = scene_rotating_frame_of(&s->analysis[i]);
    if (r == NULL || !(vec3_norm(r->omega) > 0))
        return STATUS_OK;
    const int along = !is_beside(s, r->omega);
    if (!along && (is_across(s, r->omega) || is_out(s, r->centre)))
        return refuse(s, scene_called(s, SCENE_ANALYSES, i),
                      "it rotates about an axis that is neither in the plane nor normal to it", f);
    return STATUS_OK;
}

static status check_analysis(const scene *s, int i, fault *f)
{
    const scene_analysis *a = &s->analysis[i];
    const scene_words owner_name = scene_called(s, SCENE_ANALYSES, i);
    if (a->kind == SCENE_CONTINUATION &&
        scene_continuation_of(a)->control.component == scene_normal(s))
        return refuse(s, owner_name, "the controlled component leaves the plane", f);
    if (a->kind == SCENE_MOTION) {
        const scene_start *start = &scene_motion_of(a)->start;
        if (is_across(s, start->velocity) || is_beside(s, start->spin))
            return refuse(s, owner_name, "it starts with a velocity out of the plane", f);
    }
    return check_frame(s, i, f);
}

static int leaves(const scene *s, int component)
{
    return component < SCENE_RX ? component == scene_normal(s)
                                : component - SCENE_RX != scene_normal(s);
}

static status check_driver(const scene *s, int i, fault *f)
{
    const scene_driver *d = &s->driver[i];
    if (d->value == NULL && d->condition_driver != SCENE_NONE && leaves(s, d->condition_component))
        return refuse(s, scene_called(s, SCENE_DRIVERS, i),
                      "its value is determined by a component out of the plane", f);
    return STATUS_OK;
}

static status check_quantity(const scene *s, int i, fault *f)
{
    const scene_quantity *q = &s->quantity[i];
    const int entry =
        q->what.kind == SCENE_COMPLIANCE_ENTRY || q->what.kind == SCENE_STIFFNESS_ENTRY;
    if (entry && (leaves(s, scene_entry_of(q)->row) || leaves(s, scene_entry_of(q)->column)))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s refers to a component out of the plane, but the scene is "
                         "confined to its plane; remove the quantity, or remove plane: %s",
                         q->name, scene_plane_name(s));
    return STATUS_OK;
}

status scene_validate_plane(const scene *s, fault *f)
{
    static status (*const check[])(const scene *, int, fault *) = {
        check_node, check_member, check_load, check_driver, check_analysis, check_quantity};
    const int count[] = {s->nodes, s->members, s->loads, s->drivers, s->analyses, s->quantities};
    if (s->plane == SCENE_SPACE)
        return STATUS_OK;
    for (size_t k = 0; k < sizeof count / sizeof count[0]; k++)
        for (int i = 0; i < count[k]; i++)
            TRY(check[k](s, i, f));
    return STATUS_OK;
}
