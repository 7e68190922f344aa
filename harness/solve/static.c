/* Nonlinear equilibrium along a path: Newton in coordinates, strains and stresses at once, with steps that adapt. */
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/solve/analysis.h"

enum { MAX_ITERATIONS = 30, EASY_ITERATIONS = 6, MAX_HALVINGS = 14 };
static const double default_criterion = 1e-8; /* largest correction, dimensionless: the next one would be its square */

typedef struct newton {
    analysis_context *c;
    model_state *state, *backup;
    sparse K;
    factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* of the uncondensed system, allocated when it is asked for */
    int *pivot;
    double *column; /* [conditions x (free + driven)] */
    double criterion;
    int max_iterations, free, all;
} newton;

static status newton_alloc(analysis_context *c, newton *n, fault *f)
{
    const model_size size = model_sizes(c->model);
    const sparse *pattern;
    const double start = seconds_now();
    memset(n, 0, sizeof *n);
    n->c = c;
    n->free = size.free;
    n->all = size.free + size.driven;
    n->criterion = c->options->criterion > 0 ? c->options->criterion : default_criterion;
    n->max_iterations = c->options->max_iterations > 0 ? c->options->max_iterations : MAX_ITERATIONS;
    n->residual = calloc((size_t)n->all + 1, sizeof *n->residual);
    n->dx = calloc((size_t)n->all + 1, sizeof *n->dx);
    n->column = calloc((size_t)(MODEL_MAX_CONDITIONS * n->all) + 1, sizeof *n->column);
    status outcome = n->residual == NULL || n->dx == NULL || n->column == NULL
                         ? fault_set(f, STATUS_FAULT, "out of memory for a static solution")
                         : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = model_pattern(c->model, 0, &pattern, f);
    if (outcome == STATUS_OK)
        outcome = sparse_alloc_like(pattern, &n->K, f);
    if (outcome == STATUS_OK)
        outcome = factor_alloc(pattern, &n->factor, f);
    if (outcome == STATUS_OK)
        outcome = model_state_alloc(c->model, &n->state, f);
    if (outcome == STATUS_OK)
        outcome = model_state_alloc(c->model, &n->backup, f);
    c->setup += seconds_now() - start;
    return outcome;
}

static void newton_free(newton *n)
{
    free(n->residual);
    free(n->dx);
    free(n->column);
    free(n->dense);
    free(n->unknown);
    free(n->pivot);
    sparse_free_values(&n->K);
    factor_free(n->factor);
    model_state_free(n->state);
    model_state_free(n->backup);
}

/* Unknown drivers: their increments make the conditions hold; dx of the free coordinates follows. */
static status meet_conditions(newton *n, int count, const model_condition condition[], fault *f)
{
    double A[MODEL_MAX_CONDITIONS * MODEL_MAX_CONDITIONS], b[MODEL_MAX_CONDITIONS];
    int pivot[MODEL_MAX_CONDITIONS];
    for (int c = 0; c < count; c++)
        factor_solve(n->factor, n->column + c * n->all);
    for (int r = 0; r < count; r++) {
        b[r] = n->dx[condition[r].coordinate] - condition[r].increment;
        for (int c = 0; c < count; c++)
            A[r * count + c] = n->column[c * n->all + condition[r].coordinate];
    }
    if (count > 0 && dense_lu(count, A, pivot) != 0)
        return fault_set(f, STATUS_SINGULAR, "an unknown driver does not move the coordinate of its condition");
    dense_lu_solve(count, 1, A, pivot, b);
    for (int c = 0; c < count; c++) {
        for (int k = 0; k < n->free; k++)
            n->dx[k] -= n->column[c * n->all + k] * b[c];
        n->dx[condition[c].unknown] = b[c];
    }
    model_counters(n->c->model)->solutions += count;
    return STATUS_OK;
}

