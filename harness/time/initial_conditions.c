#include "harness/time/time_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

/* 1/(b h^2), where a = a0 + b inc (stage_rates): change of position per unit change of
 * acceleration, relative to h^2; so small that the positions hardly move */
static const double softness = 1e-12;

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
        const int kept =
            c != NONE && (c >= model_unknowns(m) || !model_owns(m, index, SCENE_RX + k));
        if (c != NONE && !kept)
            of[n++] = k;
        for (int i = 0; i < 3 && kept; i++)
            rest[i] -= b[k][i] * v[c];
    }
    for (int i = 0; i < n; i++) {
        right[i] = vec3_dot(b[of[i]], rest);
        for (int j = 0; j < n; j++)
            A[n * i + j] = vec3_dot(b[of[i]], b[of[j]]);
    }
    if (n == 0 || dense_lu_regular(n, A, pivot) != 0)
        return;
    dense_lu_solve(n, 1, A, pivot, right);
    for (int i = 0; i < n; i++)
        v[frame->coordinate[SCENE_RX + of[i]]] = right[i];
}

/* Computes the velocity [m/s] of a velocity field at the position of a vertex. */
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
    const int own = index < model_first_release(m);
    double R[9], velocity[3], body[3];
    velocity_of(m, s, index, field, velocity);
    rotation_matrix(&s->q[4 * index], R);
    mat3_transpose_mul_vec(R, field->spin, body);
    kinematics_to_own(frame, velocity);
    for (int i = 0; i < 3; i++) {
        const int c = frame->coordinate[i], t = frame->coordinate[SCENE_RX + i];
        if (c != NONE && c < model_unknowns(m) && own && model_owns(m, index, i))
            v[c] = velocity[i];
        if (t != NONE && t < model_unknowns(m) && frame->angles == 0 &&
            model_owns(m, index, SCENE_RX) && (own || forms_of(m, index) == FORM_BODY))
            v[t] = body[i];
    }
    if (frame->angles > 0 && vec3_norm(field->spin) > 0)
        start_angles(m, s, index, field->spin, v);
}

/* Checks the initial velocity field. REFUSED: it contradicts fixed or prescribed coordinates. */
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
                return fault_set(f, STATUS_REFUSED,
                                 "%s does not rotate with the axes at the start of the motion, "
                                 "because it is fixed or driven otherwise; drive it so that it "
                                 "rotates with the axes from 0 s on",
                                 scene_called(model_scene(m), SCENE_NODES, i).text);
    }
    return STATUS_OK;
}

/* Checks the drivers. REFUSED: the value of a driver at the start differs from the coordinate in
 * the state. */
static status check_drivers(const model *m, const double inc[], fault *f)
{
    const double nothing = 1e-9;
    for (int d = 0; d < model_scene(m)->drivers; d++) {
        const int c = model_driver_coordinate(m, d);
        if (c >= model_unknowns(m) && fabs(inc[c]) > nothing * (1 + model_length(m)))
            return fault_set(f, STATUS_REFUSED,
                             "motion %s starts %g away from its value in the initial state; at 0 "
                             "s, give it the value of the initial state",
                             model_scene(m)->driver[d].name, inc[c]);
    }
    return STATUS_OK;
}

static status accelerate(motion_stage *s, double h, motion_state *now, motion_state *room,
                         double *inc, double *zero, fault *f)
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
    motion_state_copy(m, now, room);
    motion_state_recall(now, &s->newton_convergence);
    TRY(stage_solve(s, now->state, now->time, &r, room->state, &record, f));
    history_drop_step(s->c->result, &record);
    kinematics_state_copy(m, now->state, room->state);
    memcpy(room->algorithm, room->a, (size_t)s->all * sizeof *room->a);
    motion_state_store(&s->newton_convergence, room);
    motion_state_copy(m, room, now);
    return STATUS_OK;
}

static status begin(motion_stage *s, const scene_motion *how, motion_state *now, motion_state *room,
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
    TRY(consistent_massless(s, zero, how->step, now, f));
    if (!s->masses->spread)
        return STATUS_OK;
    TRY(accelerate(s, how->step, now, room, inc, zero, f));
    TRY(massless_drop(m, s->masses, now->state, now->a, f));
    memcpy(now->algorithm, now->a, (size_t)s->all * sizeof *now->a);
    return STATUS_OK;
}

status consistent_restart(analysis_context *c, const frame_masses *masses, const scene_motion *how,
                          motion_state *now, motion_state *room, fault *f)
{
    motion_stage s;
    TRY(stage_alloc(c, masses, &s, f));
    s.begins = 1;
    double *inc = calloc(2 * (size_t)s.all + 2, sizeof *inc);
    const status outcome = inc != NULL ? begin(&s, how, now, room, inc, inc + s.all + 1, f)
                                       : fault_memory(f, "the time integration");
    now->state->path =
        now->time; /* loads after the jump, or after a static path, act from this time on */
    free(inc);
    stage_free(&s);
    return outcome;
}

/* Checks coordinates that are coupled to others. REFUSED: their rates in the field violate the
 * relation. */
