#include "cases/scene/validate_release.h"
#include "cases/scene/names.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

static const char *const name_of_end[] = {"from", "to"};

static status check_end(const scene *s, const scene_release *r, int member, int end, int times[6],
                        fault *f)
{
    if (r->count < 0 || r->count > SCENE_RELEASED)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: its end '%s' passes nothing on; of its six components release %d at most",
            scene_called(s, SCENE_MEMBERS, member).text, name_of_end[end], SCENE_RELEASED);
    for (int k = 0; k < r->count; k++) {
        const int c = r->component[k];
        if (c < SCENE_UX || c > SCENE_RZ || times[c]++ > 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: its end '%s' releases %s; give components of ux to rz once each",
                             scene_called(s, SCENE_MEMBERS, member).text, name_of_end[end],
                             c < SCENE_UX || c > SCENE_RZ ? "what is none" : "one twice");
    }
    return STATUS_OK;
}

status scene_validate_release(const scene *s, int member, fault *f)
{
    static const char *const name[] = {"ux", "uy", "uz", "rx"};
    const scene_release *r = s->member[member].release;
    int times[2][6] = {{0}};
    for (int end = 0; end < 2; end++) {
        TRY(check_end(s, &r[end], member, end, times[end], f));
    }
    for (int c = SCENE_UX; c <= SCENE_RX; c++)
        if (times[0][c] && times[1][c])
            return fault_set(
                f, STATUS_REFUSED,
                "%s: both ends release %s, so nothing keeps it from %s; release it at one",
                scene_called(s, SCENE_MEMBERS, member).text, name[c],
                c == SCENE_RX ? "turning about its axis" : "shifting");
    return STATUS_OK;
}

/* P += 1 - the projection on the span of `count` axes: what is kept from turning. */
static void add_kept(int count, double (*axis)[3], double P[9])
{
    double basis[3][3];
    int rank = 0;
    for (int k = 0; k < count; k++) {
        double *b = basis[rank];
        memcpy(b, axis[k], 3 * sizeof *b);
        for (int pass = 0; pass < 2 * rank; pass++) {
            const double part = vec3_dot(basis[pass % rank], b);
            for (int i = 0; i < 3; i++)
                b[i] -= part * basis[pass % rank][i];
        }
        const double size = vec3_norm(b), whole = vec3_norm(axis[k]);
        for (int i = 0; i < 3; i++)
            b[i] /= size > 0 ? size : 1;
        rank += size > 1e-9 * whole;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            P[3 * i + j] += i == j;
            for (int k = 0; k < rank; k++)
                P[3 * i + j] -= basis[k][i] * basis[k][j];
        }
}

/* What the node's supports leave free. */
static void add_supports(const scene_node *n, double P[9])
{
    double axis[3][3] = {{0}};
    int count = 0;
    if (n->rotation == SCENE_ROTATION_FORK) {
        vec3_cross(n->axis[1], n->axis[0], axis[0]);
        memcpy(axis[1], n->axis[1], sizeof axis[1]);
        count = 2;
    }
    for (int k = 0; k < 3 && n->rotation != SCENE_ROTATION_FORK; k++) {
        const int sequence = n->rotation == SCENE_ROTATION_SEQUENCE;
        if (n->angle[k] != SCENE_FREE || (sequence && !(vec3_norm(n->axis[k]) > 0)))
            continue;
        axis[count][k] = 1;
        if (sequence)
            memcpy(axis[count], n->axis[k], sizeof axis[count]);
        count++;
    }
    add_kept(count, axis, P);
}

/* Turns that the end of a straight member releases; of a curved one, whose axes are known later,
 * none. */
static void add_end(const scene_member *m, const scene *s, int end, double P[9])
{
    const scene_release *r = &m->release[end];
    double axis[3][3], along[3], R[9];
    int count = 0;
    for (int i = 0; i < 3; i++)
        along[i] = s->node[m->q].position[i] - s->node[m->p].position[i];
    rotation_triad(along, m->y_axis, R);
    for (int k = 0; k < r->count && vec3_norm(m->curvature) == 0; k++) {
        if (r->component[k] < SCENE_RX)
            continue;
        for (int i = 0; i < 3; i++)
            axis[count][i] = R[3 * i + r->component[k] - SCENE_RX];
        count++;
    }
    add_kept(count, axis, P);
}

static void add_springs(const scene *s, int node, double P[9])
{
    for (int k = 0; k < s->springs; k++)
        for (int i = 0; i < 3 && (s->spring[k].p == node || s->spring[k].q == node); i++)
            P[4 * i] += s->spring[k].stiffness[7 * (3 + i)] > 0;
}

