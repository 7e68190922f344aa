#include "cases/scene/scene_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

static const char *const name_of_end[] = {"from", "to"};

static status check_end(const scene *s, const scene_release *r, int member, int end, int times[6],
                        fault *f)
{
    if (r->count < 0 || r->count > SCENE_RELEASED)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the end '%s' transmits nothing; release at most %d of the six components",
            scene_called(s, SCENE_MEMBERS, member).text, name_of_end[end], SCENE_RELEASED);
    for (int k = 0; k < r->count; k++) {
        const int c = r->component[k];
        if (c < SCENE_UX || c > SCENE_RZ || times[c]++ > 0)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: the end '%s' releases %s; name components from ux to rz, each only once",
                scene_called(s, SCENE_MEMBERS, member).text, name_of_end[end],
                c < SCENE_UX || c > SCENE_RZ ? "an unknown component" : "one twice");
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
                "%s: both ends release %s, so the member can %s; release %s at one end only",
                scene_called(s, SCENE_MEMBERS, member).text, name[c],
                c == SCENE_RX ? "rotate freely about its axis" : "move freely", name[c]);
    return STATUS_OK;
}

/* Adds to P the projection on the complement of the span of `count` axes. The range of P contains
 * the rotations that are resisted. */
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

/* Adds to P the rotations that the supports of the node resist. */
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

/* Adds to P the rotations that the end of a straight member does not release. A curved member,
 * whose axes are not yet known, is treated as if it resisted all rotations. */
static void add_end(const scene_member *m, const scene *s, int end, double P[9])
{
    const scene_release *r = &m->release[end];
    double axis[3][3], along[3], R[9];
    int count = 0;
    scene_chord(s, (int)(m - s->member), along);
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
            P[4 * i] += s->spring[k].stiffness[7 * (3 + i)] > 0 ||
                        s->spring[k].table[3 + i].at.stations > 0;
}

/* Finds an axis about which P resists no rotation; the axis is zero if there is more than one.
 * Returns 0 if no axis exists. */
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

/* Returns 1 if the node belongs to a body with other nodes or with offset member ends, where forces
 * can also resist its rotation. */
static int is_wide(const scene *s, int node)
{
    int wide = s->node[node].attached != SCENE_NONE;
    for (int i = 0; i < s->nodes; i++)
        wide |= s->node[i].attached == node;
    for (int i = 0; i < 2 * s->members; i++)
        wide |= (i % 2 ? s->member[i / 2].q : s->member[i / 2].p) == node &&
                scene_is_beside(&s->member[i / 2], i % 2);
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

static int is_measured(const scene *s, int node, const double axis[3])
{
    int measured = 0;
    for (int i = 0; i < s->loads; i++) {
        const scene_feedback *by = &s->load[i].feedback;
        if (by->node != SCENE_NONE && by->component >= SCENE_RX &&
            (by->node == node || by->from == node))
            measured |= vec3_norm(axis) == 0 || fabs(axis[by->component - SCENE_RX]) > 1e-9;
    }
    return measured;
}

/* Returns 1 if a load acts on the rotations of a node, or if a result depends on them. */
static int turn_matters(const scene *s, int node)
{
    const scene_body *b = &s->node[node].body;
    int matters = vec3_norm(b->centre) > 0 || scene_is_constrained(s, node, SCENE_TURNS);
    for (int k = 0; k < 6; k++)
        matters |= b->inertia[k] != 0;
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (!scene_load_along(load) && load->where == node)
            matters |= load->kind == SCENE_MOMENT || load->follower || vec3_norm(load->at) > 0;
    }
    for (int i = 0; i < s->springs; i++) {
        const scene_spring *spring = &s->spring[i];
        matters |= spring->p == node;
        for (int k = 3; k < 6; k++)
            matters |= spring->q == node && spring->table[k].at.stations > 0;
        for (int k = 0; k < 36 && spring->q == node; k++)
            matters |= (k / 6 >= SCENE_RX || k % 6 >= SCENE_RX) &&
                       (spring->stiffness[k] != 0 || spring->damping[k] != 0);
    }
    return matters;
}

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
    const int single = n->rotation == SCENE_ROTATION_SEQUENCE && vec3_norm(n->axis[1]) == 0;
    const loose what = (n->rotation == SCENE_ROTATION_SPATIAL || single) && free_angles(n) != 0
                           ? loose_at(s, node, axis)
                           : LOOSE_NOTHING;
    if (what == LOOSE_NOTHING || what == LOOSE_PLANE || turn_matters(s, node) ||
        is_measured(s, node, axis))
        return 0;
    if (single)
        return what == LOOSE_AXIS && n->angle[0] == SCENE_FREE ? SCENE_IDLE_AXIS : 0;
    if (what == LOOSE_ALL)
        return free_angles(n) == 7 ? SCENE_IDLE_ALL : 0;
    for (int k = 0; k < 3; k++)
        if (free_angles(n) == 1 << k)
            return SCENE_IDLE_AXIS;
    return free_angles(n) == 7 ? SCENE_IDLE_AXIS : 0;
}