static status check_followers(const model *m, const model_state *s, const scene_start *field,
                              const double v[], fault *f)
{
    const double nothing = 1e-9, spin = vec3_norm(field->spin);
    for (int i = 0; i < model_scene(m)->nodes && model_mesh_of(m)->joined != NULL; i++)
        for (int c = 0; c < VERTEX_COORDINATES; c++) {
            const mesh_vertex *at = model_vertex(m, i);
            const int turns = c >= SCENE_RX, of = at->coordinate[c];
            double b[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, along[3], rate[3];
            if (model_owns(m, i, c) || of == NONE || of >= model_unknowns(m))
                continue;
            if (turns && at->angles > 0)
                kinematics_axes(m, s, i, b);
            velocity_of(m, s, i, field, rate);
            inertia_swing by;
            inertia_swing_of(m, s, i, v, NULL, &by);
            for (int k = 0; k < 3 && by.led; k++)
                rate[k] -= by.moved[k] * by.rate;
            for (int k = 0; k < 3; k++) {
                along[k] = turns ? b[c - SCENE_RX][k] : at->turned ? at->along[3 * k + c] : k == c;
                rate[k] = turns ? field->spin[k] : rate[k];
            }
            const double square = vec3_dot(along, along), size = turns ? spin : vec3_norm(rate);
            if (fabs(vec3_dot(along, rate) / square - v[of]) > nothing * size)
                return fault_set(f, STATUS_REFUSED,
                                 "%s: the initial velocity violates a constraint with another "
                                 "node; start from a static analysis, or remove the constraint",
                                 scene_called(model_scene(m), SCENE_NODES, i).text);
        }
    return STATUS_OK;
}

static status set_field(const model *m, const model_state *s, const scene_start *field, double v[],
                        fault *f)
{
    for (int i = 0; i < 2 * model_vertices(m); i++) {
        const int vertex = i % model_vertices(m);
        if ((model_vertex(m, vertex)->body == vertex || vertex >= model_first_release(m)) &&
            model_owns(m, vertex, SCENE_RX) == (i < model_vertices(m)))
            start_vertex(m, s, vertex, field, v);
    }
    return check_followers(m, s, field, v, f);
}

status initial_conditions(analysis_context *c, const frame_masses *masses, const scene_motion *how,
                          motion_state *now, motion_state *room, fault *f)
{
    const scene_rotating_frame rest = {{0}, {0}};
    return initial_conditions_rotating(c, masses, how, &rest, now, room, f);
}

status initial_conditions_rotating(analysis_context *c, const frame_masses *masses,
                                   const scene_motion *how, const scene_rotating_frame *frame,
                                   motion_state *now, motion_state *room, fault *f)
{
    const model *m = c->model;
    scene_start field = {.velocity = {0}};
    drive_at(&c->eq, now->state, now->time, NULL, now->v, now->a);
    if (vec3_norm(frame->omega) > 0) {
        memcpy(field.spin, frame->omega, sizeof field.spin);
        memcpy(field.centre, frame->centre, sizeof field.centre);
        TRY(set_field(m, now->state, &field, now->v, f));
        TRY(check_field(m, now->state, &field, now->v, f));
    }
    double own[3], of_frame[3];
    vec3_cross(how->start.spin, how->start.centre, own);
    vec3_cross(frame->omega, frame->centre, of_frame);
    for (int i = 0; i < 3; i++) {
        field.velocity[i] = how->start.velocity[i] - own[i] - of_frame[i];
        field.spin[i] = how->start.spin[i] + frame->omega[i];
        field.centre[i] = 0;
    }
    TRY(set_field(m, now->state, &field, now->v, f));
    return consistent_restart(c, masses, how, now, room, f);
}

static status check_newton(const analysis_context *c, const scene_motion *how, fault *f)
{
    const newton_form newton = c->options->newton;
    if (newton == NEWTON_DENSE)
        return fault_set(f, STATUS_REFUSED,
                         "motions require a factorised tangent, which newton=dense does not form; "
                         "give newton=mixed");
    if (newton == NEWTON_DISPLACEMENT && how->scheme == SCENE_CONSERVING)
        return fault_set(
            f, STATUS_REFUSED,
            "the integrator conserving requires that strains are unknowns; give newton=mixed");
    return STATUS_OK;
}

/* Checks the kind of mass. REFUSED: the message gives the reason. */
static status check_mass(const analysis_context *c, int analysis, fault *f)
{
    const scene_analysis *one = &c->scene->analysis[analysis];
    const int spreads = model_spreads(c->model, analysis), follows = one->follows;
    const scene_scheme scheme = scene_motion_of(one)->scheme;
    if ((spreads || scene_spreads(one)) && (scheme == SCENE_CONSERVING || scheme == SCENE_EXPLICIT))
        return fault_set(
            f, STATUS_REFUSED,
            "the integrator %s supports only lumped mass; use alpha or radau for mass: consistent",
            scheme == SCENE_CONSERVING ? "conserving" : "explicit");
    if (!spreads && scene_spreads(one))
        return fault_set(f, STATUS_REFUSED,
                         "the formulation %s supports only lumped mass for this scene; use mass: "
                         "lumped, or another formulation",
                         model_formulation(c->model));
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_MOTION &&
        model_spreads(c->model, follows) != spreads)
        return fault_set(f, STATUS_REFUSED,
                         "a motion that continues another must use the same mass; make both lumped "
                         "or both consistent");
    return STATUS_OK;
}

