#include "harness/time/conserving.h"
#include "cases/scene/names.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/larger.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/deformable.h"
#include "harness/time/drive.h"
#include "harness/time/increment.h"

enum { LEAST_ITERATIONS = 3 };

/* (S + column row^T) dx = residual */
static status direction(conserving *s, const instant *from, model_state *now, double h,
                        step_record *record, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    counters *count = &s->of.c->run->counters;
    memset(s->residual, 0, bytes);
    memset(s->column, 0, bytes);
    memset(s->row, 0, bytes);
    sparse_zero(&s->S);
    record->incompatibility = 0;
    conserving_forces(s, from, now, &record->incompatibility);
    conserving_inertia(s, from, now, h);
    conserving_loads(s, from, now, h, s->residual);
    for (int c = 0; c < s->free; c++)
        s->residual[c] -= s->missing * s->column[c];
    TRY(context_factor(s->of.c, s->factor, &s->S, f));
    memcpy(s->dx, s->residual, (size_t)s->free * sizeof *s->dx);
    memset(s->dx + s->free, 0, (size_t)(s->all - s->free) * sizeof *s->dx);
    factor_solve(s->factor, s->dx);
    if (s->k != 0) {
        factor_solve(s->factor, s->column);
        const double part =
            dense_dot(s->free, s->row, s->dx) / (1 + dense_dot(s->free, s->row, s->column));
        for (int c = 0; c < s->free; c++)
            s->dx[c] -= part * s->column[c];
        count->solutions++;
    }
    context_count_solution(s->of.c, s->factor, 1, &s->counted);
    return STATUS_OK;
}

static double size_of(const conserving *s)
{
    const model *m = s->of.c->model;
    double largest = 0;
    for (int i = 0; i < model_first_release(m); i++)
        for (int c = 0; c < 6 && model_vertex(m, i)->body == i; c++) {
            const int at = model_vertex(m, i)->coordinate[c];
            if (at != NONE)
                largest = larger(largest, fabs(s->dx[at]) / (c < 3 ? model_length(m) : 1));
        }
    for (int i = 0; i < model_warps(m); i++)
        largest = larger(largest, fabs(s->dx[model_warp(m, i)]) * model_length(m));
    return largest;
}

/* What an iteration of a step works on. */
typedef struct solution {
    conserving *s;
    const instant *from;
    instant *to;
    double time;
} solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    const solution *one = of;
    conserving *s = one->s;
    const model_state *from = one->from->state;
    model_state *now = one->to->state;
    double *inc = one->to->algorithm;
    TRY(conserving_stresses(s, one->from, now, iteration, f));
    TRY(direction(s, one->from, now, s->h, record, f));
    complement_keep(s->complement, now);
    const double inner = conserving_update(s, one->from, now);
    for (int c = 0; c < s->free; c++)
        s->step[c] += s->dx[c];
    conserving_increment(s, from, inc);
    increment_apply(s->of.c->model, from, inc, one->time, now);
    out->at = one->time;
    out->size = larger(inner, size_of(s));
    out->stress = (advance_stress){s->largest, s->change};
    return STATUS_OK;
}

static void prepare(void *of, int iteration, double correction)
{
    const solution *one = of;
    complement_strains(one->s->complement, one->to->state, iteration, correction);
}

static status accept(void *of, fault *f)
{
    const solution *one = of;
    return one->s->wild ? fault_set(f, STATUS_NOT_CONVERGED,
                                    "strains change too much in the step to %g s to keep energy: "
                                    "take a shorter one",
                                    one->time)
                        : STATUS_OK;
}

static status step(motion_scheme *base, const instant *from, double h, instant *to, double *error,
                   step_record *record, fault *f)
{
    conserving *s = (conserving *)base;
    const model *m = s->of.c->model;
    double *inc = to->algorithm;
    *error = 0;
    s->h = h;
    kinematics_state_copy(m, from->state, to->state);
    conserving_predict(s, from, h);
    conserving_increment(s, from->state, inc);
    increment_apply(m, from->state, inc, record->path, to->state);
    TRY(conserving_begin(s, from, f));
    instant_recall(from, &s->arrival);
    solution one = {s, from, to, record->path};
    newton_use use = newton_in_time(s->of.c, &one, correct, prepare);
    use.accept = accept;
    use.least = LEAST_ITERATIONS;
    TRY(newton_iterate(s->of.c, &use, &s->arrival, record, f));
    instant_remember(&s->arrival, to);
    TRY(conserving_work(s, from, to, h, f));
    conserving_rates(s, from, h, to);
    drive_at(&s->of.c->eq, from->state, record->path, NULL, to->v, to->a);
    conserving_damped(s, from, h, to);
    to->time = record->path;
    to->work += conserving_impulses(s, from, h, to);
    if (!s->massive.ready)
        TRY(massive_of(m, s->of.masses, from->state, &s->massive, f));
    s->base.light = s->massive.light;
    for (int c = 0; c < s->free; c++) /* of the trapezoidal rule: h^2/12 (a1 - a) */
        s->dx[c] = h * h / 12 * (to->a[c] - from->a[c]);
    *error = massive_norm(&s->massive, m, s->weight, s->dx);
    return STATUS_OK;
}

