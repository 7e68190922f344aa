#include "cases/scene/warping.h"

#include <math.h>
#include <stdlib.h>

#include "elements/math/vec3.h"

/* Directions that differ by less are one: round-off of positions. */
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

/* Of a straight member, unit vectors: along it, and of its y axis; 0: of another one. */
static int frame_of(const scene *s, const scene_member *m, double x[3], double y[3])
{
    if (m->p < 0 || m->p >= s->nodes || m->q < 0 || m->q >= s->nodes)
        return 0;
    const double *p = s->node[m->p].position, *q = s->node[m->q].position;
    for (int k = 0; k < 3; k++) {
        if (m->curvature[k] != 0)
            return 0;
        x[k] = q[k] - p[k];
    }
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

/* 1: one direction, -1: opposite ones, 0: others. */
static int sense_of(const double a[3], const double b[3])
{
    double same = 0, opposite = 0;
    for (int k = 0; k < 3; k++) {
        same = fmax(same, fabs(a[k] - b[k]));
        opposite = fmax(opposite, fabs(a[k] + b[k]));
    }
    return same <= round_off ? 1 : opposite <= round_off ? -1 : 0;
}

/* Is there a wall where the mirrored ends of wall i are? */
static int has_image(const section_spec *spec, const double centroid[2], const int sign[2], int i,
                     double size)
{
    for (int k = 0; k < spec->walls; k++)
        for (int turned = 0; turned < 2; turned++) {
            const int ours[2] = {spec->wall[i].from, spec->wall[i].to},
                      theirs[2] = {turned ? spec->wall[k].to : spec->wall[k].from,
                                   turned ? spec->wall[k].from : spec->wall[k].to};
            double off = fabs(spec->wall[i].thickness - spec->wall[k].thickness);
            for (int e = 0; e < 2; e++)
                for (int a = 0; a < 2; a++)
                    off = fmax(off, fabs(sign[a] * (spec->point[ours[e]][a] - centroid[a]) -
                                         (spec->point[theirs[e]][a] - centroid[a])));
            if (off <= round_off * size)
                return 1;
        }
    return 0;
}

/* Is the section where it was when the signs of its y and z are these? */
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
    int member, end; /* 0 at p, 1 at q */
} member_end;

static int *warp_of(scene *s, member_end e)
{
    return e.end == 0 ? &s->member[e.member].warp_p : &s->member[e.member].warp_q;
}

/* Is the second member what the first one is, drawn on across their node? */
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
    /* the third axis follows from two */
    const int sign[2] = {across, along * across};
    return along == (first.end != second.end ? 1 : -1) && across != 0 && profile[0] == profile[1] &&
           is_symmetric(s, profile[0], sign);
}

/* Of each node: how many ends are at it, the sum of their numbers, and whether it is part of a
 * body, or of one that members or springs reach at other nodes too. */
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
