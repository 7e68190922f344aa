/* Linear statics about the undeformed state. */
#include <stdlib.h>
#include <string.h>

#include "harness/analysis/analysis.h"

void count_condition(const analysis_context *c, factor *fa, const sparse *K)
{
    counters *n = model_counters(c->model);
    if (c->options->condition) {
        const double estimate = factor_condition(fa, K);
        n->condition = !(estimate <= n->condition) ? estimate : n->condition;
    }
}

status linear_system_alloc(analysis_context *c, linear_system *out, fault *f)
{
    const sparse *pattern;
    const double start = seconds_now();
    memset(out, 0, sizeof *out);
    status outcome = model_pattern(c->model, 0, &pattern, f);
    if (outcome == STATUS_OK)
        outcome = sparse_alloc_like(pattern, &out->K, f);
    if (outcome == STATUS_OK)
        outcome = factor_alloc(pattern, &out->factor, f);
    c->setup += seconds_now() - start;
    if (outcome == STATUS_OK)
        outcome = model_linear_stiffness(c->model, &out->K, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(out->factor, &out->K, f);
    if (outcome == STATUS_OK) {
        counters *n = model_counters(c->model);
        const factor_counts counts = factor_count(out->factor);
        n->factorisations++;
        n->factor_entries = counts.entries;
        n->factor_flops += counts.flops;
        count_condition(c, out->factor, &out->K);
    }
    return outcome;
}

void linear_system_free(linear_system *s)
{
    sparse_free_values(&s->K);
    factor_free(s->factor);
    memset(s, 0, sizeof *s);
}

/* Right-hand side less K x of the driven coordinates and of x itself, from element strains: its error does not grow with the mesh. */
static status residual_of(analysis_context *c, const double load[], const double x[], double sigma[], double r[], fault *f)
{
    const model_size size = model_sizes(c->model);
    const status outcome = model_linear_stresses(c->model, x, sigma, f);
    if (outcome != STATUS_OK)
        return outcome;
    model_linear_forces(c->model, sigma, r);
    for (int i = 0; i < size.free + size.driven; i++)
        r[i] = load[i] - r[i];
    return STATUS_OK;
}

/* Iterative refinement with residuals from the strains. */
enum { REFINEMENTS = 2 };

status linear_system_solve(analysis_context *c, linear_system *s, double x[], fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    double *load = calloc(all, sizeof *load), *r = calloc(all, sizeof *r);
    double *sigma = calloc((size_t)size.elements * (size_t)size.strains, sizeof *sigma);
    status outcome =
        load == NULL || r == NULL || sigma == NULL ? fault_set(f, STATUS_FAULT, "out of memory for a linear solution") : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = model_reference_load(c->model, load, f);
    memset(x, 0, all * sizeof *x - sizeof *x);
    if (outcome == STATUS_OK)
        model_drive(c->model, model_rest(c->model), 1, x);
    for (int i = 0; i <= REFINEMENTS && outcome == STATUS_OK; i++) {
        outcome = residual_of(c, load, x, sigma, r, f);
        if (outcome != STATUS_OK)
            break;
        factor_solve(s->factor, r);
        model_counters(c->model)->solutions++;
        for (int k = 0; k < size.free; k++)
            x[k] += r[k];
    }
    free(load);
    free(r);
    free(sigma);
    return outcome;
}

status analysis_linear(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    (void)analysis;
    const model_size size = model_sizes(c->model);
    linear_system s;
    status result = linear_system_alloc(c, &s, f);
    o->x = calloc((size_t)(size.free + size.driven) + 1, sizeof *o->x);
    if (result == STATUS_OK && o->x == NULL)
        result = fault_set(f, STATUS_FAULT, "out of memory for a linear solution");
    if (result == STATUS_OK)
        result = linear_system_solve(c, &s, o->x, f);
    linear_system_free(&s);
    return result;
}
