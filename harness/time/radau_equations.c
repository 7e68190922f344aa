/* The equations of three stages at once. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/inertia.h"
#include "harness/time/kinks.h"
#include "harness/time/radau_impl.h"
#include "harness/time/released.h"

/* Blocks (i, k) of one frame, k = 0 .. */
static void add_frame(radau *r, int index, double h, int i)
{
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame;
    const int *at = model_vertex(m, vertex)->coordinate;
    inertia_parts p;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    for (int k = 0; k < STAGES; k++) {
        radau_relation of;
        double E[9], K[36], more[36];
        radau_relate(r, vertex, h, i, k, &of);
        mat3_mul(p.rate, of.turn_acceleration, E);
        inertia_times(p.acceleration, of.acceleration, E, K);
        mat3_mul(p.rate, of.turn_rate, E);
        inertia_times(p.velocity, of.rate, E, more);
        for (int x = 0; x < 36; x++)
            K[x] += more[x];
        if (i == k) {
            inertia_times(p.place, 1, p.turn, more);
            for (int x = 0; x < 36; x++)
                K[x] += more[x];
        }
        inertia_rows(p.turn, K);
        for (int row = 0; row < 6; row++)
            for (int column = 0; column < 6; column++)
                stages_add(&r->S, i, k, at[row], at[column], K[6 * row + column]);
    }
}

/* The same of a released end. */
static void add_released(radau *r, int index, double h, int i)
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const model *m = r->of.c->model;
    const int vertex = r->of.masses->mass[index].frame, body = model_vertex(m, vertex)->body;
    inertia_parts p;
    released_masses of;
    inertia_frame(m, r->of.masses, index, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    released_columns(m, r->stage[i].state, vertex, &of);
    for (int k = 0; k < STAGES; k++) {
        radau_relation of_body, of_end;
        double at_body[9], at_end[9], motion[6 * KINEMATICS_MOST],
            K[KINEMATICS_MOST * KINEMATICS_MOST] = {0};
        radau_relate(r, body, h, i, k, &of_body);
        radau_relate(r, vertex, h, i, k, &of_end);
        radau_in_space(r, body, i, of_body.turn_acceleration, at_body);
        radau_in_space(r, vertex, i, of_end.turn_acceleration, at_end);
        released_motion(&of, of_body.acceleration, at_body, at_end, motion);
        released_project(&of, p.acceleration, motion, K);
        radau_in_space(r, body, i, of_body.turn_rate, at_body);
        radau_in_space(r, vertex, i, of_end.turn_rate, at_end);
        released_motion(&of, of_body.rate, at_body, at_end, motion);
        released_project(&of, p.velocity, motion, K);
        if (i == k) {
            released_motion(&of, 1, one, one, motion);
            released_project(&of, p.place, motion, K);
        }
        for (int row = 0; row < of.count; row++)
            for (int column = 0; column < of.count; column++)
                stages_add(&r->S, i, k, of.index[row], of.index[column],
                           K[of.count * row + column]);
    }
}

static void add_warps(radau *r, double h)
{
    const model *m = r->of.c->model;
    double B2[STAGES * STAGES];
    dense_mul(STAGES, STAGES, STAGES, r->B, r->B, B2);
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        for (int x = 0; x < STAGES * STAGES; x++)
            if (r->of.masses->warping[c] > 0)
                stages_add(&r->S, x / STAGES, x % STAGES, c, c,
                           r->of.masses->warping[c] * B2[x] / (h * h));
    }
}

status radau_equations(radau *r, int fresh, const instant *from, double h, step_record *record,
                       fault *f)
{
    const model *m = r->of.c->model;
    if (fresh)
        stages_zero(&r->S);
    record->incompatibility = 0;
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        model_linearisation lin = {.path = kinks_before(m, radau_time(r, from, h, i, record)),
                                   .K = fresh ? &r->K : NULL,
                                   .residual = r->dx};
        if (r->of.c->options->newton == NEWTON_DISPLACEMENT)
            TRY(linearise_make_compatible(&r->of.c->eq, one->state, f));
        TRY(linearise_state(&r->of.c->eq, &one->memory, one->state, &lin, f));
        inertia_subtract(m, r->of.masses, one->state, one->v, one->a, r->dx);
        r->of.c->run->counters.inertia_evaluations +=
            r->of.masses->spread ? model_elements(m) * (1 + fresh) : 0;
        memcpy(r->residual + (size_t)i * (size_t)r->free, r->dx,
               (size_t)r->free * sizeof *r->residual);
        if (fresh)
            stages_put(&r->S, i, &r->K);
        record->incompatibility = fmax(record->incompatibility, lin.incompatibility);
    }
    radau_damp(r, fresh, from, h);
    if (!fresh)
        return STATUS_OK;
    for (int i = 0; i < STAGES; i++)
        for (int k = 0; k < r->of.masses->masses; k++)
            if (r->of.masses->mass[k].frame < model_first_release(r->of.c->model))
                add_frame(r, k, h, i);
            else
                add_released(r, k, h, i);
    add_warps(r, h);
    if (r->of.masses->spread)
        radau_spread(r, h);
    return STATUS_OK;
}
