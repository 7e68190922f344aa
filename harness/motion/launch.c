/* What has no inertia must be in balance with the forces at the begin, and what has some is
 * accelerated by them: one equation for both, a stage in which positions give way to accelerations
 * by next to nothing. */
#include "harness/motion/launch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"
#include "harness/scheme/drive.h"
#include "harness/scheme/massless.h"
#include "harness/solver/history.h"

/* Of the square of a step: how far positions give way. */
static const double softness = 1e-12;

static void start_vertex(const model *m, const model_state *s, int index, const scene_start *start,
                         double v[])
{
    const mesh_vertex *frame = &m->vertex[index];
    const int own = index < m->first_release; /* a released end: only the turns of a ball */
    double r[3], R[9], turned[3], body[3];
    frame_rates none;
    kinematics_position(m, s, index, r);
    for (int i = 0; i < 3; i++)
        r[i] -= start->centre[i];
    vec3_cross(start->spin, r, turned);
    forms_rates(m, s, index, v, NULL, &none);
    memcpy(R, none.R, sizeof R);
    mat3_transpose_mul_vec(R, start->spin, body);
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[i], t = frame->coordinate[SCENE_RX + i];
        if (c != NONE && c < m->free && own)
            v[c] = start->velocity[i] + turned[i];
        if (t != NONE && t < m->free && frame->angles == 0 &&
            (own || forms_of(m, index) == FORM_BODY))
            v[t] = body[i];
    }
}

/* What is driven begins where the state has it. */
static status check_drivers(const model *m, const double inc[], fault *f)
{
    const double nothing = 1e-9;
    for (int d = 0; d < m->scene->drivers; d++) {
        const int c = m->driver_coordinate[d];
        if (c >= m->free && fabs(inc[c]) > nothing * (1 + m->size))
            return fault_set(f, STATUS_REFUSED,
                             "driver %s begins %g away from where the state has it: let its value "
                             "at 0 s be that of the state",
                             m->scene->driver[d].name, inc[c]);
    }
    return STATUS_OK;
}

static status settle(stage *s, int massless, double h, instant *now, instant *room, double *inc,
                     double *zero, fault *f)
{
    model *m = s->c->model;
    stage_rates r = {.b = 1 / (softness * h * h),
                     .g = 0,
                     .a0 = zero,
                     .v0 = now->v,
                     .inc = inc,
                     .v = room->v,
                     .a = room->a};
    step_record record = {.path = now->time};
    instant_copy(m, now, room);
    drive_at(m, now->state, now->time, inc, room->v, room->a);
    TRY(check_drivers(m, inc, f));
    TRY(stage_solve(s, now->state, now->time, &r, room->state, &record, f));
    history_drop_step(s->c->result, &record);
    if (massless == 0) /* nothing moves but by what was given way */
        kinematics_state_copy(m, now->state, room->state);
    memcpy(room->algorithm, room->a, (size_t)s->all * sizeof *room->a);
    instant_copy(m, room, now);
    return STATUS_OK;
}

status launch_again(analysis_context *c, const carried *masses, const scene_motion *how,
                    instant *now, instant *room, fault *f)
{
    stage s;
    int massless;
    TRY(massless_count(c->model, masses, now->state, &massless, f));
    TRY(stage_alloc(c, masses, &s, f));
    double *inc = calloc(2 * (size_t)s.all + 2, sizeof *inc);
    drive_at(c->model, now->state, now->time, NULL, now->v, now->a);
    const status outcome = inc != NULL
                               ? settle(&s, massless, how->step, now, room, inc, inc + s.all + 1, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    free(inc);
    stage_free(&s);
    return outcome;
}

status launch(analysis_context *c, const carried *masses, const scene_motion *how, instant *now,
              instant *room, fault *f)
{
    const model *m = c->model;
    for (int i = 0; i < m->vertices; i++)
        if (m->vertex[i].body == i || i >= m->first_release)
            start_vertex(m, now->state, i, &how->start, now->v);
    return launch_again(c, masses, how, now, room, f);
}