/* An axis that P keeps from nothing; 0: it has none. */
static int loose_axis(const double P[9], double axis[3])
{
    double A[9], largest = 0;
    memcpy(A, P, sizeof A);
    for (int i = 0; i < 3; i++)
        A[4 * i] -= 1e-12;
    if (dense_cholesky(3, A) == 0)
        return 0;
    memset(axis, 0, 3 * sizeof *axis);
    for (int i = 0; i < 3; i++) {
        double cross[3];
        vec3_cross(&P[3 * i], &P[3 * ((i + 1) % 3)], cross);
        const double size = vec3_norm(cross);
        for (int k = 0; k < 3 && size > largest && size > 1e-9; k++)
            axis[k] = cross[k] / size;
        largest = fmax(largest, size);
    }
    return 1;
}

/* Does a body reach further than the node, so that places hold its turn too? */
static int is_wide(const scene *s, int node)
{
    int wide = s->node[node].attached != SCENE_NONE;
    for (int i = 0; i < s->nodes; i++)
        wide |= s->node[i].attached == node;
    return wide;
}

static int ends_at(const scene_member *m, int end, int node)
{
    return (end ? m->q : m->p) == node;
}

static int releases_at(const scene *s, int node)
{
    int count = 0;
    for (int i = 0; i < s->members; i++)
        for (int end = 0; end < 2; end++)
            count += ends_at(&s->member[i], end, node) && s->member[i].release[end].count > 0;
    return count;
}

/* What is loose at a node; axis: of one. */
typedef enum loose { LOOSE_NOTHING, LOOSE_AXIS, LOOSE_PLANE, LOOSE_ALL } loose;

static loose loose_at(const scene *s, int node, double axis[3])
{
    double P[9] = {0}, largest = 0;
    if (releases_at(s, node) == 0 || is_wide(s, node))
        return LOOSE_NOTHING;
    for (int i = 0; i < s->members; i++)
        for (int end = 0; end < 2; end++)
            if (ends_at(&s->member[i], end, node))
                add_end(&s->member[i], s, end, P);
    add_supports(&s->node[node], P);
    add_springs(s, node, P);
    if (!loose_axis(P, axis))
        return LOOSE_NOTHING;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(P[i]));
    return vec3_norm(axis) > 0 ? LOOSE_AXIS : largest > 1e-9 ? LOOSE_PLANE : LOOSE_ALL;
}

/* Does something act on the turns of a node, or go by how it is turned? */
static int turn_matters(const scene *s, int node)
{
    const scene_body *b = &s->node[node].body;
    int matters = vec3_norm(b->centre) > 0;
    for (int k = 0; k < 6; k++)
        matters |= b->inertia[k] != 0;
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (!scene_load_along(load) && load->where == node)
            matters |= load->kind == SCENE_MOMENT || load->follower || vec3_norm(load->at) > 0;
    }
    for (int i = 0; i < s->springs; i++) {
        const scene_spring *spring = &s->spring[i];
        matters |= spring->p == node; /* with which its axes turn */
        for (int k = 0; k < 36 && spring->q == node; k++)
            matters |= (k / 6 >= SCENE_RX || k % 6 >= SCENE_RX) && spring->stiffness[k] != 0;
    }
    return matters;
}

/* Which angles of the node are free, in bits. */
static int free_angles(const scene_node *n)
{
    int bits = 0;
    for (int k = 0; k < 3; k++)
        bits |= (n->angle[k] == SCENE_FREE) << k;
    return bits;
}

int scene_idle_turn(const scene *s, int node, double axis[3])
{
    const scene_node *n = &s->node[node];
    const loose what = n->rotation == SCENE_ROTATION_SPATIAL && free_angles(n) != 0
                           ? loose_at(s, node, axis)
                           : LOOSE_NOTHING;
    if (what == LOOSE_NOTHING || what == LOOSE_PLANE || turn_matters(s, node))
        return 0;
    if (what == LOOSE_ALL)
        return free_angles(n) == 7 ? SCENE_IDLE_ALL : 0;
    for (int k = 0; k < 3; k++) /* a node of a plane frame: the others are held */
        if (free_angles(n) == 1 << k)
            return SCENE_IDLE_AXIS;
    return free_angles(n) == 7 ? SCENE_IDLE_AXIS : 0;
}

status scene_validate_turns(const scene *s, int node, fault *f)
{
    double axis[3];
    const loose what = loose_at(s, node, axis);
    if (what == LOOSE_NOTHING || scene_idle_turn(s, node, axis) != 0)
        return STATUS_OK;
    return vec3_norm(axis) > 0
               ? fault_set(f, STATUS_REFUSED,
                           "%s: all members there release its turn about (%.3g, %.3g, %.3g), so it "
                           "turns by itself; join one of them, or hold it against that",
                           scene_called(s, SCENE_NODES, node).text, axis[0], axis[1], axis[2])
               : fault_set(f, STATUS_REFUSED,
                           "%s: all members there release its turns, so it turns by itself; join "
                           "one of them, or hold its rotations",
                           scene_called(s, SCENE_NODES, node).text);
}