/* dx of the condensed system. */
static status solve_condensed(newton *n, model_linearisation *lin, fault *f)
{
    status outcome = model_linearise(n->c->model, n->state, lin, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(n->factor, &n->K, f);
    if (outcome != STATUS_OK)
        return outcome;
    memcpy(n->dx, n->residual, (size_t)n->free * sizeof *n->dx);
    factor_solve(n->factor, n->dx);
    return meet_conditions(n, lin->conditions, lin->condition, f);
}

/* dx of the uncondensed system, by Gaussian elimination with partial pivoting (LAPACK). */
static status solve_dense(newton *n, model_linearisation *lin, fault *f)
{
    model *m = n->c->model;
    const size_t size = (size_t)model_full_size(m) + (size_t)lin->conditions;
    if (n->dense == NULL) {
        n->dense = malloc(size * size * sizeof *n->dense);
        n->unknown = malloc(size * sizeof *n->unknown);
        n->pivot = malloc(size * sizeof *n->pivot);
    }
    if (n->dense == NULL || n->unknown == NULL || n->pivot == NULL)
        return fault_set(f, STATUS_REFUSED, "%zu unknowns at once: more than memory allows for a dense matrix; give newton=mixed",
                         size);
    model_linearisation parts = *lin;
    parts.K = NULL;
    parts.drive = NULL;
    parts.conditions = 0;
    status outcome = model_linearise(m, n->state, &parts, f); /* what model_advance needs */
    lin->incompatibility = parts.incompatibility;
    if (outcome == STATUS_OK)
        outcome =
            model_full_system(m, n->state, lin->path, n->dx, lin->conditions, lin->condition, n->dense, n->unknown, n->residual, f);
    if (outcome != STATUS_OK)
        return outcome;
    if (LAPACKE_dgesv(LAPACK_COL_MAJOR, (int)size, 1, n->dense, (int)size, n->pivot, n->unknown, (int)size) != 0)
        return fault_set(f, STATUS_SINGULAR, "the uncondensed system is singular");
    memcpy(n->dx, n->unknown, (size_t)n->free * sizeof *n->dx);
    for (int c = 0; c < lin->conditions; c++)
        n->dx[lin->condition[c].unknown] = n->unknown[size - (size_t)(lin->conditions - c)];
    return STATUS_OK;
}

/* One iteration towards `path`; *correction: dimensionless size of what changed. */
static status iterate(newton *n, double path, double *correction, step_record *record, fault *f)
{
    model *m = n->c->model;
    counters *count = model_counters(m);
    memset(n->dx, 0, (size_t)n->all * sizeof *n->dx);
    model_drive(m, n->state, path, n->dx);
    if (n->c->options->newton == SOLVE_DISPLACEMENT) {
        const status compatible = model_make_compatible(m, n->state, f);
        if (compatible != STATUS_OK)
            return compatible;
    }
    model_condition condition[MODEL_MAX_CONDITIONS];
    const int conditions = model_conditions(m, n->state, path, condition);
    model_linearisation lin = {.path = path,
                               .drive = n->dx,
                               .K = &n->K,
                               .residual = n->residual,
                               .conditions = conditions,
                               .condition = condition,
                               .column = n->column};
    const status outcome = n->c->options->newton == SOLVE_DENSE ? solve_dense(n, &lin, f) : solve_condensed(n, &lin, f);
    if (outcome != STATUS_OK)
        return outcome;
    const factor_counts counts = factor_count(n->factor);
    *correction = model_advance(m, n->state, n->dx, path);
    count->iterations++;
    count->factorisations++;
    count->solutions++;
    count->factor_entries = counts.entries;
    count->factor_flops += counts.flops;
    record->iterations++;
    record->negative_pivots = counts.negative_pivots;
    record->incompatibility = lin.incompatibility;
    record->correction = *correction;
    return isfinite(*correction) ? STATUS_OK : fault_set(f, STATUS_NOT_CONVERGED, "the corrections are not finite");
}

/* A formulation whose strains are sines of the turn can converge to a state it cannot tell from the right one. */
static status judge_turns(const newton *n, double path, fault *f)
{
    const double quarter = 1.57079632679489661923;
    int element = 0;
    if (!(model_limits(n->c->model) & LIMIT_QUARTER_TURN) || model_largest_turn(n->c->model, n->state, &element) < quarter)
        return STATUS_OK;
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d is turned by more than a quarter turn at path %g: use more elements or smaller steps", element,
                     path);
}