static void release(motion_scheme *base)
{
    conserving *s = (conserving *)base;
    sparse_free_values(&s->S);
    factor_free(s->factor);
    free(s->step);
    free(s->W);
    free(s->evaluation);
    complement_free(s->complement);
    massive_free(&s->massive);
    free(s);
}

/* Two free angles: what turns by them has an angular velocity across both at the end of a step,
 * with an energy that their rates have not. */
static status check(const model *m, fault *f)
{
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        const mesh_vertex *v = model_vertex(m, i);
        int free = 0;
        for (int k = 0; k < v->angles; k++)
            free += v->coordinate[SCENE_RX + k] != NONE &&
                    v->coordinate[SCENE_RX + k] < model_unknowns(m);
        if (v->angles == 2 && free == 2)
            return fault_set(f, STATUS_REFUSED,
                             "%s turns by two free angles: the conserving scheme takes one, three, "
                             "or driven ones; take alpha or radau",
                             scene_called(model_scene(m), SCENE_NODES, i).text);
    }
    return STATUS_OK;
}

static status allocate(conserving *s, fault *f)
{
    const model *m = s->of.c->model;
    const sparse *pattern;
    s->strains = model_springs(m) > 0 && model_strains(m) < SPRING_STRAINS ? SPRING_STRAINS
                                                                           : model_strains(m);
    const int nodes = model_nodes(m) > 2 || model_springs(m) == 0 ? model_nodes(m) : 2;
    const size_t all = (size_t)s->all + 1, count = (size_t)deformable_count(s) + 1,
                 strains = (size_t)s->strains,
                 elastic = s->of.c->run->damping != NULL
                               ? (size_t)(model_elements(m) * model_strains(m))
                               : 0;
    s->slot_size = s->strains * (NODE_COORDINATES * nodes + s->strains + 3) + model_memory(m) + 1;
    s->step = calloc(6 * all, sizeof *s->step);
    s->W = calloc(count * (2 * strains * strains + 1 + strains + (size_t)s->slot_size) +
                      (size_t)(3 * SPRING_STRAINS * model_springs(m)) +
                      (size_t)(9 * s->of.masses->masses) + elastic,
                  sizeof *s->W);
    if (s->of.c->options->newton != NEWTON_DISPLACEMENT)
        TRY(complement_alloc(&s->of.c->eq, &s->complement, f));
    s->evaluation = malloc((size_t)chunk_size(m) * sizeof *s->evaluation);
    if (s->step == NULL || s->W == NULL || s->evaluation == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    s->residual = s->step + all;
    s->column = s->residual + all;
    s->row = s->column + all;
    s->dx = s->row + all;
    s->weight = s->dx + all;
    s->C = s->W + count * strains * strains;
    s->energy = s->C + count * strains * strains;
    s->d = s->energy + count;
    s->slot = s->d + count * strains;
    s->spring = s->slot + count * (size_t)s->slot_size;
    s->massless = s->spring + (size_t)(3 * SPRING_STRAINS * model_springs(m));
    if (elastic > 0)
        s->elastic = s->massless + (size_t)(9 * s->of.masses->masses);
    TRY(conserving_massless(s, f));
    metric_of(m, s->weight);
    TRY(assemble_pattern_in_time(s->of.c->model, s->of.c->run->patterns, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    return factor_alloc(pattern, &s->factor, f);
}

status conserving_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    *out = NULL;
    TRY(check(request->c->model, f));
    conserving *s = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    *out = &s->base;
    s->base = (motion_scheme){.order = 3, .adds = 1, .step = step, .free = release};
    s->of = *request;
    s->free = size.free;
    s->all = size.free + size.driven;
    arrival_start(request->c->options->criterion, model_leaves(request->c->model) != 0,
                  size.elements, &s->arrival);
    return allocate(s, f);
}
