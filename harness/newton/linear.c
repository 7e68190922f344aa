/* Linear analyses about the undeformed state. Quadratic forms are computed from the strains,
 * because on fine meshes products with assembled matrices lose accuracy by cancellation. */
#include "harness/newton/newton_impl.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

static status stiffness_elements(const equations *eq, sparse *K, fault *f)
{
    const model *m = eq->m;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    sparse_zero(K);
    for (int i = 0; i < model_elements(m); i++) {
        undeformed_element l;
        double k[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        TRY(undeformed_of(eq, i, &l, f));
        memset(k, 0, (size_t)(model_own_coordinates(m) * model_own_coordinates(m)) * sizeof *k);
        dense_add_congruence(model_strains(m), model_own_coordinates(m), l.J, l.C, k, work);
        eliminate_matrix(m, kinematics_rest(m), model_element(m, i), NULL, k);
        assemble_matrix(assemble_of(eq->run->patterns, K), i, k, K);
    }
    return STATUS_OK;
}

status linear_stiffness(const equations *eq, sparse *K, fault *f)
{
    const model *m = eq->m;
    undeformed_begin(eq);
    const status outcome = stiffness_elements(eq, K, f);
    ahead_end(eq);
    if (outcome == STATUS_OK)
        linear_springs_stiffness(m, K);
    return outcome;
}

static void linear_strains(const model *m, int i, const undeformed_element *l, const double x[],
                           double e[])
{
    double local[ELEMENT_MAX_COORDINATES];
    kinematics_local(m, kinematics_rest(m), model_element(m, i), x, local);
    dense_mul_vec(model_strains(m), model_own_coordinates(m), l->J, local, e);
}

status linear_stresses(const equations *eq, const double x[], double sigma[], fault *f)
{
    const model *m = eq->m;
    for (int i = 0; i < model_elements(m); i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS];
        TRY(undeformed_of(eq, i, &l, f));
        linear_strains(m, i, &l, x, e);
        dense_mul_vec(model_strains(m), model_strains(m), l.C, e,
                      &sigma[(size_t)i * (size_t)model_strains(m)]);
    }
    linear_springs_stresses(m, x, sigma + model_elements(m) * model_strains(m));
    return STATUS_OK;
}

double linear_initial(const model *m)
{
    double largest = 0;
    for (int i = 0; i < model_kinds(m); i++) {
        const mesh_kind *k = model_kind(m, i);
        largest = fmax(largest, vec3_norm(k->strain) + fabs(k->free[0]) +
                                    hypot(k->free[1], k->free[2]) * model_length(m));
    }
    return largest;
}

/* Adds to sigma the stresses that the temperatures at `path` cause in elements with fixed nodes,
 * multiplied by `times`. */
static status add_free(const equations *eq, double path, double times, double sigma[], fault *f)
{
    const model *m = eq->m;
    for (int i = 0; i < model_elements(m) && model_frees(m); i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS], own[ELEMENT_MAX_STRAINS];
        TRY(undeformed_of(eq, i, &l, f));
        free_strain_linear(eq, i, path, e);
        dense_mul_vec(model_strains(m), model_strains(m), l.C, e, own);
        for (int k = 0; k < model_strains(m); k++)
            sigma[(size_t)i * (size_t)model_strains(m) + (size_t)k] -= times * own[k];
    }
    return STATUS_OK;
}

status linear_growing_stresses(const equations *eq, const double x[], double path, double sigma[],
                               fault *f)
{
    TRY(linear_stresses(eq, x, sigma, f));
    TRY(add_free(eq, 0, -1, sigma, f));
    return add_free(eq, path, 1, sigma, f);
}

status linear_whole_stresses(const equations *eq, const double x[], double path, double sigma[],
                             fault *f)
{
    const model *m = eq->m;
    TRY(linear_stresses(eq, x, sigma, f));
    TRY(add_free(eq, path, 1, sigma, f));
    for (int i = 0; i < model_elements(m) && linear_initial(m) > 0; i++) {
        undeformed_element l;
        TRY(undeformed_of(eq, i, &l, f));
        for (int k = 0; l.initial != NULL && k < model_strains(m); k++)
            sigma[(size_t)i * (size_t)model_strains(m) + (size_t)k] += l.initial[k];
    }
    return STATUS_OK;
}

