#include "cases/scene/validate_node.h"
#include "cases/scene/names.h"

#include <math.h>

#include "elements/math/dense.h"

/* Does a straight member of the node run along the direction, or a curved one end there?  Also 1
 * when no member ends there. */
static int has_member_along(const scene *s, int node, const double direction[3])
{
    int ends = 0, along = 0;
    for (int i = 0; i < s->members; i++) {
        const scene_member *m = &s->member[i];
        if (m->p < 0 || m->q < 0 || m->p >= s->nodes || m->q >= s->nodes ||
            (m->p != node && m->q != node))
            continue;
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = s->node[m->q].position[k] - s->node[m->p].position[k];
        ends++;
        along |= vec3_norm(m->curvature) > 0 ||
                 fabs(vec3_dot(d, direction)) >= (1 - 1e-9) * vec3_norm(d) * vec3_norm(direction);
    }
    return along || ends == 0;
}

/* The fork decides about all rotations, and its axis is that of a member. */
static status check_fork(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    const double *axis = n->axis[0], *web = n->axis[1], lengths = vec3_norm(axis) * vec3_norm(web);
    for (int k = 0; k < 3; k++)
        if (n->angle[k] != SCENE_FREE)
            return fault_set(f, STATUS_REFUSED,
                             "%s: contradictory supports, a fork and R%c %s; take one away, or "
                             "give a sequence of angles",
                             scene_called(s, SCENE_NODES, i).text, "XYZ"[k],
                             n -> angle[k] == SCENE_HELD ? "held" : "driven");
    if (!(lengths > 0) || !(fabs(vec3_dot(axis, web)) <= 1e-9 * lengths))
        return fault_set(f, STATUS_REFUSED,
                         "%s: axis and web of its fork are not at right angles; give two that are",
                         scene_called(s, SCENE_NODES, i).text);
    if (!has_member_along(s, i, axis))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: no member there runs along the axis of its fork; give the member's direction",
            scene_called(s, SCENE_NODES, i).text);
    return STATUS_OK;
}

/* A body that exists: its inertia has no negative principal moment, and none above the sum of the
 * other two. */
static int is_inertia(const double I[6])
{
    const double half = (I[0] + I[1] + I[2]) / 2;
    /* of int x x^T dm = (trace/2) 1 - I all leading and other principal minors */
    const double A[3] = {half - I[0], half - I[1], half - I[2]}, xy = -I[3], yz = -I[4], zx = -I[5],
                 small = 1e-9 * half;
    const double determinant =
        A[0] * (A[1] * A[2] - yz * yz) - xy * (xy * A[2] - yz * zx) + zx * (xy * yz - A[1] * zx);
    return A[0] >= -small && A[1] >= -small && A[2] >= -small &&
           A[0] * A[1] - xy * xy >= -small * half && A[1] * A[2] - yz * yz >= -small * half &&
           A[2] * A[0] - zx * zx >= -small * half && determinant >= -small * half * half;
}

/* Is the end of a member or a spring at the body of this node? */
static int is_at(const scene *s, int end, int body)
{
    return end >= 0 && end < s->nodes && (end == body || s->node[end].attached == body);
}

/* Does a member or a spring hold the node's body? */
static int is_reached(const scene *s, int node)
{
    const int body = s->node[node].attached == SCENE_NONE ? node : s->node[node].attached;
    for (int i = 0; i < s->members; i++)
        if (is_at(s, s->member[i].p, body) || is_at(s, s->member[i].q, body))
            return 1;
    for (int i = 0; i < s->springs; i++)
        if (is_at(s, s->spring[i].p, body) || is_at(s, s->spring[i].q, body))
            return 1;
    return 0;
}

static status check_body(const scene *s, int i, fault *f)
{
    const scene_node *n = &s->node[i];
    const double *I = n->body.inertia, *c = n->body.centre;
    if (n->body.mass == 0 && vec3_norm(c) > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: a centre without a mass; give the mass, or leave the centre out",
                         scene_called(s, SCENE_NODES, i).text);
    if (!is_inertia(I))
        return fault_set(f, STATUS_REFUSED,
                         "%s: no body has this inertia, a principal moment is above the sum of the "
                         "other two; correct it",
                         scene_called(s, SCENE_NODES, i).text);
    if (!is_reached(s, i))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: nothing holds its mass; join a member or a spring to it, or take it away",
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
                             "%s: moved by a driver that does not exist; add the driver first",
                             scene_called(s, SCENE_NODES, i).text);
        if (n->rotation == SCENE_ROTATION_VECTOR && n->angle[k] < 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: a prescribed rotation vector needs three drivers; drive all "
                             "three of its components",
                             scene_called(s, SCENE_NODES, i).text);
    }
    if (n->rotation == SCENE_ROTATION_FORK) {
        TRY(check_fork(s, i, f));
    }
    if (scene_has_body(n) || vec3_norm(n->body.centre) > 0) {
        TRY(check_body(s, i, f));
    }
    if (n->attached == SCENE_NONE)
        return STATUS_OK;
    if (n->attached == i || s->node[n->attached].attached != SCENE_NONE)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: attached to %s, which is no body; attach it to a node that is attached to nothing",
            scene_called(s, SCENE_NODES, i).text, scene_called(s, SCENE_NODES, n->attached).text);
    for (int k = 0; k < 3; k++)
        if (n->translation[k] != SCENE_FREE || n->angle[k] != SCENE_FREE)
            return fault_set(f, STATUS_REFUSED,
                             "%s: contradictory supports, it moves with %s; hold that one instead",
                             scene_called(s, SCENE_NODES, i).text,
                             scene_called(s, SCENE_NODES, n->attached).text);
    return STATUS_OK;
}
