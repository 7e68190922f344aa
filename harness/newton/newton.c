/* One Newton iteration: assembles and factors the equations, solves them and applies the increment.
 * The equations are condensed per element, or solved as a dense system (newton=dense). */
#include "harness/newton/newton_impl.h"

#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

enum { MAX_ITERATIONS = 30 };

static status allocate_tangent(newton_run *n, int condense, fault *f)
{
    const sparse *pattern;
    if (condense && n->c->options->newton != NEWTON_DENSE)
        TRY(context_condensation(n->c, 0, NULL, &n->condensed, f));
    if (n->condensed != NULL)
        return condensation_as_factor(n->condensed, &n->factor, f);
    TRY(assemble_pattern_of_states(n->c->model, n->c->run->patterns, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &n->K, f));
    return assemble_factor(n->c->run->patterns, pattern, &n->factor, f);
}

static status allocate(newton_run *n, int condense, fault *f)
{
    const model *m = n->c->model;
    const size_t all = (size_t)n->all + 1;
    n->residual = calloc(all, sizeof *n->residual);
    n->dx = calloc((1 + MODEL_MAX_CONDITIONS) * all, sizeof *n->dx);
    n->weight = calloc(all, sizeof *n->weight);
    if (n->residual == NULL || n->dx == NULL || n->weight == NULL)
        return fault_memory(f, "a static solution");
    n->column = n->dx + n->all;
    metric_of(m, n->weight);
    TRY(allocate_tangent(n, condense, f));
    TRY(kinematics_state_alloc(m, &n->state, f));
    return kinematics_state_alloc(m, &n->backup, f);
}

status newton_alloc(analysis_context *c, int condense, newton_run *n, fault *f)
{
    const model_size size = model_sizes(c->model);
    const double start = clock_processor_seconds();
    memset(n, 0, sizeof *n);
    n->c = c;
    n->free = size.free;
    n->all = size.free + size.driven;
    newton_convergence_start(c->options->criterion, model_leaves(c->model) != 0, size.elements,
                             &n->newton_convergence);
    n->max_iterations =
        c->options->max_iterations > 0 ? c->options->max_iterations : MAX_ITERATIONS;
    const status outcome = allocate(n, condense, f);
    c->work->setup += clock_processor_seconds() - start;
    return outcome;
}

status newton_keep_driven(newton_run *n, fault *f)
{
    const sparse *pattern;
    if (n->whole.value != NULL)
        return STATUS_OK;
    TRY(assemble_pattern_of_states(n->c->model, n->c->run->patterns, 1, &pattern, f));
    return sparse_alloc_like(pattern, &n->whole, f);
}

void newton_free(newton_run *n)
{
    free(n->residual);
    free(n->dx);
    free(n->weight);
    free(n->dense);
    free(n->unknown);
    free(n->pivot);
    factor_free(n->factor);
    sparse_free_values(&n->K);
    sparse_free_values(&n->whole);
    kinematics_state_free(n->state);
    kinematics_state_free(n->backup);
}

/* Returns 1 if an unknown driver moves a coordinate with a condition. The motion must exceed the
 * rounding error of the driver's effects on all free coordinates. */
static int drives(const newton_run *n, int count, const model_condition condition[],
                  const double column[])
{
    const double round_off = 1e-12;
    double conditioned = 0, all = 0;
    for (int k = 0; k < n->free; k++)
        all = fmax(all, n->weight[k] * column[k] * column[k]);
    for (int r = 0; r < count; r++)
        conditioned =
            fmax(conditioned, n->weight[condition[r].coordinate] * column[condition[r].coordinate] *
                                  column[condition[r].coordinate]);
    return conditioned > round_off * round_off * all;
}

static status meet_conditions(newton_run *n, int count, const model_condition condition[], fault *f)
{
    double A[MODEL_MAX_CONDITIONS * MODEL_MAX_CONDITIONS], b[MODEL_MAX_CONDITIONS];
    int pivot[MODEL_MAX_CONDITIONS];
    int moved = 1;
    for (int c = 0; c < count; c++)
        moved &= drives(n, count, condition, n->column + c * n->all);
    for (int r = 0; r < count; r++) {
        b[r] = n->dx[condition[r].coordinate] - condition[r].increment;
        for (int c = 0; c < count; c++)
            A[r * count + c] = n->column[c * n->all + condition[r].coordinate];
    }
    if (!moved || dense_lu_regular(count, A, pivot) != 0)
        return fault_set(f, STATUS_SINGULAR,
                         "an unknown motion does not move the coordinate of its condition; name "
                         "another coordinate in such_that");
    dense_lu_solve(count, 1, A, pivot, b);
    for (int c = 0; c < count; c++) {
        for (int k = 0; k < n->free; k++)
            n->dx[k] -= n->column[c * n->all + k] * b[c];
        n->dx[condition[c].unknown] = b[c];
    }
    return STATUS_OK;
}

