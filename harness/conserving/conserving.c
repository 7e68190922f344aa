#include "harness/conserving/conserving.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"
#include "harness/conserving/conserving_impl.h"
#include "harness/equations/loads.h"
#include "harness/inertia/increment.h"
#include "harness/model/assemble.h"
#include "harness/model/kinematics.h"
#include "harness/model/metric.h"
#include "harness/scheme/drive.h"
#include "harness/solver/history.h"

enum { MAX_ITERATIONS = 20 };

static int turns(const model *m, int vertex)
{
    return m->vertex[vertex].body == vertex && m->vertex[vertex].angles == 0;
}

/* dr, c, da to increments of coordinates, rotations by vectors in the frames' axes. */
static void as_increment(const conserving *s, const model_state *from, double inc[])
{
    const model *m = s->of.c->model;
    memcpy(inc, s->step, (size_t)s->all * sizeof *inc);
    for (int i = 0; i < m->first_release; i++) {
        const int *at = m->vertex[i].coordinate;
        double c[3], t[3], R[9], body[3];
        frame_rates r;
        if (!turns(m, i))
            continue;
        for (int k = 0; k < 3; k++)
            c[k] = at[SCENE_RX + k] != NONE ? s->step[at[SCENE_RX + k]] : 0;
        cayley_to_vector(c, t);
        forms_rates(m, from, i, inc, NULL, &r);
        memcpy(R, r.R, sizeof R);
        mat3_transpose_mul_vec(R, t, body);
        for (int k = 0; k < 3; k++)
            if (at[SCENE_RX + k] != NONE)
                inc[at[SCENE_RX + k]] = body[k];
    }
}

/* c = h w, and dr = h/2 (v + cay(c) v): the velocity turns with its node. */
static void predict(conserving *s, const instant *from, double h)
{
    const model *m = s->of.c->model;
    for (int c = 0; c < s->free; c++)
        s->step[c] = h * from->v[c];
    drive_at(m, from->state, from->time + h, s->step, NULL, NULL);
    for (int i = 0; i < m->first_release; i++) {
        const int *at = m->vertex[i].coordinate;
        frame_rates r;
        double c[3], t[3], crossed[3], twice[3];
        if (!turns(m, i))
            continue;
        forms_rates(m, from->state, i, from->v, NULL, &r);
        for (int k = 0; k < 3; k++)
            t[k] = at[SCENE_RX + k] != NONE && at[SCENE_RX + k] >= s->free
                       ? s->step[at[SCENE_RX + k]]
                       : 0;
        mat3_mul_vec(r.R, t, crossed);
        cayley_of_vector(crossed, t);
        for (int k = 0; k < 3; k++) {
            const int x = at[SCENE_RX + k];
            c[k] = x == NONE ? 0 : x < s->free ? h * r.w[k] : t[k];
            if (x != NONE)
                s->step[x] = c[k];
        }
        /* cay(c) v - v = (c x v + c x (c x v)/2)/(1 + c.c/4) */
        vec3_cross(c, r.v, crossed);
        vec3_cross(c, crossed, twice);
        for (int k = 0; k < 3; k++)
            if (at[k] != NONE && at[k] < s->free)
                s->step[at[k]] =
                    h * (r.v[k] + (crossed[k] + twice[k] / 2) / (1 + vec3_dot(c, c) / 4) / 2);
    }
}

/* f at the middle, the mean of what it is in both states. */
static void add_loads(conserving *s, const instant *from, const model_state *now, double h)
{
    const model *m = s->of.c->model;
    const double middle = from->time + h / 2;
    for (int i = 0; i < m->scene->loads; i++) {
        const double half = loads_factor(m, &m->scene->load[i], middle) / 2;
        loads_add_one(m, from->state, &m->scene->load[i], half, s->residual);
        loads_add_one(m, now, &m->scene->load[i], half, s->residual);
    }
}

/* (S + column row^T) dx = residual */
static status direction(conserving *s, const instant *from, const model_state *now, double h,
                        step_record *record, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    counters *count = model_counters(s->of.c->model);
    memset(s->residual, 0, bytes);
    memset(s->column, 0, bytes);
    memset(s->row, 0, bytes);
    sparse_zero(&s->S);
    record->incompatibility = 0;
    TRY(conserving_elements(s, from, now, &record->incompatibility, f));
    conserving_inertia(s, from, now, h);
    add_loads(s, from, now, h);
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
    const factor_counts counts = factor_count(s->factor);
    count->factorisations += counts.factorisations - s->counted;
    s->counted = counts.factorisations;
    count->solutions++;
    count->factor_entries = counts.entries;
    count->factor_flops += counts.flops;
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
                largest = fmax(largest, fabs(s->dx[at]) / (c < 3 ? m->size : 1));
        }
    for (int i = 0; i < m->warps; i++)
        largest = fmax(largest, fabs(s->dx[m->warp[i].coordinate]) * m->size);
    return largest;
}

