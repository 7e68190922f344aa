/* Linear analyses about the undeformed state, and quadratic forms taken from the strains: they cost
 * no digits on fine meshes. */
#include "harness/newton/linear.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/newton/ahead.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linear_springs.h"
#include "harness/newton/undeformed.h"

static status stiffness_elements(const equations *eq, sparse *K, fault *f)
{
    const model *m = eq->m;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    sparse_zero(K);
    for (int i = 0; i < m->elements; i++) {
        undeformed_element l;
        double k[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        TRY(undeformed_of(eq, i, &l, f));
        memset(k, 0, (size_t)(m->coordinates * m->coordinates) * sizeof *k);
        dense_add_congruence(m->strains, m->coordinates, l.J, l.C, k, work);
        eliminate_matrix(m, m->rest, &m->element[i], NULL, k);
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
    kinematics_local(m, m->rest, &m->element[i], x, local);
    dense_mul_vec(m->strains, m->coordinates, l->J, local, e);
}

status linear_stresses(const equations *eq, const double x[], double sigma[], fault *f)
{
    const model *m = eq->m;
    for (int i = 0; i < m->elements; i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS];
        TRY(undeformed_of(eq, i, &l, f));
        linear_strains(m, i, &l, x, e);
        dense_mul_vec(m->strains, m->strains, l.C, e, &sigma[(size_t)i * (size_t)m->strains]);
    }
    linear_springs_stresses(m, x, sigma + m->elements * m->strains);
    return STATUS_OK;
}

double linear_initial(const model *m)
{
    double largest = 0;
    for (int i = 0; i < m->scene->members; i++)
        largest = fmax(largest, vec3_norm(m->scene->member[i].strain));
    return largest;
}

status linear_whole_stresses(const equations *eq, const double x[], double sigma[], fault *f)
{
    const model *m = eq->m;
    TRY(linear_stresses(eq, x, sigma, f));
    for (int i = 0; i < m->elements && linear_initial(m) > 0; i++) {
        undeformed_element l;
        TRY(undeformed_of(eq, i, &l, f));
        for (int k = 0; l.initial != NULL && k < m->strains; k++)
            sigma[(size_t)i * (size_t)m->strains + (size_t)k] += l.initial[k];
    }
    return STATUS_OK;
}

void linear_forces(const equations *eq, const double sigma[], double f[])
{
    const model *m = eq->m;
    ahead_strains(eq, m->rest, AHEAD_J, NULL);
    memset(f, 0, (size_t)(m->free + m->driven) * sizeof *f);
    for (int i = 0; i < m->elements; i++) {
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[MODEL_MAX_COORDINATES] = {0};
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, m->rest, &m->element[i], x);
        ahead_strain(eq, i, x, &(strain_output){.J = J});
        eq->run->counters.strain_evaluations++;
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J,
                                &sigma[(size_t)i * (size_t)m->strains], force);
        eliminate_forces(m, m->rest, &m->element[i], force);
        assemble_vector(&m->element[i], force, f);
    }
    ahead_end(eq);
    linear_springs_forces(m, sigma + m->elements * m->strains, f);
}

/* sum sigma_i H_i and G(sigma) of one element, in element coordinates; force = J^T sigma. */
static void geometric_of(const equations *eq, int i, const double sigma[], double H[], double G[],
                         double J[])
{
    const model *m = eq->m;
    const mesh_element *el = &m->element[i];
    const element_data *data = m->kind[el->kind].data;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, m->rest, el, x);
    ahead_strain(eq, i, x, &(strain_output){.J = J, .s = sigma, .H = H});
    if (m->type->geometric != NULL)
        m->type->geometric(data, sigma, G);
    else
        memset(G, 0, (size_t)(m->strains * m->strains) * sizeof *G);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.geometric_evaluations++;
}