static status factor_tangent(newton_run *n, model_linearisation *lin, fault *f)
{
    if (n->whole.value != NULL)
        lin->K = &n->whole;
    if (n->condensed != NULL)
        lin->K = NULL;
    TRY(linearise_state(&n->c->eq, &n->c->run->memory, n->state, lin, f));
    if (n->whole.value != NULL)
        sparse_copy_leading(&n->whole, &n->K);
    if (n->condensed != NULL)
        TRY(condensation_at(n->condensed, n->state, lin->path, f));
    const status factored = n->condensed == NULL ? context_factor(n->c, n->factor, &n->K, f)
                                                 : context_factor_condensed(n->c, n->condensed, f);
    if (!n->constrained || factored != STATUS_SINGULAR || !factor_count(n->factor).lost)
        return factored;
    n->c->work->singular = 0;
    return STATUS_OK;
}

static status solve_condensed(newton_run *n, model_linearisation *lin, fault *f)
{
    phases *p = &n->c->run->phases;
    const status factored = factor_tangent(n, lin, f);
    phases_lap(p, PHASE_FACTORISATION);
    TRY(factored);
    memcpy(n->dx, n->residual, (size_t)n->free * sizeof *n->dx);
    factor_solve_many(n->factor, 1 + lin->conditions, n->all, n->dx);
    n->energy = fabs(dense_dot(n->free, n->residual, n->dx));
    const status met = meet_conditions(n, lin->conditions, lin->condition, f);
    phases_lap(p, PHASE_SOLUTION);
    return met;
}

static status solve_dense(newton_run *n, model_linearisation *lin, fault *f)
{
    const model *m = n->c->model;
    const size_t size = (size_t)uncondensed_size(m) + (size_t)lin->conditions;
    TRY(memory_check((double)size * (double)size * sizeof *n->dense,
                     "dense matrices of all unknowns at once", "give newton=mixed", f));
    if (n->dense == NULL) {
        n->dense = malloc(size * size * sizeof *n->dense);
        n->unknown = malloc(size * sizeof *n->unknown);
        n->pivot = malloc(size * sizeof *n->pivot);
    }
    if (n->dense == NULL || n->unknown == NULL || n->pivot == NULL)
        return fault_set(f, STATUS_FAULT,
                         "out of memory for a dense matrix of %zu unknowns; give newton=mixed",
                         size);
    model_linearisation parts = *lin;
    parts.K = NULL;
    parts.drive = NULL;
    parts.conditions = 0;
    TRY(linearise_state(&n->c->eq, &n->c->run->memory, n->state, &parts,
                        f)); /* data for advance_state */
    lin->incompatibility = parts.incompatibility;
    TRY(uncondensed_system(&n->c->eq, n->state, lin->path, n->dx, lin->conditions, lin->condition,
                           n->dense, n->unknown, n->residual, f));
    phases_lap(&n->c->run->phases, PHASE_ASSEMBLY);
    numerics_work_add(&(numerics_work){.solutions = 1});
    numerics_work_add_dense((double)size);
    const int singular = LAPACKE_dgesv(LAPACK_COL_MAJOR, (int)size, 1, n->dense, (int)size,
                                       n->pivot, n->unknown, (int)size) != 0;
    phases_lap(&n->c->run->phases, PHASE_FACTORISATION);
    n->c->work->singular = singular;
    if (singular)
        return fault_set(f, STATUS_SINGULAR, "the uncondensed system is singular");
    memcpy(n->dx, n->unknown, (size_t)n->free * sizeof *n->dx);
    for (int c = 0; c < lin->conditions; c++)
        n->dx[lin->condition[c].unknown] = n->unknown[size - (size_t)(lin->conditions - c)];
    return STATUS_OK;
}

static status direction(newton_run *n, double path, step_record *record, fault *f)
{
    counters *count = &n->c->run->counters;
    n->energy = NAN;
    memset(n->dx, 0, (size_t)n->all * sizeof *n->dx);
    loads_drive(&n->c->eq, n->state, path, n->dx);
    if (n->c->options->newton == NEWTON_DISPLACEMENT) {
        TRY(linearise_make_compatible(&n->c->eq, n->state, f));
    }
    model_condition condition[MODEL_MAX_CONDITIONS];
    const int conditions = loads_conditions(&n->c->eq, n->state, path, condition);
    model_linearisation lin = {.path = path,
                               .drive = n->dx,
                               .K = &n->K,
                               .residual = n->residual,
                               .conditions = conditions,
                               .condition = condition,
                               .column = n->column};
    TRY(n->c->options->newton == NEWTON_DENSE ? solve_dense(n, &lin, f)
                                              : solve_condensed(n, &lin, f));
    const factor_counts counts = factor_count(n->factor);
    count->factorisations +=
        n->c->options->newton == NEWTON_DENSE ? 1 : counts.factorisations - n->counted;
    n->counted = counts.factorisations;
    record->negative_pivots = counts.negative_pivots;
    record->incompatibility = lin.incompatibility;
    return STATUS_OK;
}

static int is_unstressed(const newton_run *n)
{
    const model *m = n->c->model;
    const int count = model_elements(m) * model_strains(m);
    if (!model_frees(m) || n->state->path != 0)
        return 0;
    for (int k = 0; k < count; k++)
        if (n->state->sigma[k] != 0)
            return 0;
    return 1;
}