void linear_forces(const equations *eq, const double sigma[], double f[])
{
    const model *m = eq->m;
    ahead_strains(eq, kinematics_rest(m), AHEAD_J, NULL);
    memset(f, 0, (size_t)model_all_coordinates(m) * sizeof *f);
    for (int i = 0; i < model_elements(m); i++) {
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[MODEL_MAX_COORDINATES] = {0};
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, kinematics_rest(m), model_element(m, i), x);
        ahead_strain(
            eq, i, x,
            &(strain_output){.J = J, .history = model_history_of(m, kinematics_rest(m), i)});
        eq->run->counters.strain_evaluations++;
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                &sigma[(size_t)i * (size_t)model_strains(m)], force);
        eliminate_forces(m, kinematics_rest(m), model_element(m, i), force);
        assemble_vector(model_element(m, i), force, f);
    }
    ahead_end(eq);
    linear_springs_forces(m, sigma + model_elements(m) * model_strains(m), f);
}

/* Computes H = sum sigma_i H_i, G(sigma) and J of an undeformed element in element coordinates. */
static void geometric_of(const equations *eq, int i, const double sigma[], double H[], double G[],
                         double J[])
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    const element_data *data = model_kind(m, el->kind)->data;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), el, x);
    ahead_strain(
        eq, i, x,
        &(strain_output){
            .J = J, .s = sigma, .H = H, .history = model_history_of(m, kinematics_rest(m), i)});
    if (model_type(m)->geometric != NULL)
        model_type(m)->geometric(data, sigma, G);
    else
        memset(G, 0, (size_t)(model_strains(m) * model_strains(m)) * sizeof *G);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.geometric_evaluations++;
}

status linear_geometric_stiffness(const equations *eq, const double sigma[], double path,
                                  sparse *out, fault *f)
{
    const model *m = eq->m;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    if (model_absolute(m))
        return fault_set(f, STATUS_REFUSED,
                         "%s computes forces with a history, which have no linear stiffness due to "
                         "a prestress; follow a static path or a continuation",
                         model_formulation(m));
    if (out->symmetric) {
        TRY(loads_have_potential(eq, kinematics_rest(m), path, f));
        TRY(linearise_held_have_potential(eq, sigma, path, f));
    }
    sparse_zero(out);
    ahead_strains(eq, kinematics_rest(m), AHEAD_J | AHEAD_H, sigma);
    for (int i = 0; i < model_elements(m); i++) {
        double H[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
            G[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
            force[ELEMENT_MAX_COORDINATES] = {0};
        const double *s = &sigma[(size_t)i * (size_t)model_strains(m)];
        geometric_of(eq, i, s, H, G, J);
        dense_add_congruence(model_strains(m), model_own_coordinates(m), J, G, H, work);
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J, s, force);
        eliminate_matrix(m, kinematics_rest(m), model_element(m, i), force, H);
        assemble_matrix(assemble_of(eq->run->patterns, out), i, H, out);
    }
    ahead_end(eq);
    loads_subtract_stiffness(eq, kinematics_rest(m), path, out);
    linear_springs_geometric_stiffness(m, sigma + model_elements(m) * model_strains(m), out);
    return STATUS_OK;
}

/* Computes the sums of the absolute values of the terms of J x and of the stresses S J x of an
 * element. */
static void linear_terms(const equations *eq, int i, const double x[], double strain[],
                         double stress[])
{
    const model *m = eq->m;
    undeformed_element l;
    double local[ELEMENT_MAX_COORDINATES];
    undeformed_of(eq, i, &l, NULL);
    kinematics_local(m, kinematics_rest(m), model_element(m, i), x, local);
    if (model_frees(m))
        free_strain_linear(eq, i, 1, strain);
    for (int k = 0; k < model_strains(m); k++) {
        strain[k] = model_frees(m) ? fabs(strain[k]) : 0;
        for (int j = 0; j < model_own_coordinates(m); j++)
            strain[k] += fabs(l.J[k * model_own_coordinates(m) + j] * local[j]);
    }
    for (int k = 0; k < model_strains(m); k++) {
        stress[k] = l.initial != NULL ? fabs(l.initial[k]) : 0;
        for (int j = 0; j < model_strains(m); j++)
            stress[k] += fabs(l.C[k * model_strains(m) + j]) * strain[j];
    }
}

double linear_strain_rounding(const equations *eq, const double x[])
{
    const model *m = eq->m;
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS], terms[ELEMENT_MAX_STRAINS], ignored[ELEMENT_MAX_STRAINS];
        undeformed_of(eq, i, &l, NULL);
        linear_strains(m, i, &l, x, e);
        linear_terms(eq, i, x, terms, ignored);
        for (int k = 0; k < model_strains(m); k++) {
            double sigma = 0, sigma_terms = 0;
            for (int j = 0; j < model_strains(m); j++) {
                sigma += l.C[k * model_strains(m) + j] * e[j];
                sigma_terms += fabs(l.C[k * model_strains(m) + j] * e[j]);
            }
            sum += DBL_EPSILON * (2 * fabs(sigma) * terms[k] + fabs(e[k]) * sigma_terms);
        }
    }
    return sum + linear_springs_rounding(m, x);
}

