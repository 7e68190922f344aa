#include "harness/solver/linear_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/clock.h"
#include "harness/model/assemble.h"
#include "harness/model/kinematics.h"
#include "harness/model/linear.h"
#include "harness/model/loads.h"
#include "harness/model/metric.h"
#include "harness/solver/context.h"

static status allocate(const analysis_context *c, linear_system *out, fault *f)
{
    const sparse *pattern;
    TRY(model_pattern(c->model, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &out->K, f));
    return factor_alloc(pattern, &out->factor, f);
}

status linear_system_alloc(analysis_context *c, linear_system *out, fault *f)
{
    const double start = clock_processor_seconds();
    memset(out, 0, sizeof *out);
    const status allocated = allocate(c, out, f);
    c->setup += clock_processor_seconds() - start;
    TRY(allocated);
    TRY(model_linear_stiffness(c->model, &out->K, f));
    TRY(context_factor(c, out->factor, &out->K, f));
    counters *n = model_counters(c->model);
    const factor_counts counts = factor_count(out->factor);
    n->factorisations++;
    n->factor_entries = counts.entries;
    n->factor_flops += counts.flops;
    context_count_condition(c, out->factor, &out->K);
    return STATUS_OK;
}

void linear_system_free(linear_system *s)
{
    sparse_free_values(&s->K);
    factor_free(s->factor);
    memset(s, 0, sizeof *s);
}

/* Right-hand side less K x of the driven coordinates and of x itself, from element strains: its
 * error does not grow with the mesh. */
static status residual_of(analysis_context *c, const double load[], const double x[],
                          double sigma[], double r[], fault *f)
{
    const model_size size = model_sizes(c->model);
    TRY(model_linear_stresses(c->model, x, sigma, f));
    model_linear_forces(c->model, sigma, r);
    for (int i = 0; i < size.free + size.driven; i++)
        r[i] = load[i] - r[i];
    return STATUS_OK;
}

/* Iterative refinement with residuals from the strains: twice always, and on as long as it helps
 * where digits are still missing. */
enum { REFINEMENTS = 2, MOST_REFINEMENTS = 30 };
/* Of a correction beside the solution: what ends the refinement, and what it may settle at where
 * round-off keeps it from going on, as in a slender bar pushed along an oblique axis. */
static const double sure_digits = 1e-9, enough_digits = 1e-6;

static double weighted_size(int n, const double weight[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += weight[i] * x[i] * x[i];
    return sqrt(sum);
}

typedef struct refinement {
    double *load, *r, *weight; /* [free + driven] */
    double *sigma;             /* [elements x strains] */
} refinement;

static status refinement_alloc(analysis_context *c, refinement *w, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    w->load = calloc(3 * all, sizeof *w->load);
    w->sigma = calloc((size_t)size.elements * (size_t)size.strains + 1, sizeof *w->sigma);
    if (w->load == NULL || w->sigma == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a linear solution");
    w->r = w->load + all;
    w->weight = w->r + all;
    model_metric(c->model, w->weight);
    return model_reference_load(c->model, w->load, f);
}

static status refine(analysis_context *c, linear_system *s, refinement *w, double x[], fault *f)
{
    const int n = model_sizes(c->model).free;
    double last = INFINITY;
    for (int i = 0; i <= MOST_REFINEMENTS; i++) {
        TRY(residual_of(c, w->load, x, w->sigma, w->r, f));
        factor_solve(s->factor, w->r);
        model_counters(c->model)->solutions++;
        for (int k = 0; k < n; k++)
            x[k] += w->r[k];
        const double correction =
            weighted_size(n, w->weight, w->r) / weighted_size(n, w->weight, x);
        if (i >= REFINEMENTS && !(correction > sure_digits))
            return STATUS_OK;
        if (i > REFINEMENTS && !(correction < last / 2)) {
            if (correction <= enough_digits)
                return STATUS_OK;
            break;
        }
        last = correction;
    }
    c->singular = 1;
    return fault_set(f, STATUS_SINGULAR, "the linear solution is lost in round-off");
}

/* With what linear_system_solve frees. */
static status solve(analysis_context *c, linear_system *s, refinement *w, double x[], fault *f)
{
    const model_size size = model_sizes(c->model);
    memset(x, 0, (size_t)(size.free + size.driven) * sizeof *x);
    TRY(refinement_alloc(c, w, f));
    model_drive(c->model, model_rest(c->model), 1, x);
    return refine(c, s, w, x, f);
}

status linear_system_solve(analysis_context *c, linear_system *s, double x[], fault *f)
{
    refinement w = {0};
    const status outcome = solve(c, s, &w, x, f);
    free(w.load);
    free(w.sigma);
    return outcome;
}