/* Checks the formulation for the integrator conserving. REFUSED: it has additional unknowns or a
 * history, or its strains depend on rigid rotations. */
static status check_conserving(const analysis_context *c, int analysis, fault *f)
{
    const element_type *t = model_type(c->model);
    if (scene_motion_of(&c->scene->analysis[analysis])->scheme != SCENE_CONSERVING)
        return STATUS_OK;
    if (model_scalars(c->model) > 0)
        return fault_set(f, STATUS_REFUSED,
                         "the integrator conserving does not support formulations with additional "
                         "unknowns, such as %s; use the integrator alpha or radau",
                         t->name);
    if (model_history(c->model) == 0 && !(t->limits & LIMIT_NOT_OBJECTIVE))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "the integrator conserving requires strains that depend only on the state and "
                     "not on rigid rotations, but %s %s; use the integrator alpha or radau",
                     t->name, model_history(c->model) > 0 ? "has a history" : "is not objective");
}

static status check_explicit(const analysis_context *c, int analysis, fault *f)
{
    if (scene_motion_of(&c->scene->analysis[analysis])->scheme != SCENE_EXPLICIT ||
        !damping_of_elements(c->model))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "the integrator explicit does not support members with damping%s; use "
                     "another integrator",
                     model_type(c->model)->damping != NULL ? ", nor damping of the formulation"
                                                           : "");
}

status motion_check(const analysis_context *c, int analysis, fault *f)
{
    TRY(check_conserving(c, analysis, f));
    TRY(check_explicit(c, analysis, f));
    TRY(check_newton(c, scene_motion_of(&c->scene->analysis[analysis]), f));
    TRY(check_mass(c, analysis, f));
    TRY(forms_check(c->model, f));
    return drive_check(c->model, f);
}

status checks_massless(const analysis_context *c, const frame_masses *masses,
                       const scene_motion *how, const model_state *begin, fault *f)
{
    int massless;
    TRY(massless_count(c->model, masses, begin, &massless, f));
    if (massless == 0 || how->scheme != SCENE_ALPHA || how->alpha.force > how->alpha.mass)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "some coordinates (%d) have no inertia, so their accelerations would grow "
                     "with the trapezoidal rule or rho = 1; use rho < 1 or radau, or give the "
                     "sections rotary inertia (do not omit rotary_inertia)",
                     massless);
}

const double extent_guess = 0.02;

void extent_begin(extent *e, const model *m)
{
    e->bent = metric_distance(m, kinematics_rest(m), e->begin, NULL);
}

extent extent_with(const extent *so_far, const model *m, const motion_scheme *s,
                   const motion_state *from, const motion_state *to, double h, double error)
{
    const double memory = 10, /* [rad] range over which an error estimate is kept */
        distance = metric_distance(m, so_far->begin, to->state, s->light),
                 step = metric_distance(m, from->state, to->state, s->light);
    extent out = *so_far;
    out.largest = fmax(out.largest, distance);
    out.rate = fmax(out.rate, step / h);
    if (!s->adds || !(out.rate > 0))
        return out;
    const double per_jerk = 1 / 12.0, omega = sqrt(out.density / (per_jerk * out.rate));
    out.density = fmax(error / pow(h, s->order), out.density * exp(-omega * h / memory));
    return out;
}

double extent_error(const extent *so_far, const motion_scheme *s, double h, double error)
{
    return s->adds ? so_far->density * pow(h, s->order) : error;
}

/* relative rounding error of coordinates */
static const double rounding = 32 * DBL_EPSILON;

double extent_allows(const extent *so_far, double part, double tolerance)
{
    const double size = 1;
    const double most = tolerance * fmax(so_far->scale, fmin(size, so_far->largest)),
                 noise = 8 * DBL_EPSILON * so_far->bent;
    return fmax(part * fmax(most, rounding), noise);
}

int extent_is_less(const extent *so_far, double tolerance, double *scale)
{
    const double part = 0.5, known = 1e-10;
    *scale = fmax(so_far->largest, rounding);
    return so_far->largest > known * so_far->bent && *scale < part * so_far->scale &&
           so_far->worst > tolerance * *scale;
}

status integrator_alloc(const scheme_request *r, motion_scheme **out, fault *f)
{
    *out = NULL;
    switch (r->how->scheme) {
    case SCENE_ALPHA:
        return alpha_alloc(r, out, f);
    case SCENE_RADAU:
        return radau_alloc(r, out, f);
    case SCENE_CONSERVING:
        return conserving_alloc(r, out, f);
    case SCENE_EXPLICIT:
        return explicit_alloc(r, out, f);
    case SCENE_SCHEMES:
        break;
    }
    return fault_set(f, STATUS_REFUSED, "this integrator is not available");
}

void integrator_free(motion_scheme *s)
{
    if (s != NULL)
        s->free(s);
}