double linear_strain_energy2(const equations *eq, const double x[])
{
    const model *m = eq->m;
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS];
        undeformed_of(eq, i, &l, NULL);
        linear_strains(m, i, &l, x, e);
        sum += dense_quadratic(model_strains(m), l.C, e);
    }
    return sum + linear_springs_energy2(m, x);
}

/* Returns x^T (sum sigma_i H_i + J^T G(sigma) J) x of an element. */
static double geometric_energy2(const equations *eq, int i, const double sigma[], const double x[])
{
    const model *m = eq->m;
    double H[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
        G[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0},
                                                             local[ELEMENT_MAX_COORDINATES],
                                                             e[ELEMENT_MAX_STRAINS];
    geometric_of(eq, i, sigma, H, G, J);
    kinematics_local(m, kinematics_rest(m), model_element(m, i), x, local);
    dense_mul_vec(model_strains(m), model_own_coordinates(m), J, local, e);
    const double inside = dense_quadratic(model_strains(m), G, e);
    if (model_element(m, i)->plain)
        return inside + dense_quadratic(model_own_coordinates(m), H, local);
    const mesh_element *el = model_element(m, i);
    double own[MODEL_MAX_COORDINATES];
    for (int k = 0; k < el->columns; k++)
        own[k] = el->index[k] == NONE ? 0 : x[el->index[k]];
    dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J, sigma, force);
    eliminate_matrix(m, kinematics_rest(m), el, force, H);
    return inside + dense_quadratic(el->columns, H, own);
}

double linear_geometric_energy2(const equations *eq, const double sigma[], const double x[])
{
    const model *m = eq->m;
    double sum = 0;
    ahead_strains(eq, kinematics_rest(m), AHEAD_J | AHEAD_H, sigma);
    for (int i = 0; i < model_elements(m); i++)
        sum += geometric_energy2(eq, i, &sigma[(size_t)i * (size_t)model_strains(m)], x);
    ahead_end(eq);
    return sum +
           linear_springs_geometric_energy2(m, sigma + model_elements(m) * model_strains(m), x);
}

/* The form is linear in the stresses, so its rounding error is found by adding a stress `other`
 * with the size of the terms of all stresses, in an arbitrary direction. */
double linear_geometric_rounding(const equations *eq, const double load_x[], const double sigma[],
                                 const double x[])
{
    const model *m = eq->m;
    double square = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const double *s = &sigma[(size_t)i * (size_t)model_strains(m)];
        double terms[ELEMENT_MAX_STRAINS], other[ELEMENT_MAX_STRAINS], both[ELEMENT_MAX_STRAINS],
            largest = 0;
        linear_terms(eq, i, load_x, both, terms);
        for (int k = 0; k < model_strains(m); k++)
            largest = fmax(largest, terms[k]);
        for (int k = 0; k < model_strains(m); k++) {
            other[k] = largest * sin(1 + 2.3 * k);
            both[k] = s[k] + other[k];
        }
        const double of_other = geometric_energy2(eq, i, other, x),
                     of_both = geometric_energy2(eq, i, both, x);
        const double missing = fabs(of_both - of_other - geometric_energy2(eq, i, s, x)) +
                               DBL_EPSILON * fabs(of_other);
        square += missing * missing;
    }
    return sqrt(square);
}

static status allocate(const analysis_context *c, linear_system *out, fault *f)
{
    const sparse *pattern;
    TRY(assemble_pattern_at_rest(c->model, c->run->patterns, 0, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &out->K, f));
    return assemble_factor(c->run->patterns, pattern, &out->factor, f);
}

/* Returns 1 if a pivot is a rounding error, so its sign is arbitrary: a part is not supported, or
 * the smallest pivot has no digits and some pivot is negative. */
