/* Linear buckling about the undeformed state: (K + lambda G) x = 0 with G from the stresses of the reference load. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/solve/analysis.h"
#include "harness/solve/eigen.h"

/* lambda = -x^T K x/x^T G x from the element strains. */
static double quotient(model *m, const double sigma[], int free_count, int all, const double mode[], double *x)
{
    memset(x, 0, (size_t)all * sizeof *x);
    memcpy(x, mode, (size_t)free_count * sizeof *x);
    return -model_strain_energy2(m, x) / model_geometric_energy2(m, sigma, x);
}

static void sort_by_size(int count, double value[], double mode[], int n, double *swap)
{
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && fabs(value[k]) < fabs(value[k - 1]); k--) {
            const double v = value[k];
            value[k] = value[k - 1];
            value[k - 1] = v;
            const size_t bytes = (size_t)n * sizeof *mode;
            memcpy(swap, mode + (size_t)k * (size_t)n, bytes);
            memcpy(mode + (size_t)k * (size_t)n, mode + (size_t)(k - 1) * (size_t)n, bytes);
            memcpy(mode + (size_t)(k - 1) * (size_t)n, swap, bytes);
        }
}

/* Moves the eigenpairs into the outcome. */
static status keep(analysis_context *c, const double sigma[], eigen_result *e, analysis_outcome *o, fault *f)
{
    const model_size size = model_sizes(c->model);
    const int all = size.free + size.driven;
    double *x = malloc(((size_t)all + 1) * sizeof *x);
    if (x == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for buckling modes");
    o->positive = e->positive;
    o->negative = e->negative;
    o->value_positive = e->mu_positive;
    o->value_negative = e->mu_negative;
    o->mode_positive = e->mode_positive;
    o->mode_negative = e->mode_negative;
    memset(e, 0, sizeof *e);
    for (int i = 0; i < o->positive; i++)
        o->value_positive[i] = quotient(c->model, sigma, size.free, all, o->mode_positive + (size_t)i * (size_t)size.free, x);
    for (int i = 0; i < o->negative; i++)
        o->value_negative[i] = quotient(c->model, sigma, size.free, all, o->mode_negative + (size_t)i * (size_t)size.free, x);
    sort_by_size(o->positive, o->value_positive, o->mode_positive, size.free, x);
    sort_by_size(o->negative, o->value_negative, o->mode_negative, size.free, x);
    free(x);
    return STATUS_OK;
}

/* How many eigenvalues of each sign the quantities ask for. */
static void wanted_of(const analysis_context *c, int analysis, eigen_problem *p)
{
    const int spare = 2; /* so that a cluster is not cut in two */
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (q->kind != SCENE_CRITICAL_FACTOR || q->analysis != analysis)
            continue;
        int *side = q->sign > 0 ? &p->largest : &p->smallest;
        if (*side < q->order + 1 + spare)
            *side = q->order + 1 + spare;
    }
}

status analysis_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const model_size size = model_sizes(c->model);
    linear_system s;
    sparse G = {0};
    eigen_result e = {0};
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    double *sigma = calloc((size_t)size.elements * (size_t)size.strains, sizeof *sigma);
    status result = linear_system_alloc(c, &s, f);
    if (x == NULL || sigma == NULL)
        result = fault_set(f, STATUS_FAULT, "out of memory for prestress");
    if (result == STATUS_OK && !s.K.symmetric)
        result = fault_set(f, STATUS_REFUSED, "linear buckling needs a symmetric stiffness matrix");
    if (result == STATUS_OK)
        result = linear_system_solve(c, &s, x, f);
    if (result == STATUS_OK)
        result = model_linear_stresses(c->model, x, sigma, f);
    if (result == STATUS_OK)
        result = sparse_alloc_like(&s.K, &G, f);
    if (result == STATUS_OK)
        result = model_geometric_stiffness(c->model, sigma, &G, f);
    if (result == STATUS_OK) {
        eigen_problem p = {.K = &s.K, .A = &G, .K_factor = s.factor, .sign = -1};
        wanted_of(c, analysis, &p);
        result = eigen_solve(&p, &e, f);
        model_counters(c->model)->solutions += e.solutions;
    }
    if (result == STATUS_OK)
        result = keep(c, sigma, &e, o, f);
    eigen_free(&e);
    linear_system_free(&s);
    sparse_free_values(&G);
    free(x);
    free(sigma);
    return result;
}
