#include "harness/model/turns.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/names.h"
#include "elements/math/dense.h"
#include "elements/math/pi.h"
#include "elements/math/rotation.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"

const char turns_lost[] =
    "on a full turn about a changing axis its rotation vector loses its direction; use smaller "
    "steps, or read orientation";

static int reads_turn(const scene_quantity *q)
{
    return q->what.kind == SCENE_RELATIVE && scene_relative_of(q)->component >= SCENE_RX;
}

static int first_between(const model *m)
{
    return m->scene->nodes + m->scene->springs;
}

static int find_between(const model *m, int from, int node)
{
    for (int i = first_between(m); i < m->mesh.turns; i++)
        if (m->turn[i].from == from && m->turn[i].node == node)
            return i;
    return NONE;
}

status turns_build(model *m, fault *f)
{
    const scene *s = m->scene;
    m->turn = malloc(((size_t)first_between(m) + (size_t)s->quantities + 1) * sizeof *m->turn);
    if (m->turn == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for turns");
    m->mesh.turns = 0;
    for (int i = 0; i < s->nodes; i++)
        m->turn[m->mesh.turns++] = (mesh_turn){NONE, i};
    for (int i = 0; i < s->springs; i++)
        m->turn[m->mesh.turns++] =
            (mesh_turn){s->spring[i].p == SCENE_NONE ? NONE : s->spring[i].p, s->spring[i].q};
    for (int i = 0; i < s->quantities; i++) {
        if (!reads_turn(&s->quantity[i]))
            continue;
        const scene_relative *r = scene_relative_of(&s->quantity[i]);
        if (find_between(m, r->from, r->node) == NONE)
            m->turn[m->mesh.turns++] = (mesh_turn){r->from, r->node};
    }
    return STATUS_OK;
}

/* Beside a full turn the little that is more, or is missing, has a direction of round-off where it
 * is along what there was. */
static int keeps_direction(const double more[3], const double before[3], double length)
{
    const double near = 1e-3, round_off = 1e-8;
    double aside[3];
    vec3_cross(before, more, aside);
    return vec3_norm(more) < near && vec3_norm(aside) < round_off * length;
}

void turns_continue(const double q[4], const double before[3], double out[3])
{
    const double sine = vec3_norm(q + 1), length = vec3_norm(before);
    double along[3] = {0};
    rotation_log(q, out);
    if (q[0] > 0 && length < PI / 2)
        return; /* less than half a turn, and no other is as near */
    if (length > PI && keeps_direction(out, before, length)) {
        const int odd = q[0] < 0;
        const double turns = 2 * round((length / (2 * PI) - odd) / 2) + odd;
        for (int i = 0; i < 3; i++)
            out[i] += 2 * PI * turns * before[i] / length;
        return;
    }
    if (sine == 0)
        return;
    const double angle = 2 * atan2(sine, q[0]);
    for (int i = 0; i < 3; i++)
        along[i] = q[i + 1] / sine;
    const double turns = 2 * round((vec3_dot(before, along) - angle) / (4 * PI)) + (q[0] < 0);
    if (turns != 0)
        for (int i = 0; i < 3; i++)
            out[i] += 2 * PI * turns * along[i];
}

static void between_frames(const model_state *s, const mesh_turn *t, double q[4])
{
    double back[4];
    if (t->from == NONE) {
        memcpy(q, &s->q[4 * t->node], 4 * sizeof *q);
        return;
    }
    rotation_conjugate(&s->q[4 * t->from], back);
    rotation_compose(back, &s->q[4 * t->node], q);
}

/* Of a node whose turn is that of one driven or held angle: that, however far it goes at once. */
static int by_angle(const model *m, const model_state *s, int node, double out[3])
{
    const mesh_vertex *v = &m->mesh.vertex[node];
    int turned = NONE;
    for (int k = 0; k < v->angles; k++)
        if (s->angle[3 * node + k] != 0) {
            if (turned != NONE)
                return 0;
            turned = k;
        }
    if (turned == NONE)
        return 0;
    for (int i = 0; i < 3; i++)
        out[i] = v->axis[turned][i] * s->angle[3 * node + turned];
    return 1;
}

void turns_follow(const model *m, model_state *s)
{
    const int nodes = m->scene->nodes;
    for (int i = 0; i < m->mesh.turns; i++) {
        double q[4], *turn = &s->turn[3 * i];
        const double before[3] = {turn[0], turn[1], turn[2]};
        if (i < nodes && (m->mesh.vertex[i].body != i || by_angle(m, s, i, turn)))
            continue;
        between_frames(s, &m->turn[i], q);
        turns_continue(q, before, turn);
    }
    for (int i = 0; i < nodes; i++)
        if (m->mesh.vertex[i].body != i)
            memcpy(&s->turn[3 * i], &s->turn[3 * m->mesh.vertex[i].body], 3 * sizeof *s->turn);
}

const double *turns_of_node(const model_state *s, int node)
{
    return &s->turn[3 * node];
}

const double *turns_of_spring(const model *m, const model_state *s, int spring)
{
    return &s->turn[3 * (m->scene->nodes + spring)];
}

const double *turns_between(const model *m, const model_state *s, int from, int node)
{
    const int i = find_between(m, from, node);
    return i == NONE ? NULL : &s->turn[3 * i];
}

int turns_between_count(const model *m)
{
    return m->mesh.turns - first_between(m);
}

void turns_put_between(const model *m, const model_state *s, double out[])
{
    for (int i = first_between(m); i < m->mesh.turns; i++, out += 5) {
        out[0] = m->turn[i].from;
        out[1] = m->turn[i].node;
        memcpy(out + 2, &s->turn[3 * i], 3 * sizeof *out);
    }
}

/* As if both had turned about one axis. */
static void begin_between(const model *m, model_state *s, int i)
{
    const mesh_turn *t = &m->turn[i];
    double q[4], before[3];
    for (int k = 0; k < 3; k++)
        before[k] = s->turn[3 * t->node + k] - s->turn[3 * t->from + k];
    between_frames(s, t, q);
    turns_continue(q, before, &s->turn[3 * i]);
}

void turns_take_between(const model *m, int count, const double in[], model_state *s)
{
    for (int i = first_between(m); i < m->mesh.turns; i++)
        begin_between(m, s, i);
    for (int k = 0; k < count; k++, in += 5) {
        const int i = find_between(m, (int)in[0], (int)in[1]);
        if (i != NONE)
            memcpy(&s->turn[3 * i], in + 2, 3 * sizeof *in);
    }
}

int turns_full(double size, double near)
{
    return size > PI && fabs(remainder(size, 2 * PI)) < near;
}

int turns_swung(const double from[3], const double to[3])
{
    const double a = vec3_norm(from), b = vec3_norm(to);
    const double most = turns_full(b, 1e-6) ? 0.9999 : 0.5; /* cosine */
    return !(fmax(a, b) < PI || fmin(a, b) < 1 || vec3_dot(from, to) > most * a * b);
}

void turns_lose(const model *m, const model_state *from, model_state *s)
{
    for (int i = 0; i < m->mesh.turns; i++)
        if (turns_swung(&from->turn[3 * i], &s->turn[3 * i]))
            for (int k = 0; k < 3; k++)
                s->turn[3 * i + k] = NAN;
}
