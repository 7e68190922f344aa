/* Linear buckling about the undeformed state: (K + lambda G) x = 0 with G from the stresses of the reference load. */
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/eigen.h"
#include "harness/analysis/analysis.h"
#include "harness/analysis/equilibrium.h"

/* Quadratic forms from the element strains. */
typedef struct forms {
    model *m;
    const double *sigma; /* prestress at factor 1 */
    double *x;           /* [free + driven] driven coordinates: zero */
    size_t free_count;
} forms;

static double stiffness_form(void *context, const double mode[])
{
    const forms *f = context;
    memcpy(f->x, mode, f->free_count * sizeof *f->x);
    return model_strain_energy2(f->m, f->x);
}

static double geometric_form(void *context, const double mode[])
{
    const forms *f = context;
    memcpy(f->x, mode, f->free_count * sizeof *f->x);
    return model_geometric_energy2(f->m, f->sigma, f->x);
}

/* Moves the modes into the outcome, with lambda = 1/mu. */
static void keep(eigen_side *side, int *count, double **value, double **mode)
{
    for (int i = 0; i < side->count; i++)
        side->mu[i] = 1 / side->mu[i];
    *count = side->count;
    *value = side->mu;
    *mode = side->mode;
    side->mu = side->mode = NULL;
}

/* How many eigenvalues of each sign the quantities ask for. */
static void wanted_of(const analysis_context *c, int analysis, eigen_problem *p)
{
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (q->kind != SCENE_CRITICAL_FACTOR || q->analysis != analysis)
            continue;
        int *side = q->sign > 0 ? &p->largest : &p->smallest;
        if (*side < q->order + 1)
            *side = q->order + 1;
    }
}

status analysis_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_STATIC)
        return equilibrium_buckling(c, analysis, o, f);
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
        memset(x, 0, (size_t)(size.free + size.driven) * sizeof *x);
        forms about = {c->model, sigma, x, (size_t)size.free};
        eigen_problem p = {.K = &s.K, .A = &G, .K_factor = s.factor, .sign = -1};
        p.K_energy = stiffness_form;
        p.A_energy = geometric_form;
        p.context = &about;
        wanted_of(c, analysis, &p);
        result = eigen_solve(&p, &e, f);
        model_counters(c->model)->solutions += e.solutions;
        model_counters(c->model)->factorisations += e.factorisations;
    }
    if (result == STATUS_OK) {
        keep(&e.positive, &o->positive, &o->value_positive, &o->mode_positive);
        keep(&e.negative, &o->negative, &o->value_negative, &o->mode_negative);
    }
    eigen_free(&e);
    linear_system_free(&s);
    sparse_free_values(&G);
    free(x);
    free(sigma);
    return result;
}
