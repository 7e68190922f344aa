#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"

/* Computes the error of positions due to a completed step, with the norm of metric_distance. The
 * error satisfies [g^2 M + K] error = F(x, v) + M (sum e_i (v_i - v)/h + g (v + sum e_i inc_i/h)).
 * F are the forces at the start of the step, v_i and inc_i belong to stage i, e_i are the
 * coefficients of the estimate, g = 1/(l h), and l is the real eigenvalue of A. room: work space.
 */
static status radau_error(radau *, const motion_state *from, double h, motion_state *room,
                          double *error, fault *);

typedef struct radau_solution {
    radau *r;
    const motion_state *from;
    double h;
} radau_solution;

static void advance(const radau_solution *of, const step_record *record, newton_correction *out)
{
    radau *r = of->r;
    const model *m = r->of.c->model;
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        const double time = radau_time(r, of->from, of->h, i, record);
        advance_stress stress;
        memset(r->dx, 0, (size_t)r->all * sizeof *r->dx);
        memcpy(r->dx, r->residual + (size_t)i * (size_t)r->free, (size_t)r->free * sizeof *r->dx);
        increment_add(m, one->state, r->dx, one->inc);
        strain_update_begin(one->strain_update, one->state);
        out->size = larger(
            out->size, advance_state(&r->of.c->eq, &one->memory, one->state, r->dx, time, &stress));
        out->stress.largest = fmax(out->stress.largest, stress.largest);
        out->stress.change = fmax(out->stress.change, stress.change);
    }
}

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    const radau_solution *one = of;
    radau *r = one->r;
    const int fresh = iteration == 1 || !stage_stands(&r->newton_convergence);
    TRY(radau_equations(r, fresh, one->from, one->h, record, f));
    if (fresh)
        TRY(context_factor(r->of.c, r->factor, &r->S.whole, f));
    factor_solve(r->factor, r->residual);
    context_count_factorisations(r->of.c, r->factor, &r->counted);
    advance(one, record, out);
    out->at = one->from->time + one->h;
    radau_rates(r, one->from, one->h);
    return STATUS_OK;
}

static void prepare(void *of, int iteration, double correction)
{
    radau *r = ((const radau_solution *)of)->r;
    for (int i = 0; i < STAGES; i++)
        strain_update_apply(r->stage[i].strain_update, r->stage[i].state, iteration, correction);
}

/* Returns the work [J] of external forces in the step, by the quadrature of the scheme over the
 * stages. */
static double work_of_stages(radau *r, const motion_state *from, double h,
                             const step_record *record)
{
    double sum = 0;
    for (int i = 0; i < STAGES; i++) {
        const radau_stage *one = &r->stage[i];
        const double time =
            discontinuities_before(r->of.c->model, radau_time(r, from, h, i, record));
        sum += h * r->weights[i] *
               (work_power(r->of.work, one->state, one->v, one->a, time, one->v) +
                free_strain_power(&r->of.c->eq, one->state, time));
    }
    return sum;
}

static status solve(radau *r, const motion_state *from, double h, motion_state *to, double *error,
                    step_record *record, fault *f)
{
    const model *m = r->of.c->model;
    const size_t bytes = (size_t)r->all * sizeof(double);
    for (int i = 0; i < STAGES; i++) {
        radau_stage *one = &r->stage[i];
        const double t = r->node[i] * h, time = radau_time(r, from, h, i, record);
        for (int c = 0; c < r->free; c++)
            one->inc[c] = t * from->v[c] + t * t / 2 * from->a[c];
        drive_at(&r->of.c->eq, from->state, time, one->inc, one->v, one->a);
        kinematics_state_copy(m, from->state, one->state);
        kinematics_commit(m, one->state);
        increment_apply(m, from->state, one->inc, time, one->state);
    }
    radau_rates(r, from, h);
    motion_state_recall(from, &r->newton_convergence);
    radau_solution one = {r, from, h};
    const newton_use use = newton_in_time(r->of.c, &one, correct, prepare);
    TRY(newton_iterate(r->of.c, &use, &r->newton_convergence, record, f));
    radau_integrate(r, from, h, record);
    motion_state_store(&r->newton_convergence, to);
    const radau_stage *last = &r->stage[STAGES - 1];
    if (r->of.estimate)
        TRY(radau_error(r, from, h, to, error, f));
    kinematics_state_copy(m, last->state, to->state);
    memcpy(to->v, last->v, bytes);
    memcpy(to->a, last->a, bytes);
    memcpy(to->algorithm, last->a, bytes);
    to->time = record->path;
    to->work = from->work + work_of_stages(r, from, h, record);
    to->dissipated = from->dissipated + radau_dissipated(r, from, h, to->strain);
    return STATUS_OK;
}

static status step(motion_scheme *base, const motion_state *from, double h, motion_state *to,
                   double *error, step_record *record, fault *f)
{
    radau *r = (radau *)base;
    *error = 0;
    if (r->of.c->run->damping != NULL)
        damping_follow(&r->of.c->eq, 0, r->of.c->run->damping->none, NULL);
    return solve(r, from, h, to, error, record, f);
}