status scene_validate_turns(const scene *s, int node, fault *f)
{
    double axis[3];
    const loose what = loose_at(s, node, axis);
    if (what == LOOSE_NOTHING || scene_is_constrained(s, node, SCENE_TURNS) ||
        scene_idle_turn(s, node, axis) != 0)
        return STATUS_OK;
    return vec3_norm(axis) > 0
               ? fault_set(f, STATUS_REFUSED,
                           "%s: all members at this node release its rotation about "
                           "(%.3g, %.3g, %.3g), so the node can rotate freely; remove one "
                           "release, or fix this rotation",
                           scene_called(s, SCENE_NODES, node).text, axis[0], axis[1], axis[2])
               : fault_set(f, STATUS_REFUSED,
                           "%s: all members at this node release its rotations, so the node "
                           "can rotate freely; remove one release, or fix its rotations",
                           scene_called(s, SCENE_NODES, node).text);
}

/* Largest difference of directions that are treated as equal. */
static const double round_off = 1e-9;

static int is_held(const scene_node *n)
{
    for (int k = 0; k < 3; k++)
        if (n->translation[k] == SCENE_FREE)
            return 0;
    for (int k = 0; k < 3; k++) {
        const int is_there = n->rotation != SCENE_ROTATION_SEQUENCE || vec3_norm(n->axis[k]) > 0;
        if (is_there && n->angle[k] == SCENE_FREE)
            return 0;
    }
    return n->rotation != SCENE_ROTATION_FORK;
}

static int releases_turn(const scene_release *r)
{
    for (int i = 0; i < r->count && i < SCENE_RELEASED; i++)
        if (r->component[i] >= SCENE_RX)
            return 1;
    return 0;
}

/* Computes the unit vectors of a straight member along its axis and its y axis. Returns 0 for a
 * curved member. */
static int frame_of(const scene *s, const scene_member *m, double x[3], double y[3])
{
    if (m->p < 0 || m->p >= s->nodes || m->q < 0 || m->q >= s->nodes)
        return 0;
    if (vec3_norm(m->curvature) > 0)
        return 0;
    scene_chord(s, (int)(m - s->member), x);
    const double length = vec3_norm(x);
    if (!(length > 0))
        return 0;
    const double along = vec3_dot(x, m->y_axis) / (length * length);
    for (int k = 0; k < 3; k++)
        y[k] = m->y_axis[k] - along * x[k];
    const double across = vec3_norm(y);
    if (!(across > 0))
        return 0;
    for (int k = 0; k < 3; k++) {
        x[k] /= length;
        y[k] /= across;
    }
    return 1;
}

/* Returns 1 if the directions are equal, -1 if they are opposite, otherwise 0. */
static int sense_of(const double a[3], const double b[3])
{
    double same = 0, opposite = 0;
    for (int k = 0; k < 3; k++) {
        same = fmax(same, fabs(a[k] - b[k]));
        opposite = fmax(opposite, fabs(a[k] + b[k]));
    }
    return same <= round_off ? 1 : opposite <= round_off ? -1 : 0;
}

/* Returns 1 if there is an equal wall at the mirror image of wall i. */
static int has_image(const section_spec *spec, const double centroid[2], const int sign[2], int i,
                     double size)
{
    for (int k = 0; k < spec->walls; k++)
        for (int turned = 0; turned < 2; turned++) {
            const int ours[2] = {spec->wall[i].from, spec->wall[i].to},
                      end_point[2] = {turned ? spec->wall[k].to : spec->wall[k].from,
                                      turned ? spec->wall[k].from : spec->wall[k].to};
            double off = fabs(spec->wall[i].thickness - spec->wall[k].thickness);
            for (int e = 0; e < 2; e++)
                for (int a = 0; a < 2; a++)
                    off = fmax(off, fabs(sign[a] * (spec->point[ours[e]][a] - centroid[a]) -
                                         (spec->point[end_point[e]][a] - centroid[a])));
            if (off <= round_off * size)
                return 1;
        }
    return 0;
}

/* Returns 1 if the section is known not to change when its y and z axes are multiplied by these
 * signs. For signs other than 1, this is known only for rectangles and for sections with walls. */
