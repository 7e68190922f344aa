/* Accelerations are those of a stage in which positions give way by next to nothing; where
 * something has no inertia see settle.h. */
#include "harness/time/launch.h"
#include "cases/scene/names.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/damping.h"
#include "harness/time/drive.h"
#include "harness/time/massless.h"
#include "harness/time/settle.h"

/* Of the square of a step: how far positions give way. */
static const double softness = 1e-12;

/* Rates of a sequence's angles of which the spin is the sum; held and driven ones stay. */
static void start_angles(const model *m, const model_state *s, int index, const double spin[3],
                         double v[])
{
    const mesh_vertex *frame = model_vertex(m, index);
    double b[3][3], A[9] = {0}, rest[3], right[3] = {0};
    int of[3], pivot[3], n = 0;
    kinematics_axes(m, s, index, b);
    memcpy(rest, spin, sizeof rest);
    for (int k = 0; k < frame->angles; k++) {
        const int c = frame->coordinate[SCENE_RX + k];
        if (c != NONE && c < model_unknowns(m))
            of[n++] = k;
        for (int i = 0; i < 3 && c >= model_unknowns(m); i++)
            rest[i] -= b[k][i] * v[c];
    }
    for (int i = 0; i < n; i++) {
        right[i] = vec3_dot(b[of[i]], rest);
        for (int j = 0; j < n; j++)
            A[n * i + j] = vec3_dot(b[of[i]], b[of[j]]);
    }
    if (n == 0 || dense_lu_regular(n, A, pivot) != 0)
        return; /* two angles about one axis: both stay */
    dense_lu_solve(n, 1, A, pivot, right);
    for (int i = 0; i < n; i++)
        v[frame->coordinate[SCENE_RX + of[i]]] = right[i];
}

/* Of a field: velocity [m/s] at the place of a vertex. */
static void velocity_of(const model *m, const model_state *s, int index, const scene_start *field,
                        double out[3])
{
    double r[3];
    kinematics_position(m, s, index, r);
    for (int i = 0; i < 3; i++)
        r[i] -= field->centre[i];
    vec3_cross(field->spin, r, out);
    for (int i = 0; i < 3; i++)
        out[i] += field->velocity[i];
}

static void start_vertex(const model *m, const model_state *s, int index, const scene_start *field,
                         double v[])
{
    const mesh_vertex *frame = model_vertex(m, index);
    const int own = index < model_first_release(m); /* a released end: only the turns of a ball */
    double R[9], velocity[3], body[3];
    velocity_of(m, s, index, field, velocity);
    rotation_matrix(&s->q[4 * index], R);
    mat3_transpose_mul_vec(R, field->spin, body);
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[i], t = frame->coordinate[SCENE_RX + i];
        if (c != NONE && c < model_unknowns(m) && own)
            v[c] = velocity[i];
        if (t != NONE && t < model_unknowns(m) && frame->angles == 0 &&
            (own || forms_of(m, index) == FORM_BODY))
            v[t] = body[i];
    }
    if (frame->angles > 0 && vec3_norm(field->spin) > 0)
        start_angles(m, s, index, field->spin, v);
}

/* What is held and driven lets the field be. */
static status check_field(const model *m, const model_state *s, const scene_start *field,
                          const double v[], fault *f)
{
    const double nothing = 1e-6, spin = vec3_norm(field->spin);
    for (int i = 0; i < model_first_release(m); i++) {
        frame_rates r;
        double velocity[3];
        if (model_vertex(m, i)->body != i)
            continue;
        velocity_of(m, s, i, field, velocity);
        forms_rates(m, s, i, v, NULL, &r);
        for (int k = 0; k < 3; k++)
            if (fabs(r.v[k] - velocity[k]) > nothing * spin * model_length(m) ||
                fabs(r.w[k] - field->spin[k]) > nothing * spin)
                return fault_set(
                    f, STATUS_REFUSED,
                    "%s is held or driven otherwise than the axes turn that the motion starts "
                    "from: drive it so that it turns with them from 0 s on",
                    scene_called(model_scene(m), SCENE_NODES, i).text);
    }
    return STATUS_OK;
}