/* Newton to `path`: converged, or NOT_CONVERGED with the reason. */
static status step_to(newton *n, double path, step_record *record, fault *f)
{
    const double wild = 4; /* a correction of several radians or lengths leads nowhere */
    double last = INFINITY;
    int growing = 0;
    for (int i = 0; i < n->max_iterations; i++) {
        double correction;
        const status outcome = iterate(n, path, &correction, record, f);
        if (outcome != STATUS_OK)
            return outcome;
        if (correction <= n->criterion)
            return judge_turns(n, path, f);
        growing = correction > last && i > 1 ? growing + 1 : 0;
        if (correction > wild * 4 || (i > 2 && correction > wild) || growing >= 4)
            return fault_set(f, STATUS_NOT_CONVERGED, "Newton diverged at path %g: correction %.1e in iteration %d", path,
                             correction, i + 1);
        last = correction;
    }
    return fault_set(f, STATUS_NOT_CONVERGED, "Newton did not converge in %d iterations at path %g: correction %.1e",
                     n->max_iterations, path, last);
}

static status add_record(solve_result *r, const step_record *record, fault *f)
{
    step_record *more = realloc(r->step, ((size_t)r->steps + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for step records");
    r->step = more;
    r->step[r->steps++] = *record;
    return STATUS_OK;
}

/* From the present path to `target` in steps that halve when Newton fails and double when it is easy. */
static status walk_to(newton *n, double target, double *increment, fault *f)
{
    counters *count = model_counters(n->c->model);
    int halvings = 0, rejected = 0;
    while (model_state_path(n->state) < target) {
        const double from = model_state_path(n->state);
        const int last = from + *increment * (1 + 1e-9) >= target;
        const double to = last ? target : from + *increment;
        step_record record = {.path = to, .increment = to - from, .rejected = rejected};
        model_state_copy(n->c->model, n->state, n->backup);
        const status outcome = step_to(n, to, &record, f);
        if (outcome == STATUS_OK) {
            const status stored = add_record(n->c->result, &record, f);
            if (stored != STATUS_OK)
                return stored;
            count->steps++;
            rejected = 0;
            if (record.iterations <= EASY_ITERATIONS && !last)
                *increment *= 2;
            continue;
        }
        if (outcome == STATUS_FAULT || ++halvings > MAX_HALVINGS)
            return outcome == STATUS_SINGULAR || outcome == STATUS_FAULT ? outcome : STATUS_NOT_CONVERGED;
        model_state_copy(n->c->model, n->backup, n->state);
        count->rejected_steps++;
        rejected++;
        *increment = (to - from) / 2;
    }
    return STATUS_OK;
}

static status keep_state(newton *n, analysis_outcome *o, double path, fault *f)
{
    const status stored = model_state_alloc(n->c->model, &o->state[o->reached], f);
    if (stored != STATUS_OK)
        return stored;
    model_state_copy(n->c->model, n->state, o->state[o->reached]);
    o->path[o->reached++] = path;
    return STATUS_OK;
}

status analysis_static(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    newton n;
    status result = newton_alloc(c, &n, f);
    o->stations = a->stations;
    o->path = calloc((size_t)a->stations + 1, sizeof *o->path);
    o->state = calloc((size_t)a->stations + 1, sizeof(model_state *));
    if (o->path == NULL || o->state == NULL)
        result = fault_set(f, STATUS_FAULT, "out of memory for a path");
    const int steps = c->options->steps_between > 0 ? c->options->steps_between : a->steps_between > 0 ? a->steps_between : 1;
    for (int i = 0; i < a->stations && result == STATUS_OK; i++) {
        const double from = i > 0 ? a->path[i - 1] : 0;
        double increment = (a->path[i] - from) / steps;
        result = walk_to(&n, a->path[i], &increment, f);
        if (result == STATUS_OK)
            result = keep_state(&n, o, a->path[i], f);
    }
    newton_free(&n);
    return result;
}
