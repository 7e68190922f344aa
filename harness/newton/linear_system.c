#include "harness/newton/linear_system.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/context.h"
#include "harness/newton/linear.h"
#include "harness/newton/loads.h"
#include "harness/newton/refinement.h"
#include "harness/numerics/numerics.h"

static status allocate(const analysis_context *c, linear_system *out, fault *f)
{
    const sparse *pattern;
    TRY(assemble_pattern(c->model, c->run->patterns, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &out->K, f));
    return factor_alloc(pattern, &out->factor, f);
}

status linear_system_alloc(analysis_context *c, linear_system *out, fault *f)
{
    const double start = clock_processor_seconds();
    memset(out, 0, sizeof *out);
    const status allocated = allocate(c, out, f);
    c->work->setup += clock_processor_seconds() - start;
    TRY(allocated);
    TRY(linear_stiffness(&c->eq, &out->K, f));
    TRY(context_factor(c, out->factor, &out->K, f));
    counters *n = &c->run->counters;
    const factor_counts counts = factor_count(out->factor);
    n->factorisations++;
    n->factor_entries = counts.entries;
    n->factor_flops += counts.flops;
    context_count_condition(c, out->factor, &out->K);
    return counts.negative_pivots > 0
               ? fault_set(f, STATUS_NOT_CONVERGED,
                           "%s: %d negative pivot%s of the stiffness at rest, where nothing is "
                           "loaded: elements move against their forces; use more elements or "
                           "another formulation",
                           model_formulation(c->model), counts.negative_pivots,
                           counts.negative_pivots > 1 ? "s" : "")
               : STATUS_OK;
}

void linear_system_free(linear_system *s)
{
    sparse_free_values(&s->K);
    factor_free(s->factor);
    memset(s, 0, sizeof *s);
}

/* Right-hand side less K x of the driven coordinates and of x itself and less the forces of initial
 * strains, from element strains: its error does not grow with the mesh. */
static status residual_of(analysis_context *c, const double load[], const double x[],
                          double sigma[], double r[], fault *f)
{
    const model_size size = model_sizes(c->model);
    TRY(linear_whole_stresses(&c->eq, x, sigma, f));
    linear_forces(&c->eq, sigma, r);
    for (int i = 0; i < size.free + size.driven; i++)
        r[i] = load[i] - r[i];
    return STATUS_OK;
}

typedef struct system_workspace {
    double *load, *r, *weight, *shaken; /* [free + driven] */
    double *sigma;                      /* [elements x strains] */
} system_workspace;

static status workspace_alloc(analysis_context *c, double path, system_workspace *w, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    w->load = calloc(4 * all, sizeof *w->load);
    w->sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *w->sigma);
    if (w->load == NULL || w->sigma == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a linear solution");
    w->r = w->load + all;
    w->weight = w->r + all;
    w->shaken = w->weight + all;
    metric_of(c->model, w->weight);
    loads_reference(&c->eq, path, w->load);
    return STATUS_OK;
}

/* Initial strains that are held back leave no displacement to compare with but themselves. */
static double part_of(const analysis_context *c, const system_workspace *w, const double change[],
                      const double x[])
{
    return refinement_part(model_sizes(c->model).free, w->weight, change, x,
                           linear_initial(c->model));
}

/* x += K^-1 (load - K x); the size of what was added beside x. */
static status correct(analysis_context *c, linear_system *s, system_workspace *w, double x[],
                      double *correction, fault *f)
{
    const int n = model_sizes(c->model).free;
    TRY(residual_of(c, w->load, x, w->sigma, w->r, f));
    factor_solve(s->factor, w->r);
    for (int k = 0; k < n; k++)
        x[k] += w->r[k];
    *correction = part_of(c, w, w->r, x);
    return STATUS_OK;
}

/* A correction may vanish by chance, of one element above all: how far x, shaken in its last digits
 * and corrected, ends from where it was. Not counted as work. */
static status shake(analysis_context *c, linear_system *s, system_workspace *w, const double x[],
                    double *change, fault *f)
{
    const model_size size = model_sizes(c->model);
    double correction;
    memcpy(w->shaken, x, (size_t)(size.free + size.driven) * sizeof *x);
    for (int k = 0; k < size.free; k++)
        w->shaken[k] *= 1 + (k * 7 % 3 - 1) * 2 * DBL_EPSILON;
    TRY(correct(c, s, w, w->shaken, &correction, f));
    for (int k = 0; k < size.free; k++)
        w->shaken[k] -= x[k];
    *change = part_of(c, w, w->shaken, x);
    return STATUS_OK;
}

static status refine(analysis_context *c, linear_system *s, system_workspace *w, double x[],
                     fault *f)
{
    refinement_state state = REFINEMENT_GOES_ON;
    solution_refinement r = {0};
    double correction;
    while (state == REFINEMENT_GOES_ON) {
        TRY(correct(c, s, w, x, &correction, f));
        c->run->counters.solutions++;
        state = refinement_next(&r, correction);
    }
    if (state == REFINEMENT_ENDS) {
        TRY(shake(c, s, w, x, &correction, f));
        state = refinement_judge(&r, correction);
    }
    return state == REFINEMENT_ENDS ? STATUS_OK : refinement_refuse(&r, "the linear solution", f);
}

/* With what linear_system_solve frees. */
static status solve(analysis_context *c, linear_system *s, double path, system_workspace *w,
                    double x[], fault *f)
{
    const model_size size = model_sizes(c->model);
    memset(x, 0, (size_t)(size.free + size.driven) * sizeof *x);
    TRY(workspace_alloc(c, path, w, f));
    loads_drive(&c->eq, kinematics_rest(c->model), path, x);
    return refine(c, s, w, x, f);
}

status linear_system_solve(analysis_context *c, linear_system *s, double path, double x[], fault *f)
{
    system_workspace w = {0};
    const status outcome = solve(c, s, path, &w, x, f);
    free(w.load);
    free(w.sigma);
    return outcome;
}
