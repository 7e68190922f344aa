#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>

#include "cases/scene/scene.h"
#include "elements/math/vec3.h"

typedef struct alpha {
    motion_scheme base;
    motion_stage stage;
    outer_work *work;
    massive massive;
    size_t strains; /* model_stresses if there is damping of members or springs, otherwise 0 */
    double *mean;   /* [strains] mean strain rates of the step */
    double mass, force, gamma, beta; /* alpha_m, alpha_f */
    double *a0, *v0, *inc, *weight;  /* [free + driven] */
} alpha;

/* Returns a1 of the scheme (time_impl.h). a: its value at the start of the step; before, now: true
 * accelerations at the start and at the end. */
static double averaged(const alpha *s, double a, double before, double now)
{
    return ((1 - s->force) * now + s->force * before - s->mass * a) / (1 - s->mass);
}

static void relate(alpha *s, const motion_state *from, double h, stage_rates *r)
{
    for (int i = 0; i < s->stage.free; i++) {
        const double v = from->v[i], a = from->algorithm[i], vd = from->a[i];
        /* part of inc that does not depend on a1 */
        const double known = h * v + h * h * (0.5 - s->beta) * a;
        s->inc[i] = known + h * h * s->beta * averaged(s, a, vd, vd);
        s->a0[i] = -r->b * known - (s->force * vd - s->mass * a) / (1 - s->force);
        s->v0[i] = v + h * (1 - s->gamma) * a - r->g * known;
    }
}

static status error_of(alpha *s, const motion_state *from, const motion_state *to, double h,
                       double *error, fault *f)
{
    const model *m = s->stage.c->model;
    const double part = h * h * fabs(s->beta + (s->mass - s->force) / 2 - 1 / 6.0);
    double *one = s->v0;
    if (!s->massive.ready)
        TRY(massive_of(m, s->stage.masses, from->state, &s->massive, f));
    s->base.light = s->massive.light;
    for (int i = 0; i < s->stage.free; i++)
        one[i] = part * (to->algorithm[i] - from->algorithm[i]);
    *error = massive_norm(&s->massive, m, s->weight, one);
    return STATUS_OK;
}

static void relate_strains(alpha *s, const motion_state *from, double h, motion_state *to)
{
    const double g = s->gamma / (s->beta * h), kept = 1 - s->gamma / s->beta,
                 later = h * (1 - s->gamma / (2 * s->beta));
    for (size_t i = 0; i < s->strains; i++)
        to->strain[i] = kept * from->strain[i] + later * from->strain2[i];
    damping_follow(&s->stage.c->eq, g, to->strain, from->state);
}

/* Returns the energy [J] absorbed in a step by springs without a potential. */
static double circulated(const model *m, const model_state *from, const model_state *to)
{
    double sum = 0;
    for (int i = 0; i < model_scene(m)->springs; i++) {
        double d[SPRING_STRAINS], change[SPRING_STRAINS],
            J[SPRING_STRAINS * ELEMENT_MAX_COORDINATES];
        if (!scene_spring_circulates(&model_scene(m)->spring[i]))
            continue;
        dashpots_strains(m, from, i, d, J);
        dashpots_strains(m, to, i, change, J);
        for (int k = 0; k < SPRING_STRAINS; k++)
            change[k] -= d[k];
        sum += spring_circulated(m, i, d, change);
    }
    return sum;
}

static void damp(alpha *s, const motion_state *from, double h, motion_state *to)
{
    const double g = s->gamma / (s->beta * h), part = 1 / (s->beta * h * h);
    const model *m = s->stage.c->model;
    const frame_masses *masses = s->stage.masses;
    to->dissipated = from->dissipated +
                     h / 2 *
                         (inertia_damping_power(m, masses, from->state, from->v) +
                          inertia_damping_power(m, masses, to->state, to->v)) +
                     circulated(m, from->state, to->state);
    if (s->strains == 0)
        return;
    const double *e0 = s->stage.c->run->damping->from, *e1 = s->mean;
    damping_strains(s->stage.c->model, to->state, s->mean);
    for (size_t i = 0; i < s->strains; i++) {
        const double gained = e1[i] - e0[i];
        s->mean[i] = gained / h;
        to->strain[i] += g * gained;
        to->strain2[i] =
            part * (gained - h * from->strain[i]) - (0.5 - s->beta) / s->beta * from->strain2[i];
    }
    to->dissipated += h * damping_power(&s->stage.c->eq, s->mean);
}

