#include "harness/conserving/conserving.h"
#include "cases/scene/names.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/larger.h"
#include "elements/math/vec3.h"
#include "harness/conserving/deformable.h"
#include "harness/equations/chunk.h"
#include "harness/inertia/increment.h"
#include "harness/model/assemble.h"
#include "harness/model/kinematics.h"
#include "harness/model/metric.h"
#include "harness/scheme/drive.h"
#include "harness/solver/history.h"

enum { MAX_ITERATIONS = 20 };

/* (S + column row^T) dx = residual */
static status direction(conserving *s, const instant *from, model_state *now, double h,
                        step_record *record, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    counters *count = model_counters(s->of.c->model);
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
    for (int i = 0; i < m->first_release; i++)
        for (int c = 0; c < 6 && m->vertex[i].body == i; c++) {
            const int at = m->vertex[i].coordinate[c];
            if (at != NONE)
                largest = larger(largest, fabs(s->dx[at]) / (c < 3 ? m->size : 1));
        }
    for (int i = 0; i < m->warps; i++)
        largest = larger(largest, fabs(s->dx[m->warp[i].coordinate]) * m->size);
    return largest;
}

static status iterate(conserving *s, const instant *from, double h, instant *to, double inc[],
                      step_record *record, fault *f)
{
    model *m = s->of.c->model;
    const double wild = 4, time = record->path;
    for (int iteration = 1;; iteration++) {
        TRY(conserving_stresses(s, from, to->state, iteration, f));
        TRY(direction(s, from, to->state, h, record, f));
        complement_keep(s->complement, to->state);
        const double inner = conserving_update(s, from, to->state);
        for (int c = 0; c < s->free; c++)
            s->step[c] += s->dx[c];
        conserving_increment(s, from->state, inc);
        increment_apply(m, from->state, inc, time, to->state);
        const double correction = larger(inner, size_of(s));
        m->counters.iterations++;
        const advance_stress stress = {s->largest, s->change};
        arrival_take(correction, &stress, iteration == 1, &s->arrival);
        record->remaining = s->arrival.remaining;
        const iteration_record one = {.correction = correction,
                                      .incompatibility = record->incompatibility};
        TRY(history_add_iteration(s->of.c->result, record, &one, NAN, f));
        if (arrival_reached(&s->arrival) && iteration > 2)
            return s->wild ? fault_set(f, STATUS_NOT_CONVERGED,
                                       "strains change too much in the step to %g s to keep "
                                       "energy: take a shorter one",
                                       time)
                           : STATUS_OK;
        if (!isfinite(correction) || correction > 4 * wild || (iteration > 3 && correction > wild))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "Newton diverged at %g s: correction %.1e in iteration %d", time,
                             correction, iteration);
        if (iteration == MAX_ITERATIONS)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "Newton did not converge in %d iterations at %g s: correction %.1e",
                             iteration, time, correction);
        complement_strains(s->complement, to->state, iteration, correction);
    }
}

static status step(scheme *base, const instant *from, double h, instant *to, double *error,
                   step_record *record, fault *f)
{
    conserving *s = (conserving *)base;
    model *m = s->of.c->model;
    double *inc = to->algorithm;
    *error = 0;
    s->h = h;
    kinematics_state_copy(m, from->state, to->state);
    conserving_predict(s, from, h);
    conserving_increment(s, from->state, inc);
    increment_apply(m, from->state, inc, record->path, to->state);
    TRY(conserving_begin(s, from, f));
    instant_recall(from, &s->arrival);
    TRY(iterate(s, from, h, to, inc, record, f));
    instant_remember(&s->arrival, to);
    TRY(conserving_work(s, from, to, h, f));
    conserving_rates(s, from, h, to);
    drive_at(m, from->state, record->path, NULL, to->v, to->a);
    conserving_damped(s, from, h, to);
    to->time = record->path;
    to->work += conserving_impulses(s, from, h, to);
    if (!s->massive.ready)
        TRY(massive_of(m, s->of.masses, from->state, &s->massive, f));
    for (int c = 0; c < s->free; c++) /* of the trapezoidal rule: h^2/12 (a1 - a) */
        s->dx[c] = h * h / 12 * (to->a[c] - from->a[c]);
    *error = massive_norm(&s->massive, m, s->weight, s->dx);
    return STATUS_OK;
}

static void release(scheme *base)
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

static status check(const model *m, fault *f)
{
    for (int i = 0; i < m->scene->nodes; i++)
        if (m->vertex[i].angles > 1)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: the conserving scheme takes one angle of a node at most: take alpha or radau",
                scene_called(m->scene, SCENE_NODES, i).text);
    return STATUS_OK;
}

static status allocate(conserving *s, fault *f)
{
    model *m = s->of.c->model;
    const sparse *pattern;
    s->strains = m->springs > 0 && m->strains < SPRING_STRAINS ? SPRING_STRAINS : m->strains;
    const int nodes = m->nodes > 2 || m->springs == 0 ? m->nodes : 2;
    const size_t all = (size_t)s->all + 1, count = (size_t)deformable_count(s) + 1,
                 strains = (size_t)s->strains,
                 elastic = m->damping != NULL ? (size_t)(m->elements * m->strains) : 0;
    s->slot_size = s->strains * (NODE_COORDINATES * nodes + s->strains + 3) + m->memory + 1;
    s->step = calloc(6 * all, sizeof *s->step);
    s->W = calloc(count * (2 * strains * strains + 1 + strains + (size_t)s->slot_size) +
                      (size_t)(3 * SPRING_STRAINS * m->springs) +
                      (size_t)(9 * s->of.masses->masses) + elastic,
                  sizeof *s->W);
    if (s->of.c->options->newton != SOLVE_DISPLACEMENT)
        TRY(complement_alloc(m, &s->complement, f));
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
    s->massless = s->spring + (size_t)(3 * SPRING_STRAINS * m->springs);
    if (elastic > 0)
        s->elastic = s->massless + (size_t)(9 * s->of.masses->masses);
    TRY(conserving_massless(s, f));
    metric_of(m, s->weight);
    TRY(assemble_pattern_in_time(m, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    return factor_alloc(pattern, &s->factor, f);
}

status conserving_alloc(const scheme_request *request, scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    *out = NULL;
    TRY(check(request->c->model, f));
    conserving *s = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    *out = &s->base;
    s->base = (scheme){.order = 3, .step = step, .free = release};
    s->of = *request;
    s->free = size.free;
    s->all = size.free + size.driven;
    arrival_start(request->c->options->criterion, model_leaves(request->c->model) != 0,
                  size.elements, &s->arrival);
    return allocate(s, f);
}