static int is_symmetric(const scene *s, int profile, const int sign[2])
{
    section c;
    if (profile < 0 || profile >= s->sections)
        return 0;
    const section_spec *spec = &s->section[profile];
    if ((sign[0] == 1 && sign[1] == 1) || spec->kind == SECTION_RECTANGLE)
        return 1;
    if (spec->kind != SECTION_WALLS || scene_constants(s, profile, &c, NULL) != STATUS_OK)
        return 0;
    double size = 0;
    for (int i = 0; i < spec->points; i++)
        size = fmax(size, fmax(fabs(spec->point[i][0] - c.centroid[0]),
                               fabs(spec->point[i][1] - c.centroid[1])));
    for (int i = 0; i < spec->walls; i++)
        if (!has_image(spec, c.centroid, sign, i, size))
            return 0;
    return 1;
}

typedef struct member_end {
    int member, end;
} member_end;

static int *warp_of(scene *s, member_end e)
{
    return e.end == 0 ? &s->member[e.member].warp_p : &s->member[e.member].warp_q;
}

static int runs_on(const scene *s, member_end first, member_end second)
{
    const member_end both[2] = {first, second};
    double x[2][3], y[2][3];
    int profile[2];
    for (int k = 0; k < 2; k++) {
        const scene_member *m = &s->member[both[k].member];
        profile[k] = both[k].end == 0 ? m->section : m->section_q;
        if (m->release[both[k].end].count > 0 || !frame_of(s, m, x[k], y[k]))
            return 0;
    }
    const int along = sense_of(x[0], x[1]), across = sense_of(y[0], y[1]);
    const int sign[2] = {across, along * across};
    return along == (first.end != second.end ? 1 : -1) && across != 0 && profile[0] == profile[1] &&
           is_symmetric(s, profile[0], sign);
}

typedef struct warping_place {
    int ends, tied;
    long sum;
} warping_place;

static int number_of(member_end e)
{
    return 2 * e.member + e.end;
}

static void tie(const scene *s, warping_place *all, int node)
{
    const int body = node >= 0 && node < s->nodes ? s->node[node].attached : SCENE_NONE;
    if (body < 0 || body >= s->nodes)
        return;
    all[node].tied = 1;
    all[body].tied = 1;
}

static void find_places(const scene *s, warping_place *all)
{
    for (int i = 0; i < 2 * s->members; i++) {
        const int node = i % 2 == 0 ? s->member[i / 2].p : s->member[i / 2].q;
        if (node < 0 || node >= s->nodes)
            continue;
        all[node].ends++;
        all[node].sum += i;
        all[node].tied |= scene_is_beside(&s->member[i / 2], i % 2);
        tie(s, all, node);
    }
    for (int i = 0; i < s->springs; i++) {
        tie(s, all, s->spring[i].p);
        tie(s, all, s->spring[i].q);
    }
}

static int unused_name(const scene *s)
{
    int name = 0;
    for (int i = 0; i < 2 * s->members; i++) {
        const int used = i % 2 == 0 ? s->member[i / 2].warp_p : s->member[i / 2].warp_q;
        name = used >= name ? used + 1 : name;
    }
    return name;
}

static void resolve(scene *s, const warping_place *all)
{
    int name = unused_name(s);
    for (int i = 0; i < 2 * s->members; i++) {
        const member_end one = {i / 2, i % 2};
        const scene_member *m = &s->member[one.member];
        const int node = one.end == 0 ? m->p : m->q;
        if (*warp_of(s, one) != SCENE_WARP_BY_SUPPORT)
            continue;
        *warp_of(s, one) = SCENE_WARP_FREE;
        if (node < 0 || node >= s->nodes || releases_turn(&m->release[one.end]))
            continue;
        if (is_held(&s->node[node]) || all[node].tied)
            *warp_of(s, one) = SCENE_WARP_FIXED;
        if (is_held(&s->node[node]) || all[node].tied || all[node].ends != 2)
            continue;
        const int number = (int)(all[node].sum - number_of(one));
        const member_end other = {number / 2, number % 2};
        if (*warp_of(s, other) == SCENE_WARP_BY_SUPPORT && runs_on(s, one, other))
            *warp_of(s, one) = *warp_of(s, other) = name++;
    }
}

void scene_warping_by_supports(scene *s)
{
    warping_place *all = calloc((size_t)s->nodes + 1, sizeof *all);
    if (all == NULL) {
        s->out_of_memory = 1;
        return;
    }
    find_places(s, all);
    resolve(s, all);
    free(all);
}