/* Rejects a step in which a rotation exceeds one radian. */
static status check_turns(const alpha *s, double time, fault *f)
{
    const double most = 1;
    const model *m = s->stage.c->model;
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        double turn[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY)
            continue;
        for (int k = 0; k < 3; k++)
            turn[k] = s->inc[at[k]];
        if (vec3_norm(turn) > most)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "a node rotates by %.2g rad in the step to %g s, but at most %g rad "
                             "is allowed; use a smaller step",
                             vec3_norm(turn), time, most);
    }
    return STATUS_OK;
}

static status step(motion_scheme *base, const motion_state *from, double h, motion_state *to,
                   double *error, step_record *record, fault *f)
{
    alpha *s = (alpha *)base;
    const model *m = s->stage.c->model;
    const double time = record->path;
    stage_rates r = {.b = (1 - s->mass) / ((1 - s->force) * s->beta * h * h),
                     .g = s->gamma / (s->beta * h),
                     .h = h,
                     .a0 = s->a0,
                     .v0 = s->v0,
                     .inc = s->inc,
                     .v = to->v,
                     .a = to->a};
    relate(s, from, h, &r);
    drive_at(&s->stage.c->eq, from->state, time, s->inc, to->v, to->a);
    kinematics_state_copy(m, from->state, to->state);
    kinematics_commit(m, to->state);
    relate_strains(s, from, h, to);
    motion_state_recall(from, &s->stage.newton_convergence);
    TRY(stage_solve(&s->stage, from->state, time, &r, to->state, record, f));
    const feedback_step past = {h, from->time, discontinuities_before(m, time)};
    feedback_integrate(&s->stage.c->eq, from->state, to->state, &past, to->state->feedback);
    motion_state_store(&s->stage.newton_convergence, to);
    TRY(check_turns(s, time, f));
    for (int i = 0; i < s->stage.all; i++)
        to->algorithm[i] = averaged(s, from->algorithm[i], from->a[i], to->a[i]);
    to->time = time;
    to->work = from->work + work_trapezoid(s->work, from, to, s->inc);
    damp(s, from, h, to);
    return error_of(s, from, to, h, error, f);
}

static void release(motion_scheme *base)
{
    alpha *s = (alpha *)base;
    stage_free(&s->stage);
    massive_free(&s->massive);
    free(s->a0);
    free(s->mean);
    free(s);
}

status alpha_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    const size_t n = (size_t)(size.free + size.driven) + 1;
    const scene_alpha *how = &request->how->alpha;
    const double gamma = 0.5 + how->force - how->mass, half = (gamma + 0.5) / 2;
    alpha *s = calloc(1, sizeof *s);
    *out = NULL;
    if (s == NULL)
        return fault_memory(f, "the time integration");
    *out = &s->base;
    *s = (alpha){
        .base = {.order = 3, .adds = 1, .step = step, .free = release},
        .work = request->work,
        .strains = damping_acts(request->c->model) ? (size_t)model_stresses(request->c->model) : 0,
        .mass = how->mass,
        .force = how->force,
        .gamma = gamma,
        .beta = half * half,
        .a0 = calloc(4 * n, sizeof(double))};
    s->mean = calloc(s->strains + 1, sizeof *s->mean);
    if (s->a0 == NULL || s->mean == NULL)
        return fault_memory(f, "the time integration");
    s->v0 = s->a0 + n;
    s->inc = s->v0 + n;
    s->weight = s->inc + n;
    metric_of(request->c->model, s->weight);
    return stage_alloc(request->c, request->masses, &s->stage, f);
}
