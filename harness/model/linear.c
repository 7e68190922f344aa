/* Linear analyses about the undeformed state, and quadratic forms taken from the strains: they cost no digits on fine meshes. */
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/parts.h"

typedef struct linear_element {
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], S[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
} linear_element;

static status linear_of(model *m, int i, linear_element *out)
{
    const mesh_element *el = &m->element[i];
    const element_data *data = m->kind[el->kind].data;
    double e[ELEMENT_MAX_STRAINS] = {0}, inner[1] = {0};
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, m->rest, el, x);
    m->type->strain(data, x, &(strain_output){.e = e, .J = out->J});
    m->counters.strain_evaluations++;
    m->counters.stress_evaluations++;
    return m->type->stress(data, e, m->inner > 0 ? &m->rest->inner[(size_t)i * (size_t)m->inner] : inner,
                           &(stress_output){.C = out->S});
}

static mesh_pattern *pattern_of(model *m, const sparse *a)
{
    return &m->pattern[a->row == m->pattern[1].matrix.row];
}

static status not_evaluated(const model *m, int i, status outcome, fault *f)
{
    return fault_set(f, outcome, "element %d of member %d: its undeformed state is outside what %s can evaluate", i,
                     m->element[i].member, m->type->name);
}

status model_linear_stiffness(model *m, sparse *K, fault *f)
{
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    sparse_zero(K);
    for (int i = 0; i < m->elements; i++) {
        linear_element l;
        double k[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES] = {0};
        const status outcome = linear_of(m, i, &l);
        if (outcome != STATUS_OK)
            return not_evaluated(m, i, outcome, f);
        dense_add_congruence(m->strains, m->coordinates, l.J, l.S, k, work);
        eliminate_matrix(m, m->rest, &m->element[i], NULL, k);
        assemble_matrix(pattern_of(m, K), i, k, K);
    }
    return STATUS_OK;
}

/* J x of one element. */
static void linear_strains(model *m, int i, const linear_element *l, const double x[], double e[])
{
    double local[ELEMENT_MAX_COORDINATES];
    kinematics_local(m, m->rest, &m->element[i], x, local);
    dense_mul_vec(m->strains, m->coordinates, l->J, local, e);
}

status model_linear_stresses(model *m, const double x[], double sigma[], fault *f)
{
    for (int i = 0; i < m->elements; i++) {
        linear_element l;
        double e[ELEMENT_MAX_STRAINS];
        const status outcome = linear_of(m, i, &l);
        if (outcome != STATUS_OK)
            return not_evaluated(m, i, outcome, f);
        linear_strains(m, i, &l, x, e);
        dense_mul_vec(m->strains, m->strains, l.S, e, &sigma[(size_t)i * (size_t)m->strains]);
    }
    return STATUS_OK;
}

void model_linear_forces(model *m, const double sigma[], double f[])
{
    memset(f, 0, (size_t)(m->free + m->driven) * sizeof *f);
    for (int i = 0; i < m->elements; i++) {
        const element_data *data = m->kind[m->element[i].kind].data;
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0};
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, m->rest, &m->element[i], x);
        m->type->strain(data, x, &(strain_output){.J = J});
        m->counters.strain_evaluations++;
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J, &sigma[(size_t)i * (size_t)m->strains], force);
        eliminate_forces(m, m->rest, &m->element[i], force);
        assemble_vector(&m->element[i], m->coordinates, force, f);
    }
}

/* sum sigma_i H_i and G(sigma) of one element, in element coordinates; force = J^T sigma. */
static void geometric_of(model *m, int i, const double sigma[], double H[], double G[], double J[])
{
    const mesh_element *el = &m->element[i];
    const element_data *data = m->kind[el->kind].data;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, m->rest, el, x);
    m->type->strain(data, x, &(strain_output){.J = J, .s = sigma, .H = H});
    if (m->type->geometric != NULL)
        m->type->geometric(data, sigma, G);
    else
        memset(G, 0, (size_t)(m->strains * m->strains) * sizeof *G);
    m->counters.strain_evaluations++;
}

status model_geometric_stiffness(model *m, const double sigma[], sparse *out, fault *f)
{
    (void)f;
    double work[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    sparse_zero(out);
    for (int i = 0; i < m->elements; i++) {
        double H[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], G[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0};
        const double *s = &sigma[(size_t)i * (size_t)m->strains];
        geometric_of(m, i, s, H, G, J);
        dense_add_congruence(m->strains, m->coordinates, J, G, H, work);
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J, s, force);
        eliminate_matrix(m, m->rest, &m->element[i], force, H);
        assemble_matrix(pattern_of(m, out), i, H, out);
    }
    loads_subtract_stiffness(m, m->rest, 1, out);
    return STATUS_OK;
}

double model_strain_energy2(model *m, const double x[])
{
    double sum = 0;
    for (int i = 0; i < m->elements; i++) {
        linear_element l;
        double e[ELEMENT_MAX_STRAINS];
        linear_of(m, i, &l);
        linear_strains(m, i, &l, x, e);
        sum += dense_quadratic(m->strains, l.S, e);
    }
    return sum;
}

double model_geometric_energy2(model *m, const double sigma[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < m->elements; i++) {
        double H[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], G[ELEMENT_MAX_STRAINS * ELEMENT_MAX_STRAINS];
        double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0},
                                                                 local[ELEMENT_MAX_COORDINATES], e[ELEMENT_MAX_STRAINS];
        const double *s = &sigma[(size_t)i * (size_t)m->strains];
        geometric_of(m, i, s, H, G, J);
        kinematics_local(m, m->rest, &m->element[i], x, local);
        dense_mul_vec(m->strains, m->coordinates, J, local, e);
        sum += dense_quadratic(m->strains, G, e);
        if (m->element[i].plain) {
            sum += dense_quadratic(m->coordinates, H, local);
            continue;
        }
        /* Second derivatives of offsets and sequences act in the model's coordinates. */
        double own[ELEMENT_MAX_COORDINATES];
        for (int k = 0; k < m->coordinates; k++)
            own[k] = m->element[i].index[k] == NONE ? 0 : x[m->element[i].index[k]];
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J, s, force);
        eliminate_matrix(m, m->rest, &m->element[i], force, H);
        sum += dense_quadratic(m->coordinates, H, own);
    }
    return sum;
}
