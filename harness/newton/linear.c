/* Linear analyses about the undeformed state, and quadratic forms taken from the strains: they cost
 * no digits on fine meshes. */
#include "harness/newton/linear.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/ahead.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linear_springs.h"
#include "harness/newton/undeformed.h"

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

/* J x of one element. */
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
    for (int i = 0; i < model_scene(m)->members; i++)
        largest = fmax(largest, vec3_norm(model_scene(m)->member[i].strain));
    return largest;
}

status linear_whole_stresses(const equations *eq, const double x[], double sigma[], fault *f)
{
    const model *m = eq->m;
    TRY(linear_stresses(eq, x, sigma, f));
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
        ahead_strain(eq, i, x, &(strain_output){.J = J});
        eq->run->counters.strain_evaluations++;
        dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                                &sigma[(size_t)i * (size_t)model_strains(m)], force);
        eliminate_forces(m, kinematics_rest(m), model_element(m, i), force);
        assemble_vector(model_element(m, i), force, f);
    }
    ahead_end(eq);
    linear_springs_forces(m, sigma + model_elements(m) * model_strains(m), f);
}

/* sum sigma_i H_i and G(sigma) of one element, in element coordinates; force = J^T sigma. */
static void geometric_of(const equations *eq, int i, const double sigma[], double H[], double G[],
                         double J[])
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    const element_data *data = model_kind(m, el->kind)->data;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), el, x);
    ahead_strain(eq, i, x, &(strain_output){.J = J, .s = sigma, .H = H});
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

/* Sums of the absolute terms of J x and, of S times them, of the stresses of one element. */
static void linear_terms(const equations *eq, int i, const double x[], double strain[],
                         double stress[])
{
    const model *m = eq->m;
    undeformed_element l;
    double local[ELEMENT_MAX_COORDINATES];
    undeformed_of(eq, i, &l, NULL);
    kinematics_local(m, kinematics_rest(m), model_element(m, i), x, local);
    for (int k = 0; k < model_strains(m); k++) {
        strain[k] = 0;
        for (int j = 0; j < model_own_coordinates(m); j++)
            strain[k] += fabs(l.J[k * model_own_coordinates(m) + j] * local[j]);
    }
    for (int k = 0; k < model_strains(m); k++) {
        stress[k] = l.initial != NULL ? fabs(l.initial[k]) : 0;
        for (int j = 0; j < model_strains(m); j++)
            stress[k] += fabs(l.C[k * model_strains(m) + j]) * strain[j];
    }
}

/* Strains are off by the rounding of their terms, S by that of its entries: errors of all elements
 * alike, so they add up. */
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

/* x^T (sum sigma_i H_i + J^T G(sigma) J) x of one element. */
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
    /* Second derivatives of offsets and sequences act in the model's coordinates. */
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

/* The form is linear in the stresses: what is missing there is its own rounding. The stresses' is
 * that of the terms they are made of, in whatever direction it falls: it has the size of a stress
 * `other` of all kinds at once. */
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
