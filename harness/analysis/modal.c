/* Natural frequencies about the undeformed state, with the stresses of a linear analysis where one is followed: M x = (1/omega^2) K x, so that a mass matrix singular in the rotations does no harm. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/eigen.h"
#include "harness/analysis/analysis.h"
#include "harness/analysis/equilibrium.h"
#include "harness/analysis/singular.h"

int modal_wanted(const analysis_context *c, int analysis)
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
    const double *sigma; /* prestress [elements x strains], or NULL */
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
    const double prestress = f->sigma != NULL ? model_geometric_energy2(f->m, f->sigma, f->x) : 0;
    return model_strain_energy2(f->m, f->x) + prestress + f->shift * mass;
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
    return analysis_factor(c, s->factor, &s->K, f);
}

/* K += G of the stresses of the linear analysis that is followed; sigma is the caller's. */
static status add_prestress(analysis_context *c, int follows, linear_system *s, double **sigma, fault *f)
{
    const model_size size = model_sizes(c->model);
    sparse G = {0};
    *sigma = calloc((size_t)size.elements * (size_t)size.strains + 1, sizeof **sigma);
    status outcome = *sigma == NULL ? fault_set(f, STATUS_FAULT, "out of memory for prestress") : STATUS_OK;
    if (outcome == STATUS_OK && (c->scene->analysis[follows].kind != SCENE_LINEAR || c->outcomes[follows].x == NULL))
        outcome = fault_set(f, STATUS_REFUSED, "frequencies of a loaded structure follow a linear analysis that has been solved");
    if (outcome == STATUS_OK)
        outcome = model_linear_stresses(c->model, c->outcomes[follows].x, *sigma, f);
    if (outcome == STATUS_OK)
        outcome = sparse_alloc_like(&s->K, &G, f);
    if (outcome == STATUS_OK)
        outcome = model_geometric_stiffness(c->model, *sigma, &G, f);
    for (int i = 0; i < s->K.column[s->K.n] && outcome == STATUS_OK; i++)
        s->K.value[i] += G.value[i];
    sparse_free_values(&G);
    model_counters(c->model)->factorisations++;
    return outcome == STATUS_OK ? analysis_factor(c, s->factor, &s->K, f) : outcome;
}

status analysis_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_STATIC)
        return equilibrium_modal(c, analysis, o, f);
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    linear_system s;
    sparse M = {0};
    eigen_result e = {0};
    forms about = {c->model, &M, 0, calloc(all, sizeof(double)), calloc(all, sizeof(double)), size.free, NULL};
    double *sigma = NULL;
    status result = linear_system_alloc(c, &s, f);
    if (result == STATUS_OK && follows != SCENE_NONE)
        result = add_prestress(c, follows, &s, &sigma, f);
    about.sigma = sigma;
    const int singular = result == STATUS_SINGULAR;
    if (result == STATUS_OK || singular)
        result = sparse_alloc_like(&s.K, &M, f);
    if (result == STATUS_OK && (about.x == NULL || about.y == NULL))
        result = fault_set(f, STATUS_FAULT, "out of memory for modes");
    if (result == STATUS_OK)
        result = model_inertia(c->model, NULL, 0, &M, NULL, f);
    if (result == STATUS_OK && singular)
        result = shifted_system(c, &s, &M, &about.shift, f);
    if (result == STATUS_OK) {
        const eigen_problem p = {.K = &s.K,
                                 .A = &M,
                                 .K_factor = s.factor,
                                 .sign = 1,
                                 .largest = modal_wanted(c, analysis),
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
    free(sigma);
    return result;
}
