#include "harness/time/increment.h"

#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/turning.h"

static void three(const mesh_vertex *v, const double of[], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = of[v->coordinate[SCENE_RX + i]];
}

/* Spatial vector of a frame's turn: R_n inc. */
static void apply_vertex(const model *m, const model_state *from, int index, const double inc[],
                         model_state *to)
{
    const mesh_vertex *v = model_vertex(m, index);
    double d[6], q[4];
    for (int c = 0; c < 6; c++)
        d[c] = v->coordinate[c] == NONE ? 0 : inc[v->coordinate[c]];
    for (int c = 0; c < 3; c++) {
        to->u[3 * index + c] = from->u[3 * index + c] + d[c];
        to->angle[3 * index + c] = from->angle[3 * index + c] + d[3 + c];
    }
    if (v->angles > 0)
        return;
    rotation_exp(d + 3, q);
    rotation_compose(&from->q[4 * index], q, &to->q[4 * index]);
    rotation_normalise(&to->q[4 * index]);
}

/* R_n exp(inc), as of frames. */
static void turn_ball(const model *m, const model_state *from, int index, const double inc[],
                      model_state *to)
{
    double t[3], q[4];
    three(model_vertex(m, index), inc, t);
    rotation_exp(t, q);
    rotation_compose(&from->q[4 * index], q, &to->q[4 * index]);
    rotation_normalise(&to->q[4 * index]);
}

void increment_apply(const model *m, const model_state *from, const double inc[], double time,
                     model_state *to)
{
    for (int i = 0; i < model_first_release(m); i++)
        if (model_vertex(m, i)->body == i)
            apply_vertex(m, from, i, inc, to);
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int r = i - model_first_release(m);
        memcpy(&to->q[4 * i], &from->q[4 * i], 4 * sizeof *to->q);
        memcpy(&to->angle[3 * i], &from->angle[3 * i], 3 * sizeof *to->angle);
        memcpy(&to->shift[3 * r], &from->shift[3 * r], 3 * sizeof *to->shift);
        release_advance(m, to, i, inc);
        if (release_of(m, i)->turns == 3)
            turn_ball(m, from, i, inc, to);
    }
    for (int i = 0; i < model_warps(m); i++)
        to->warp[i] = from->warp[i] + inc[model_warp(m, i)];
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) != NONE)
            to->driver[d] = from->driver[d] + inc[model_driver_coordinate(m, d)];
    memcpy(to->turn, from->turn, 3 * (size_t)model_turns(m) * sizeof *to->turn);
    kinematics_follow(m, to);
    to->path = time;
}

/* Turn of a frame, whose rates are in its own axes. */
static void add_turn(const model_state *now, int index, const mesh_vertex *v, const double dx[],
                     double inc[])
{
    double R[9], spatial[3], moved[3], at[3];
    three(v, dx, spatial);
    three(v, inc, at);
    rotation_matrix(&now->q[4 * index], R);
    mat3_transpose_mul_vec(R, spatial, moved);
    turning_add(at, moved);
    for (int k = 0; k < 3; k++)
        inc[v->coordinate[SCENE_RX + k]] = at[k];
}

static void add_plainly(const model *m, const mesh_vertex *v, int first, int end, const double dx[],
                        double inc[])
{
    for (int c = first; c < end; c++)
        if (v->coordinate[c] != NONE && v->coordinate[c] < model_unknowns(m))
            inc[v->coordinate[c]] += dx[v->coordinate[c]];
}

void increment_add(const model *m, const model_state *now, const double dx[], double inc[])
{
    for (int i = 0; i < model_vertices(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        const mesh_release *r = release_of(m, i);
        if (r == NULL && v->body != i)
            continue;
        add_plainly(m, v, SCENE_UX, SCENE_RX, dx, inc);
        if (forms_of(m, i) == FORM_BODY && v->coordinate[SCENE_RX] < model_unknowns(m))
            add_turn(now, i, v, dx, inc);
        else
            add_plainly(m, v, SCENE_RX, SCENE_RZ + 1, dx, inc);
    }
    for (int i = 0; i < model_warps(m); i++)
        inc[model_warp(m, i)] += dx[model_warp(m, i)];
}