status linear_geometric_stiffness(const equations *eq, const double sigma[], double path,
                                  sparse *out, fault *f)
{
    const model *m = eq->m;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    if (out->symmetric) {
        TRY(loads_have_potential(eq, m->rest, path, f));
        TRY(linearise_held_have_potential(eq, sigma, path, f));
    }
    sparse_zero(out);
    ahead_strains(eq, m->rest, AHEAD_J | AHEAD_H, sigma);
    for (int i = 0; i < m->elements; i++) {
        double H[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES],
            G[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES],
            force[ELEMENT_MAX_COORDINATES] = {0};
        const double *s = &sigma[(size_t)i * (size_t)m->strains];
        geometric_of(eq, i, s, H, G, J);
        dense_add_congruence(m->strains, m->coordinates, J, G, H, work);
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J, s, force);
        eliminate_matrix(m, m->rest, &m->element[i], force, H);
        assemble_matrix(assemble_of(eq->run->patterns, out), i, H, out);
    }
    ahead_end(eq);
    loads_subtract_stiffness(eq, m->rest, path, out);
    linear_springs_geometric_stiffness(m, sigma + m->elements * m->strains, out);
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
    kinematics_local(m, m->rest, &m->element[i], x, local);
    for (int k = 0; k < m->strains; k++) {
        strain[k] = 0;
        for (int j = 0; j < m->coordinates; j++)
            strain[k] += fabs(l.J[k * m->coordinates + j] * local[j]);
    }
    for (int k = 0; k < m->strains; k++) {
        stress[k] = l.initial != NULL ? fabs(l.initial[k]) : 0;
        for (int j = 0; j < m->strains; j++)
            stress[k] += fabs(l.C[k * m->strains + j]) * strain[j];
    }
}

/* Strains are off by the rounding of their terms, S by that of its entries: errors of all elements
 * alike, so they add up. */
double linear_strain_rounding(const equations *eq, const double x[])
{
    const model *m = eq->m;
    double sum = 0;
    for (int i = 0; i < m->elements; i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS], terms[ELEMENT_MAX_STRAINS], ignored[ELEMENT_MAX_STRAINS];
        undeformed_of(eq, i, &l, NULL);
        linear_strains(m, i, &l, x, e);
        linear_terms(eq, i, x, terms, ignored);
        for (int k = 0; k < m->strains; k++) {
            double sigma = 0, sigma_terms = 0;
            for (int j = 0; j < m->strains; j++) {
                sigma += l.C[k * m->strains + j] * e[j];
                sigma_terms += fabs(l.C[k * m->strains + j] * e[j]);
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
    for (int i = 0; i < m->elements; i++) {
        undeformed_element l;
        double e[ELEMENT_MAX_STRAINS];
        undeformed_of(eq, i, &l, NULL);
        linear_strains(m, i, &l, x, e);
        sum += dense_quadratic(m->strains, l.C, e);
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
    kinematics_local(m, m->rest, &m->element[i], x, local);
    dense_mul_vec(m->strains, m->coordinates, J, local, e);
    const double inside = dense_quadratic(m->strains, G, e);
    if (m->element[i].plain)
        return inside + dense_quadratic(m->coordinates, H, local);
    /* Second derivatives of offsets and sequences act in the model's coordinates. */
    const mesh_element *el = &m->element[i];
    double own[MODEL_MAX_COORDINATES];
    for (int k = 0; k < el->columns; k++)
        own[k] = el->index[k] == NONE ? 0 : x[el->index[k]];
    dense_add_transpose_mul(m->coordinates, m->strains, 1, J, sigma, force);
    eliminate_matrix(m, m->rest, el, force, H);
    return inside + dense_quadratic(el->columns, H, own);
}

double linear_geometric_energy2(const equations *eq, const double sigma[], const double x[])
{
    const model *m = eq->m;
    double sum = 0;
    ahead_strains(eq, m->rest, AHEAD_J | AHEAD_H, sigma);
    for (int i = 0; i < m->elements; i++)
        sum += geometric_energy2(eq, i, &sigma[(size_t)i * (size_t)m->strains], x);
    ahead_end(eq);
    return sum + linear_springs_geometric_energy2(m, sigma + m->elements * m->strains, x);
}

/* The form is linear in the stresses: what is missing there is its own rounding. The stresses' is
 * that of the terms they are made of, in whatever direction it falls: it has the size of a stress
 * `other` of all kinds at once. */
double linear_geometric_rounding(const equations *eq, const double load_x[], const double sigma[],
                                 const double x[])
{
    const model *m = eq->m;
    double square = 0;
    for (int i = 0; i < m->elements; i++) {
        const double *s = &sigma[(size_t)i * (size_t)m->strains];
        double terms[ELEMENT_MAX_STRAINS], other[ELEMENT_MAX_STRAINS], both[ELEMENT_MAX_STRAINS],
            largest = 0;
        linear_terms(eq, i, load_x, both, terms);
        for (int k = 0; k < m->strains; k++)
            largest = fmax(largest, terms[k]);
        for (int k = 0; k < m->strains; k++) {
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