/* What is driven begins where the state has it. */
static status check_drivers(const model *m, const double inc[], fault *f)
{
    const double nothing = 1e-9;
    for (int d = 0; d < model_scene(m)->drivers; d++) {
        const int c = model_driver_coordinate(m, d);
        if (c >= model_unknowns(m) && fabs(inc[c]) > nothing * (1 + model_length(m)))
            return fault_set(f, STATUS_REFUSED,
                             "driver %s begins %g away from where the state has it: let its value "
                             "at 0 s be that of the state",
                             model_scene(m)->driver[d].name, inc[c]);
    }
    return STATUS_OK;
}

static status accelerate(motion_stage *s, double h, instant *now, instant *room, double *inc,
                         double *zero, fault *f)
{
    const model *m = s->c->model;
    stage_rates r = {.b = 1 / (softness * h * h),
                     .g = 0,
                     .a0 = zero,
                     .v0 = now->v,
                     .inc = inc,
                     .v = room->v,
                     .a = room->a};
    step_record record = {.path = now->time};
    instant_copy(m, now, room);
    instant_recall(now, &s->arrival);
    TRY(stage_solve(s, now->state, now->time, &r, room->state, &record, f));
    history_drop_step(s->c->result, &record);
    kinematics_state_copy(m, now->state, room->state);
    memcpy(room->algorithm, room->a, (size_t)s->all * sizeof *room->a);
    instant_remember(&s->arrival, room);
    instant_copy(m, room, now);
    return STATUS_OK;
}

static status begin(motion_stage *s, const scene_motion *how, instant *now, instant *room,
                    double *inc, double *zero, fault *f)
{
    const model *m = s->c->model;
    int massless;
    TRY(damping_now(&s->c->eq, now, f));
    drive_at(&s->c->eq, now->state, now->time, inc, now->v, now->a);
    TRY(check_drivers(m, inc, f));
    TRY(massless_count(m, s->masses, now->state, &massless, f));
    if (massless == 0)
        return accelerate(s, how->step, now, room, inc, zero, f);
    TRY(settle(s, zero, how->step, now, f));
    if (!s->masses->spread) /* else what has inertia accelerates together */
        return STATUS_OK;
    TRY(accelerate(s, how->step, now, room, inc, zero, f));
    TRY(massless_drop(m, s->masses, now->state, now->a, f));
    memcpy(now->algorithm, now->a, (size_t)s->all * sizeof *now->a);
    return STATUS_OK;
}

status launch_again(analysis_context *c, const carried_masses *masses, const scene_motion *how,
                    instant *now, instant *room, fault *f)
{
    motion_stage s;
    TRY(stage_alloc(c, masses, &s, f));
    s.begins = 1;
    double *inc = calloc(2 * (size_t)s.all + 2, sizeof *inc);
    const status outcome = inc != NULL
                               ? begin(&s, how, now, room, inc, inc + s.all + 1, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    free(inc);
    stage_free(&s);
    return outcome;
}

static void set_field(const model *m, const model_state *s, const scene_start *field, double v[])
{
    for (int i = 0; i < model_vertices(m); i++)
        if (model_vertex(m, i)->body == i || i >= model_first_release(m))
            start_vertex(m, s, i, field, v);
}

status launch(analysis_context *c, const carried_masses *masses, const scene_motion *how,
              instant *now, instant *room, fault *f)
{
    const scene_rotating_frame rest = {{0}, {0}};
    return launch_turning(c, masses, how, &rest, now, room, f);
}

status launch_turning(analysis_context *c, const carried_masses *masses, const scene_motion *how,
                      const scene_rotating_frame *frame, instant *now, instant *room, fault *f)
{
    const model *m = c->model;
    scene_start field = {.velocity = {0}};
    drive_at(&c->eq, now->state, now->time, NULL, now->v, now->a);
    if (vec3_norm(frame->omega) > 0) {
        memcpy(field.spin, frame->omega, sizeof field.spin);
        memcpy(field.centre, frame->centre, sizeof field.centre);
        set_field(m, now->state, &field, now->v);
        TRY(check_field(m, now->state, &field, now->v, f));
    }
    /* the sum of both fields */
    double own[3], of_frame[3];
    vec3_cross(how->start.spin, how->start.centre, own);
    vec3_cross(frame->omega, frame->centre, of_frame);
    for (int i = 0; i < 3; i++) {
        field.velocity[i] = how->start.velocity[i] - own[i] - of_frame[i];
        field.spin[i] = how->start.spin[i] + frame->omega[i];
        field.centre[i] = 0;
    }
    set_field(m, now->state, &field, now->v);
    return launch_again(c, masses, how, now, room, f);
}
