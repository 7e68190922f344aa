/* The step to begin with, and what it is as increments of coordinates. */
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/conserving_impl.h"
#include "harness/time/drive.h"
#include "harness/time/increment.h"

static int turns_freely(const model *m, int vertex)
{
    return model_vertex(m, vertex)->body == vertex && model_vertex(m, vertex)->angles == 0;
}

static void vector_of(const double of[], const int at[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = at[k] != NONE ? of[at[k]] : 0;
}

static void put_vector(const double v[3], const int at[3], double of[])
{
    for (int k = 0; k < 3; k++)
        if (at[k] != NONE)
            of[at[k]] = v[k];
}

void conserving_increment(const conserving *s, const model_state *from, double inc[])
{
    const model *m = s->of.c->model;
    double c[3], t[3], body[3];
    memcpy(inc, s->step, (size_t)s->all * sizeof *inc);
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        frame_rates r;
        if (!turns_freely(m, i))
            continue;
        vector_of(s->step, at, c);
        cayley_to_vector(c, t);
        forms_rates(m, from, i, inc, NULL, &r);
        mat3_transpose_mul_vec(r.R, t, body);
        put_vector(body, at, inc);
    }
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9];
        if (release_of(m, i)->turns < 3)
            continue;
        vector_of(s->step, at, c);
        cayley_to_vector(c, t);
        rotation_matrix(&from->q[4 * i], R);
        mat3_transpose_mul_vec(R, t, body);
        put_vector(body, at, inc);
    }
}

/* c = h w, or of a driven turn what that is. */
static void predict_turn(conserving *s, const frame_rates *r, const int at[3], double h,
                         double c[3])
{
    double t[3], spatial[3], driven[3];
    for (int k = 0; k < 3; k++)
        t[k] = at[k] != NONE && at[k] >= s->free ? s->dx[at[k]] : 0;
    mat3_mul_vec(r->R, t, spatial);
    cayley_of_vector(spatial, driven);
    for (int k = 0; k < 3; k++)
        c[k] = at[k] == NONE ? 0 : at[k] < s->free ? h * r->w[k] : driven[k];
    put_vector(c, at, s->step);
}

/* dr = h/2 (v + cay(c) v): the velocity turns with its node. cay(c) v - v = (c x v + c x (c x
 * v)/2)/(1 + c.c/4). */
void conserving_predict(conserving *s, const instant *from, double h)
{
    const model *m = s->of.c->model;
    for (int c = 0; c < s->free; c++)
        s->step[c] = h * from->v[c];
    drive_at(&s->of.c->eq, from->state, from->time + h, s->step, NULL, NULL);
    memcpy(s->dx, s->step, (size_t)s->all * sizeof *s->dx); /* drivers may move several nodes */
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9], own[3], c[3];
        if (release_of(m, i)->turns < 3)
            continue;
        rotation_matrix(&from->state->q[4 * i], R);
        vector_of(s->step, at, own);
        mat3_mul_vec(R, own, c);
        put_vector(c, at, s->step);
    }
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate;
        frame_rates r;
        double c[3], crossed[3], twice[3];
        if (!turns_freely(m, i))
            continue;
        forms_rates(m, from->state, i, from->v, NULL, &r);
        predict_turn(s, &r, at + SCENE_RX, h, c);
        vec3_cross(c, r.v, crossed);
        vec3_cross(c, crossed, twice);
        for (int k = 0; k < 3; k++)
            if (at[k] != NONE && at[k] < s->free)
                s->step[at[k]] =
                    h * (r.v[k] + (crossed[k] + twice[k] / 2) / (1 + vec3_dot(c, c) / 4) / 2);
    }
}
