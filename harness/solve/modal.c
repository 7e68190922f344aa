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

/* Strain energy from the element strains, and the shift's share. */
typedef struct forms {
    model *m;
    const sparse *M;
    double shift;  /* [1/s^2] */
    double *x, *y; /* [free + driven] driven coordinates: zero; [free] */
    int free_count;
} forms;

static double stiffness_form(void *context, const double mode[])
{
    const forms *f = context;
    double mass = 0;
    memcpy(f->x, mode, (size_t)f->free_count * sizeof *f->x);
    if (f->shift > 0)
        sparse_mul(f->M, mode, f->y);
    for (int i = 0; i < f->free_count && f->shift > 0; i++)
        mass += mode[i] * f->y[i];
    return model_strain_energy2(f->m, f->x) + f->shift * mass;
}

/* Moves the modes into the outcome, with omega^2 = 1/mu - shift; what is a rounding error of the shift moves as a rigid body. */
static void keep(const forms *about, eigen_side *side, analysis_outcome *o)
{
    for (int i = 0; i < side->count; i++) {
        const double square = 1 / side->mu[i] - about->shift;
        side->mu[i] = square <= 1e-9 * about->shift ? 0 : sqrt(square);
    }
    o->positive = side->count;
    o->value_positive = side->mu;
    o->mode_positive = side->mode;
    side->mu = side->mode = NULL;
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
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    linear_system s;
    sparse M = {0};
    eigen_result e = {0};
    forms about = {c->model, &M, 0, calloc(all, sizeof(double)), calloc(all, sizeof(double)), size.free};
    status result = linear_system_alloc(c, &s, f);
    const int singular = result == STATUS_SINGULAR;
    if (result == STATUS_OK || singular)
        result = sparse_alloc_like(&s.K, &M, f);
    if (result == STATUS_OK && (about.x == NULL || about.y == NULL))
        result = fault_set(f, STATUS_FAULT, "out of memory for modes");
    if (result == STATUS_OK)
        result = model_mass(c->model, NULL, &M, f);
    if (result == STATUS_OK && singular)
        result = shifted_system(c, &s, &M, &about.shift, f);
    if (result == STATUS_OK) {
        const eigen_problem p = {.K = &s.K,
                                 .A = &M,
                                 .K_factor = s.factor,
                                 .sign = 1,
                                 .largest = modes_wanted(c, analysis),
                                 .K_energy = stiffness_form,
                                 .context = &about};
        result = eigen_solve(&p, &e, f);
        model_counters(c->model)->solutions += e.solutions;
        model_counters(c->model)->factorisations += e.factorisations;
    }
    if (result == STATUS_OK)
        keep(&about, &e.positive, o);
    eigen_free(&e);
    linear_system_free(&s);
    sparse_free_values(&M);
    free(about.x);
    free(about.y);
    return result;
}