/* Sets the stresses at `path` in the undeformed state, as if all nodes were fixed. */
static status prestress(newton_run *n, double path, fault *f)
{
    kinematics_state_copy(n->c->model, kinematics_rest(n->c->model), n->state);
    n->state->path = path;
    return linearise_make_compatible(&n->c->eq, n->state, f);
}

status newton_direction(newton_run *n, double path, step_record *record, fault *f)
{
    phases *p = &n->c->run->phases;
    phases_start(p);
    status outcome = direction(n, path, record, f);
    if (outcome == STATUS_SINGULAR && is_unstressed(n)) {
        outcome = prestress(n, path, f);
        if (outcome == STATUS_OK)
            outcome = direction(n, path, record, f);
    }
    phases_stop(p);
    return outcome;
}

void newton_advance(newton_run *n, double path, newton_correction *out)
{
    phases_start(&n->c->run->phases);
    out->size = advance_state(&n->c->eq, &n->c->run->memory, n->state, n->dx, path, &out->stress);
    phases_stop(&n->c->run->phases);
    out->at = path;
    out->energy = n->energy;
}

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    (void)iteration;
    newton_run *n = of;
    TRY(newton_direction(n, n->path, record, f));
    newton_advance(n, n->path, out);
    return STATUS_OK;
}

status newton_to(newton_run *n, double path, step_record *record, fault *f)
{
    const newton_use use = newton_on_path(n, n, correct);
    const int unstressed = is_unstressed(n);
    const step_record first = *record;
    n->path = path;
    const status outcome = newton_iterate(n->c, &use, &n->newton_convergence, record, f);
    if (!unstressed || (outcome != STATUS_SINGULAR && outcome != STATUS_NOT_CONVERGED))
        return outcome;
    history_drop_step(n->c->result, record);
    *record = first;
    TRY(prestress(n, path, f));
    return newton_iterate(n->c, &use, &n->newton_convergence, record, f);
}

int context_runs(const analysis_context *c, int analysis)
{
    return c->options->all_analyses || scene_reads(c->scene, analysis);
}

/* Returns the path parameter of the static state from which a motion starts; 1: the motion starts
 * from no such state. */
static double held_path(const analysis_context *c, int analysis)
{
    const int origin = scene_origin_of(c->scene, analysis);
    if (origin == analysis || origin == SCENE_NONE || !outcome_has_path(&c->outcomes[origin]))
        return 1;
    const outcome_path *path = outcome_path_of(&c->outcomes[origin]);
    return path->reached > 0 ? kinematics_state_path(path->state[path->reached - 1]) : 1;
}

analysis_context context_of(const analysis_context *c, int analysis)
{
    if (c->sides != NULL)
        c = c->sides[scene_is_perfect(c->scene, analysis)];
    analysis_context of = *c;
    of.eq = (equations){c->model, loading_of(c->model, analysis), c->run};
    of.eq.loading.held_path = held_path(c, analysis);
    return of;
}

analysis_context context_under(const analysis_context *c, int acting)
{
    analysis_context under = *c;
    under.eq.loading.acting = acting;
    return under;
}

analysis_context context_unloaded(const analysis_context *c)
{
    analysis_context none = *c;
    none.eq.loading.unloaded = 1;
    return none;
}

status context_factor(analysis_context *c, matrix_factor *fa, const sparse *K, fault *f)
{
    const status outcome = factor_numeric(fa, K, f);
    c->work->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_condensation(const analysis_context *c, int count, const int released[],
                            condensation **out, fault *f)
{
    *out = NULL;
    return c->options->condition
               ? STATUS_OK
               : condensation_alloc(&c->eq, c->options->condensed, count, released, out, f);
}

status context_factor_condensed(analysis_context *c, condensation *s, fault *f)
{
    const status outcome = condensation_factor(s, f);
    c->work->singular = outcome == STATUS_SINGULAR;
    return outcome;
}

status context_symmetric(const matrix_factor *fa, const char *what, fault *f)
{
    const factor_counts counts = factor_count(fa);
    return counts.negative_pivots >= 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%s require a symmetric tangent, but this tangent differs from its "
                           "transpose by %.1e of the diagonal (limit %.0e), because dead moments "
                           "about fixed axes and follower loads have no potential here; remove "
                           "these loads, or use a motion",
                           what, counts.asymmetry, FACTOR_SYMMETRIC_WITHIN);
}

void context_count_condition(const analysis_context *c, matrix_factor *fa, const sparse *K)
{
    counters *n = &c->run->counters;
    if (c->options->condition) {
        const double estimate = factor_condition(fa, K);
        n->condition = !(estimate <= n->condition) ? estimate : n->condition;
    }
}

void context_count_factorisations(const analysis_context *c, const matrix_factor *fa, long *counted)
{
    counters *n = &c->run->counters;
    const factor_counts counts = factor_count(fa);
    n->factorisations += counts.factorisations - *counted;
    *counted = counts.factorisations;
}

void context_count_eigen(const analysis_context *c, const eigen_result *e)
{
    counters *n = &c->run->counters;
    n->factorisations += e->factorisations;
}
