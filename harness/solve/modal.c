/* Natural frequencies about the undeformed state: M x = (1/omega^2) K x, so that a mass matrix singular in the rotations does no harm. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/solve/analysis.h"
#include "harness/solve/eigen.h"

static int modes_wanted(const analysis_context *c, int analysis)
{
    const int others = 6; /* axial modes and other families lie between */
    int wanted = c->scene->analysis[analysis].wanted;
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (q->kind == SCENE_FREQUENCY && q->analysis == analysis && wanted < q->order + 1)
            wanted = q->order + 1;
    }
    return wanted + others;
}

static int by_frequency(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* omega^2 = x^T K x/x^T M x with x^T K x from the element strains; sorted with their modes. */
static status keep(analysis_context *c, const sparse *M, double shift, eigen_result *e, analysis_outcome *o, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t n = (size_t)size.free, all = (size_t)(size.free + size.driven) + 1;
    double *x = calloc(all, sizeof *x), *Mx = calloc(n + 1, sizeof *Mx), *pair = calloc(2 * (size_t)e->positive + 2, sizeof *pair);
    double *modes = calloc((size_t)(e->positive + 1) * n + 1, sizeof *modes);
    o->value_positive = calloc((size_t)e->positive + 1, sizeof *o->value_positive);
    o->mode_positive = modes;
    if (x == NULL || Mx == NULL || pair == NULL || modes == NULL || o->value_positive == NULL) {
        free(x);
        free(Mx);
        free(pair);
        return fault_set(f, STATUS_FAULT, "out of memory for modes");
    }
    for (int i = 0; i < e->positive; i++) {
        const double *mode = e->mode_positive + (size_t)i * n;
        double mass = 0;
        memcpy(x, mode, n * sizeof *x);
        sparse_mul(M, mode, Mx);
        for (size_t k = 0; k < n; k++)
            mass += mode[k] * Mx[k];
        const double stiffness = model_strain_energy2(c->model, x);
        pair[2 * i] = stiffness <= 1e-9 * shift * mass ? 0 : sqrt(stiffness / mass);
        pair[2 * i + 1] = i;
    }
    qsort(pair, (size_t)e->positive, 2 * sizeof *pair, by_frequency);
    o->positive = e->positive;
    for (int i = 0; i < e->positive; i++) {
        o->value_positive[i] = pair[2 * i];
        memcpy(modes + (size_t)i * n, e->mode_positive + (size_t)pair[2 * i + 1] * n, n * sizeof *modes);
    }
    free(x);
    free(Mx);
    free(pair);
    return STATUS_OK;
}

/* A structure that is not held has K singular: K + shift M is not. */
static status shifted_system(analysis_context *c, linear_system *s, const sparse *M, double *shift, fault *f)
{
    double k = 0, mass = 0;
    for (int j = 0; j < M->n; j++) {
        k += *(s->K.value + s->K.column[j + 1] - 1);
        mass += *(M->value + M->column[j + 1] - 1);
    }
    *shift = 1e-9 * k / mass;
    for (int i = 0; i < M->column[M->n]; i++)
        s->K.value[i] += *shift * M->value[i];
    model_counters(c->model)->factorisations++;
    return factor_numeric(s->factor, &s->K, f);
}

status analysis_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    linear_system s;
    sparse M = {0};
    eigen_result e = {0};
    double shift = 0;
    status result = linear_system_alloc(c, &s, f);
    const int singular = result == STATUS_SINGULAR;
    if (result == STATUS_OK || singular)
        result = sparse_alloc_like(&s.K, &M, f);
    if (result == STATUS_OK)
        result = model_mass(c->model, NULL, &M, f);
    if (result == STATUS_OK && singular)
        result = shifted_system(c, &s, &M, &shift, f);
    if (result == STATUS_OK) {
        const eigen_problem p = {.K = &s.K, .A = &M, .K_factor = s.factor, .sign = 1, .largest = modes_wanted(c, analysis)};
        result = eigen_solve(&p, &e, f);
        model_counters(c->model)->solutions += e.solutions;
    }
    if (result == STATUS_OK)
        result = keep(c, &M, shift, &e, o, f);
    eigen_free(&e);
    linear_system_free(&s);
    sparse_free_values(&M);
    return result;
}