static int is_lost(const analysis_context *c, const factor_counts *counts)
{
    const double all_digits = 1e12;
    double motion[6];
    int node;
    return counts->condition > all_digits &&
           (counts->negative_pivots > 0 || supports_loose_part(c->model, &node, motion));
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
    context_count_condition(c, out->factor, &out->K);
    if (is_lost(c, &counts)) {
        c->work->singular = 1;
        return factor_report_singular(f);
    }
    return counts.negative_pivots > 0
               ? fault_set(
                     f, STATUS_NOT_CONVERGED,
                     "%s: the stiffness of the unloaded structure has %d negative pivot%s, because "
                     "elements move against their forces; use more elements or another formulation",
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

static status residual_of(analysis_context *c, double path, const double load[], const double x[],
                          double sigma[], double r[], fault *f)
{
    const model_size size = model_sizes(c->model);
    TRY(linear_whole_stresses(&c->eq, x, path, sigma, f));
    linear_forces(&c->eq, sigma, r);
    for (int i = 0; i < size.free + size.driven; i++)
        r[i] = load[i] - r[i];
    return STATUS_OK;
}

typedef struct system_workspace {
    double *load, *r, *weight, *shaken; /* [free + driven] */
    double *sigma;                      /* [elements x strains] */
    /* largest stress-free strain; it is the reference for errors if all displacements are
     * prevented */
    double path, strained;
} system_workspace;

static status workspace_alloc(analysis_context *c, double path, system_workspace *w, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    w->load = calloc(4 * all, sizeof *w->load);
    w->sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *w->sigma);
    if (w->load == NULL || w->sigma == NULL)
        return fault_memory(f, "a linear solution");
    w->r = w->load + all;
    w->weight = w->r + all;
    w->shaken = w->weight + all;
    w->path = path;
    w->strained = linear_initial(c->model) + free_strain_size(&c->eq, path);
    metric_of(c->model, w->weight);
    loads_reference(&c->eq, path, w->load);
    return STATUS_OK;
}

static double part_of(const analysis_context *c, const system_workspace *w, const double change[],
                      const double x[])
{
    return refinement_part(model_sizes(c->model).free, w->weight, change, x, w->strained);
}

static status correct(analysis_context *c, linear_system *s, system_workspace *w, double x[],
                      double *correction, fault *f)
{
    const int n = model_sizes(c->model).free;
    TRY(residual_of(c, w->path, w->load, x, w->sigma, w->r, f));
    factor_solve(s->factor, w->r);
    for (int k = 0; k < n; k++)
        x[k] += w->r[k];
    *correction = part_of(c, w, w->r, x);
    return STATUS_OK;
}

/* Estimates the error of x. For this purpose, x is perturbed in its last digits and corrected; the
 * result is the distance from the previous x. */
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
        state = refinement_next(&r, correction);
    }
    if (state == REFINEMENT_ENDS) {
        TRY(shake(c, s, w, x, &correction, f));
        state = refinement_evaluate(&r, correction);
    }
    return state == REFINEMENT_ENDS ? STATUS_OK : refinement_refuse(&r, "the linear solution", f);
}

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

static void linear_model_free(linear_model *m)
{
    triplets *const each[] = {&m->K,    &m->C, &m->M,       &m->B,       &m->L[0],    &m->L[1],
                              &m->L[2], &m->D, &m->state.A, &m->state.B, &m->state.C, &m->state.D};
    for (size_t k = 0; k < sizeof each / sizeof *each; k++)
        triplets_free(each[k]);
}

static void reduced_model_free(reduced_model *m)
{
    linear_model_free(&m->of);
    triplets_free(&m->T);
    free(m->whole);
    free(m->reduced);
    free(m->difference);
    free(m->apart);
    free(m->at);
}

void system_matrices_free(system_matrices *s)
{
    for (int i = 0; i < s->states; i++) {
        triplets *const each[] = {&s->state[i].K, &s->state[i].M,      &s->state[i].G,
                                  &s->state[i].C, &s->state[i].inside, &s->state[i].B};
        for (size_t k = 0; k < sizeof each / sizeof *each; k++)
            triplets_free(each[k]);
        linear_model_free(&s->state[i].model);
        reduced_model_free(&s->state[i].reduced);
        free(s->state[i].frequency);
        free(s->state[i].mode);
    }
    free(s->state);
    free(s->label);
    free(s->input);
    free(s->output);
    memset(s, 0, sizeof *s);
}