static void release(motion_scheme *base)
{
    radau *r = (radau *)base;
    for (int i = 0; i < STAGES; i++) {
        kinematics_state_free(r->stage[i].state);
        free(r->stage[i].inc);
        linear_memory_free(&r->stage[i].memory);
        strain_update_free(r->stage[i].strain_update);
    }
    sparse_free_values(&r->K);
    factor_free(r->factor);
    factor_free(r->single);
    stages_free(&r->S);
    free(r->residual);
    free(r->dx);
    free(r->weight);
    free(r->errors);
    free(r->turn);
    free(r);
}

static status allocate_stage(radau *r, radau_stage *one, fault *f)
{
    const model *m = r->of.c->model;
    const size_t all = (size_t)r->all + 1;
    one->inc = calloc(4 * all, sizeof *one->inc);
    if (one->inc == NULL)
        return fault_memory(f, "the stages of a step");
    TRY(linear_memory_alloc(m, &one->memory, f));
    one->rate = one->inc + all;
    one->v = one->rate + all;
    one->a = one->v + all;
    if (r->of.c->options->newton != NEWTON_DISPLACEMENT)
        TRY(strain_update_alloc(&r->of.c->eq, &one->strain_update, f));
    return kinematics_state_alloc(m, &one->state, f);
}

static status allocate(radau *r, fault *f)
{
    const sparse *pattern;
    const size_t all = (size_t)r->all + 1;
    r->residual = calloc(STAGES * all, sizeof *r->residual);
    r->dx = calloc(all, sizeof *r->dx);
    r->weight = calloc(all, sizeof *r->weight);
    r->errors = calloc((size_t)(STAGES * feedback_count(&r->of.c->eq)) + 1, sizeof *r->errors);
    r->turn = calloc((size_t)model_vertices(r->of.c->model) * STAGES * 18 + 1, sizeof *r->turn);
    if (r->residual == NULL || r->dx == NULL || r->weight == NULL || r->errors == NULL ||
        r->turn == NULL)
        return fault_memory(f, "the time integration");
    metric_of(r->of.c->model, r->weight);
    for (int i = 0; i < STAGES; i++)
        TRY(allocate_stage(r, &r->stage[i], f));
    TRY(assemble_pattern_in_time(r->of.c->model, r->of.c->run->patterns, &pattern, f));
    TRY(sparse_alloc_like(pattern, &r->K, f));
    TRY(stages_alloc(&r->of.c->eq, r->of.masses, pattern, &r->S, f));
    TRY(factor_alloc_copies(&r->S.whole, STAGES, &r->factor, f));
    return factor_alloc_copies(pattern, 1, &r->single, f);
}

status radau_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const radau begin = {
        .base = {.order = 4, .degree = DENSE_OUTPUT_QUINTIC, .step = step, .free = release},
        .of = *request};
    radau *r = malloc(sizeof *r);
    *out = NULL;
    if (r == NULL)
        return fault_memory(f, "the time integration");
    memcpy(r, &begin, sizeof *r);
    *out = &r->base;
    const model_size size = model_sizes(request->c->model);
    r->free = size.free;
    r->all = size.free + size.driven;
    newton_convergence_start(request->c->options->criterion, model_leaves(request->c->model) != 0,
                             size.elements, &r->newton_convergence);
    radau_coefficients(r);
    return allocate(r, f);
}

static status radau_error(radau *r, const motion_state *from, double h, motion_state *room,
                          double *error, fault *f)
{
    const model *m = r->of.c->model;
    const double s = sqrt(6), l = 0.2748888295956773677478286,
                 e[STAGES] = {(-13 - 7 * s) / 3, (-13 + 7 * s) / 3, -1 / 3.0}, g = 1 / (l * h);
    model_linearisation lin = {.path = from->time, .K = &r->K, .residual = r->dx};
    double *still = room->algorithm;
    for (int c = 0; c < r->free; c++) {
        double positions = from->v[c], rates = 0;
        for (int i = 0; i < STAGES; i++) {
            positions += e[i] * r->stage[i].inc[c] / h;
            rates += e[i] * (r->stage[i].v[c] - from->v[c]) / h;
        }
        room->a[c] = -(rates + g * positions);
    }
    drive_at(&r->of.c->eq, from->state, from->time, NULL, NULL, room->a);
    memset(still, 0, (size_t)r->all * sizeof *still);
    const inertia_relation with = {g * g, 0, still};
    radau_damp_error(r, from, h, e, g, room->strain);
    feedback_take(&r->of.c->eq, from->state, from->v, from->time);
    TRY(linearise_state(&r->of.c->eq, &r->of.c->run->memory, from->state, &lin, f));
    inertia_subtract(m, r->of.masses, from->state, from->v, room->a, r->dx);
    inertia_add_tangent(&r->of.c->eq, r->of.masses, from->state, from->v, from->a, &with, &r->K);
    TRY(context_factor(r->of.c, r->single, &r->K, f));
    factor_solve(r->single, r->dx);
    double square = 0;
    for (int c = 0; c < r->free; c++)
        square += r->weight[c] * r->dx[c] * r->dx[c];
    *error = sqrt(square);
    const factor_counts counts = factor_count(r->single);
    r->of.c->run->counters.factorisations += counts.factorisations - r->counted_single;
    r->counted_single = counts.factorisations;
    return STATUS_OK;
}