static status iterate(conserving *s, const instant *from, double h, instant *to, double inc[],
                      step_record *record, fault *f)
{
    model *m = s->of.c->model;
    const double wild = 4, time = record->path;
    for (int iteration = 1;; iteration++) {
        TRY(conserving_scalar(s, from, to->state, iteration, f));
        TRY(direction(s, from, to->state, h, record, f));
        const double inner = conserving_update(s, from, to->state);
        for (int c = 0; c < s->free; c++)
            s->step[c] += s->dx[c];
        as_increment(s, from->state, inc);
        increment_apply(m, from->state, inc, time, to->state);
        const double correction = fmax(inner, size_of(s));
        m->counters.iterations++;
        const advance_stress stress = {s->largest, s->change};
        arrival_take(correction, &stress, iteration == 1, &s->arrival);
        record->remaining = s->arrival.remaining;
        const iteration_record one = {.correction = correction,
                                      .incompatibility = record->incompatibility};
        TRY(history_add_iteration(s->of.c->result, record, &one, NAN, f));
        if (arrival_reached(&s->arrival) && iteration > 2)
            return STATUS_OK;
        if (!isfinite(correction) || correction > 4 * wild || (iteration > 3 && correction > wild))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "Newton diverged at %g s: correction %.1e in iteration %d", time,
                             correction, iteration);
        if (iteration == MAX_ITERATIONS)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "Newton did not converge in %d iterations at %g s: correction %.1e",
                             iteration, time, correction);
    }
}

/* The forces of the step along it: what its energy gains to the last digit. */
static status add_work(conserving *s, const instant *from, double h, instant *to, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    double gap = 0;
    to->work = from->work;
    to->dissipated = from->dissipated;
    memset(s->residual, 0, bytes);
    if (s->all > s->free) {
        sparse_zero(&s->S);
        TRY(conserving_elements(s, from, to->state, &gap, f));
        conserving_inertia(s, from, to->state, h);
        to->work -= dense_dot(s->all - s->free, s->residual + s->free, s->step + s->free);
        memset(s->residual, 0, bytes);
    }
    add_loads(s, from, to->state, h);
    to->work += dense_dot(s->free, s->residual, s->step);
    return STATUS_OK;
}

static status step(scheme *base, const instant *from, double h, instant *to, double *error,
                   step_record *record, fault *f)
{
    conserving *s = (conserving *)base;
    model *m = s->of.c->model;
    double *inc = to->algorithm;
    *error = 0;
    kinematics_state_copy(m, from->state, to->state);
    memset(s->d, 0, (size_t)m->elements * (size_t)m->strains * sizeof *s->d);
    predict(s, from, h);
    as_increment(s, from->state, inc);
    increment_apply(m, from->state, inc, record->path, to->state);
    TRY(conserving_begin(s, from, f));
    TRY(iterate(s, from, h, to, inc, record, f));
    conserving_rates(s, from, h, to);
    drive_at(m, from->state, record->path, NULL, to->v, to->a);
    to->time = record->path;
    TRY(add_work(s, from, h, to, f));
    double square = 0; /* of the trapezoidal rule: h^2/12 (a1 - a) */
    for (int c = 0; c < s->free; c++) {
        const double one = h * h / 12 * (to->a[c] - from->a[c]);
        square += s->weight[c] * one * one;
    }
    *error = sqrt(square);
    return STATUS_OK;
}

static void release(scheme *base)
{
    conserving *s = (conserving *)base;
    sparse_free_values(&s->S);
    factor_free(s->factor);
    free(s->step);
    free(s->W);
    free(s);
}

static status check(const model *m, fault *f)
{
    if (m->releases > 0 || m->springs > 0)
        return fault_set(f, STATUS_REFUSED,
                         "the conserving scheme takes no %s: take alpha or radau",
                         m->springs > 0 ? "springs" : "released ends");
    for (int i = 0; i < m->scene->nodes; i++)
        if (m->vertex[i].angles > 0)
            return fault_set(f, STATUS_REFUSED,
                             "node %d: the conserving scheme takes no angles in sequence: take "
                             "alpha or radau",
                             i);
    return STATUS_OK;
}

static status allocate(conserving *s, fault *f)
{
    model *m = s->of.c->model;
    const sparse *pattern;
    const size_t all = (size_t)s->all + 1, elements = (size_t)m->elements + 1,
                 strains = (size_t)m->strains;
    s->slot_size =
        m->strains * m->coordinates + m->strains * m->strains + 3 * m->strains + m->memory + 1;
    s->step = calloc(6 * all, sizeof *s->step);
    s->W =
        calloc(elements * (strains * strains + strains + 1 + (size_t)s->slot_size), sizeof *s->W);
    if (s->step == NULL || s->W == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    s->residual = s->step + all;
    s->column = s->residual + all;
    s->row = s->column + all;
    s->dx = s->row + all;
    s->weight = s->dx + all;
    s->energy = s->W + elements * strains * strains;
    s->d = s->energy + elements;
    s->slot = s->d + elements * strains;
    metric_of(m, s->weight);
    TRY(assemble_pattern(m, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    TRY(factor_alloc(pattern, &s->factor, f));
    return conserving_rest(s, f);
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
