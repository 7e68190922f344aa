#include "harness/newton/linear_springs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"

enum { X = ELEMENT_MAX_COORDINATES, SIX = SPRING_STRAINS };

static const mesh_discrete *spring_of(const model *m, int i)
{
    return model_discrete(m, model_discretes(m) - model_springs(m) + i);
}

/* J at rest, and H of sigma where that is given. */
static void springs_evaluate(const model *m, const mesh_discrete *d, const double sigma[],
                             double J[], double H[])
{
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), &d->el, x);
    spring_strain(d->el.nodes, x, NULL, &(strain_output){.J = J, .s = sigma, .H = H});
}

/* J x */
static void strains(const model *m, const mesh_discrete *d, const double x[], double e[SIX])
{
    double J[SIX * X], local[X];
    springs_evaluate(m, d, NULL, J, NULL);
    kinematics_local(m, kinematics_rest(m), &d->el, x, local);
    dense_mul_vec(SIX, NODE_COORDINATES * d->el.nodes, J, local, e);
}

void linear_springs_stiffness(const model *m, sparse *K)
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], k[X * X] = {0}, work[SIX * X];
        springs_evaluate(m, d, NULL, J, NULL);
        dense_add_congruence(SIX, NODE_COORDINATES * d->el.nodes, J, d->spring->stiffness, k, work);
        eliminate_matrix(m, kinematics_rest(m), &d->el, NULL, k);
        assemble_discrete(&d->el, k, K);
    }
}

void linear_springs_stresses(const model *m, const double x[], double sigma[])
{
    for (int i = 0; i < model_springs(m); i++) {
        double e[SIX];
        strains(m, spring_of(m, i), x, e);
        dense_mul_vec(SIX, SIX, spring_of(m, i)->spring->stiffness, e, &sigma[SIX * i]);
    }
}

void linear_springs_forces(const model *m, const double sigma[], double f[])
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], force[X] = {0};
        springs_evaluate(m, d, NULL, J, NULL);
        dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, &sigma[SIX * i], force);
        eliminate_forces(m, kinematics_rest(m), &d->el, force);
        assemble_vector(&d->el, force, f);
    }
}

void linear_springs_node_force(const model *m, const double sigma[], int node, double F[6])
{
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        double J[SIX * X], force[X] = {0}, rho[3], moment[3];
        springs_evaluate(m, d, NULL, J, NULL);
        dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, &sigma[SIX * i], force);
        for (int k = 0; k < d->el.nodes; k++) {
            const double *at = force + NODE_COORDINATES * k;
            if (model_vertex(m, d->el.vertex[k])->body != node)
                continue;
            kinematics_offset(m, kinematics_rest(m), d->el.vertex[k], rho);
            vec3_cross(rho, at, moment);
            for (int c = 0; c < 6; c++)
                F[c] += at[c] + (c >= 3 && d->el.vertex[k] != node ? moment[c - 3] : 0);
        }
    }
}

/* sum sigma_i H_i in model coordinates. */
static void geometric(const model *m, const mesh_discrete *d, const double sigma[], double H[])
{
    double J[SIX * X], force[X] = {0};
    springs_evaluate(m, d, sigma, J, H);
    dense_add_transpose_mul(NODE_COORDINATES * d->el.nodes, SIX, 1, J, sigma, force);
    eliminate_matrix(m, kinematics_rest(m), &d->el, force, H);
}

void linear_springs_geometric_stiffness(const model *m, const double sigma[], sparse *G)
{
    for (int i = 0; i < model_springs(m); i++) {
        double H[X * X];
        geometric(m, spring_of(m, i), &sigma[SIX * i], H);
        assemble_discrete(&spring_of(m, i)->el, H, G);
    }
}

double linear_springs_energy2(const model *m, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        double e[SIX];
        strains(m, spring_of(m, i), x, e);
        sum += dense_quadratic(SIX, spring_of(m, i)->spring->stiffness, e);
    }
    return sum;
}

/* That of the terms of J x, as for elements. */
double linear_springs_rounding(const model *m, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_discrete *d = spring_of(m, i);
        const int n = NODE_COORDINATES * d->el.nodes;
        double J[SIX * X], local[X], e[SIX], sigma[SIX];
        springs_evaluate(m, d, NULL, J, NULL);
        kinematics_local(m, kinematics_rest(m), &d->el, x, local);
        dense_mul_vec(SIX, n, J, local, e);
        dense_mul_vec(SIX, SIX, d->spring->stiffness, e, sigma);
        for (int k = 0; k < SIX; k++)
            for (int j = 0; j < n; j++)
                sum += DBL_EPSILON * 2 * fabs(sigma[k] * J[k * n + j] * local[j]);
    }
    return sum;
}

double linear_springs_geometric_energy2(const model *m, const double sigma[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_springs(m); i++) {
        const mesh_element *el = &spring_of(m, i)->el;
        double H[X * X], own[X];
        geometric(m, spring_of(m, i), &sigma[SIX * i], H);
        for (int k = 0; k < NODE_COORDINATES * el->nodes; k++)
            own[k] = el->index[k] == NONE ? 0 : x[el->index[k]];
        sum += dense_quadratic(NODE_COORDINATES * el->nodes, H, own);
    }
    return sum;
}
