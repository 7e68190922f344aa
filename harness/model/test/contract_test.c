/* What every formulation must keep, checked for all that exist: gradient of the energy, derivative
 * of the force, rigid motion, node order, total mass, units. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/matrices.h"
#include "elements/test/nodes.h"
#include "elements/test/worst.h"
#include "harness/catalogue/registry.h"
#include "harness/model/test/contract.h"

static double norm(int n, const double *a)
{
    return sqrt(dense_dot(n, a, a));
}

/* J and H along random directions, in a state that is far from rest. */
static void derivatives_of_strain(const subject *s)
{
    double d[MOST], direction[MOST], weights[MOST_STRAINS], worst_J = 0, worst_H = 0;
    node_state x[ELEMENT_MAX_NODES];
    nodes_increments(s->nodes, s->length, 0.3, 7, d);
    nodes_place(s->nodes, s->length, d, x);
    for (int i = 0; i < s->strains; i++)
        weights[i] = cos(3.7 * i + 0.3);
    for (unsigned seed = 1; seed <= 6; seed++) {
        nodes_increments(s->nodes, s->length, 1, 100 + seed, direction);
        const nodes_departure found =
            nodes_differences(s->type, s->data, s->nodes, s->strains, x, direction, weights);
        worst_J = worst_of(worst_J, found.first);
        worst_H = worst_of(worst_H, found.second);
    }
    gsl_test(!(worst_J < 1e-10), "%s: de/dx is the derivative of e (%.1e)", s->type->name, worst_J);
    gsl_test(!(worst_H < 1e-10), "%s: d2e/dx2 is the second derivative of e (%.1e)", s->type->name,
             worst_H);
}

/* sigma = dP/de and C = dsigma/de; a formulation whose tangent is not symmetric has no energy to
 * compare with. */
static void derivatives_of_stress(const subject *s)
{
    double d[MOST], e[MOST_STRAINS], sigma[MOST_STRAINS], C[MOST_STRAINS * MOST_STRAINS],
        inner[1024] = {0}, worst = 0, worst_C = 0;
    node_state x[ELEMENT_MAX_NODES];
    nodes_increments(s->nodes, s->length, 0.02, 11, d);
    nodes_place(s->nodes, s->length, d, x);
    s->type->strain(s->data, x, &(strain_output){.e = e});
    contract_rest(s, inner);
    gsl_test(contract_settled(s, e, inner, &(stress_output){.sigma = sigma, .C = C}) != STATUS_OK,
             "%s: stress evaluated", s->type->name);
    double largest = 0;
    for (int i = 0; i < s->strains * s->strains; i++)
        largest = fmax(largest, fabs(C[i]));
    for (int k = 0; k < s->strains; k++) {
        double energy[2], side[2][MOST_STRAINS];
        const double h = 1e-6 * s->length;
        for (int t = 0; t < 2; t++) {
            double changed[MOST_STRAINS], own[1024];
            memcpy(changed, e, sizeof changed);
            memcpy(own, inner, sizeof own);
            changed[k] += t == 0 ? h : -h;
            contract_settled(s, changed, own,
                             &(stress_output){.energy = &energy[t], .sigma = side[t]});
        }
        const double size = norm(s->strains, sigma) + largest * h;
        worst = worst_of(worst, fabs((energy[0] - energy[1]) / (2 * h) - sigma[k]) / size);
        for (int i = 0; i < s->strains; i++)
            worst_C = worst_of(worst_C,
                               fabs((side[0][i] - side[1][i]) / (2 * h) - C[s->strains * i + k]) /
                                   largest);
    }
    gsl_test(!(worst < 1e-6), "%s: stress is the gradient of the energy (%.1e)", s->type->name,
             worst);
    gsl_test(!(nodes_asymmetry(s->strains, C) < 1e-10), "%s: dsigma/de is symmetric (%.1e)",
             s->type->name, nodes_asymmetry(s->strains, C));
    gsl_test(!(worst_C < 1e-6), "%s: C is the derivative of the stress (%.1e)", s->type->name,
             worst_C);
}

static void rigid_motion(const subject *s)
{
    const double turn[3] = {0.71, -1.93, 1.37};
    double e[MOST_STRAINS], moved_e[MOST_STRAINS], d[MOST], worst = 0, worst_still = 0;
    node_state x[ELEMENT_MAX_NODES], moved[ELEMENT_MAX_NODES];
    double q[4], R[9];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int pass = 0; pass < 2; pass++) {
        nodes_increments(s->nodes, s->length, pass == 0 ? 0 : 0.2, 5, d);
        nodes_place(s->nodes, s->length, d, x);
        for (int k = 0; k < s->nodes; k++) {
            const double shift[3] = {0.317 * s->length, -1.21 * s->length, 2.37 * s->length};
            moved[k] = x[k];
            rotation_apply(q, x[k].r, moved[k].r);
            for (int i = 0; i < 3; i++) {
                moved[k].r[i] += shift[i];
                moved[k].u[i] = moved[k].r[i] - (x[k].r[i] - x[k].u[i]);
            }
            mat3_mul(R, x[k].R, moved[k].R);
        }
        s->type->strain(s->data, x, &(strain_output){.e = e});
        s->type->strain(s->data, moved, &(strain_output){.e = moved_e});
        for (int i = 0; i < s->strains; i++)
            *(pass == 0 ? &worst_still : &worst) =
                worst_of(pass == 0 ? worst_still : worst, fabs(moved_e[i] - e[i]) / s->length);
    }
    gsl_test(!(worst_still < 1e-14), "%s: rigid motion makes no strain (%.1e l0)", s->type->name,
             worst_still);
    gsl_test(!(worst < 4e-15 * 4),
             "%s: rigid motion of a strained element changes no strain (%.1e l0)", s->type->name,
             worst);
}

/* Energy of the reversed element (turned by pi about y, warping amplitude unchanged). */
static void node_order(const subject *s)
{
    double d[MOST], inner[1024] = {0}, energy[2], e[MOST_STRAINS];
    node_state x[ELEMENT_MAX_NODES], reversed[ELEMENT_MAX_NODES];
    const double half_turn[9] = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
    if (s->type->limits & LIMIT_ORDER_DEPENDENT)
        return; /* by a discretisation error, which the reports show */
    nodes_increments(s->nodes, s->length, 0.05, 3, d);
    nodes_place(s->nodes, s->length, d, x);
    for (int k = 0; k < s->nodes; k++) {
        reversed[k] = x[s->nodes - 1 - k];
        mat3_mul(x[s->nodes - 1 - k].R, half_turn, reversed[k].R);
    }
    for (int t = 0; t < 2; t++) {
        s->type->strain(s->data, t == 0 ? x : reversed, &(strain_output){.e = e});
        contract_rest(s, inner);
        energy[t] = NAN;
        contract_settled(s, e, inner, &(stress_output){.energy = &energy[t]});
    }
    gsl_test(!(fabs(energy[1] - energy[0]) <= 1e-9 * fabs(energy[0])),
             "%s: exchanging the nodes leaves the energy (%.1e)", s->type->name,
             fabs(energy[1] / energy[0] - 1));
}

static void total_mass(const subject *s)
{
    double M[MOST * MOST], d[MOST] = {0};
    node_state x[ELEMENT_MAX_NODES];
    if (s->type->inertia == NULL || !(s->type->offers & FEATURE_MASS))
        return;
    nodes_place(s->nodes, s->length, d, x);
    gsl_test(s->type->inertia(s->data, x, NULL, &(inertia_output){.M = M}) != STATUS_OK,
             "%s: mass matrix", s->type->name);
    const double mass = s->section.density * s->section.A * s->length;
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int i = 0; i < s->nodes; i++)
            for (int j = 0; j < s->nodes; j++)
                sum += M[(NODE_COORDINATES * i + c) * s->coordinates + NODE_COORDINATES * j + c];
        gsl_test_rel(sum, mass, 1e-13, "%s: total mass, direction %d", s->type->name, c);
    }
    gsl_test(!(nodes_asymmetry(s->coordinates, M) < 1e-14), "%s: mass matrix is symmetric",
             s->type->name);
}

/* The same element in m, mm and um: energy in joules does not change. */
static void units(const element_type *type)
{
    const double unit[3] = {1, 1e-3, 1e-6};
    double energy[3];
    for (int k = 0; k < 3; k++) {
        subject s;
        double d[MOST], inner[1024] = {0}, e[MOST_STRAINS];
        node_state x[ELEMENT_MAX_NODES];
        fault f = {""};
        const status made =
            contract_prepare(type, type->offers & ~(unsigned)FEATURE_CURVATURE, unit[k], &s, &f);
        gsl_test(made != STATUS_OK, "%s: prepared in units of %g m %s", type->name, unit[k],
                 f.text);
        nodes_increments(s.nodes, s.length, 0.01, 23, d);
        nodes_place(s.nodes, s.length, d, x);
        s.type->strain(s.data, x, &(strain_output){.e = e});
        contract_rest(&s, inner);
        energy[k] = NAN;
        contract_settled(&s, e, inner, &(stress_output){.energy = &energy[k]});
        energy[k] *= unit[k];
        free(s.data);
    }
    for (int k = 1; k < 3; k++)
        gsl_test_rel(energy[k], energy[0], 1e-11,
                     "%s: the energy does not depend on the unit of length", type->name);
}

/* An element with all features that it offers for straight ones. */
static void whole(const element_type *type)
{
    subject s;
    fault f = {""};
    if (contract_prepare(type, type->offers & ~(unsigned)FEATURE_CURVATURE, 1, &s, &f) ==
        STATUS_OK) {
        derivatives_of_strain(&s);
        derivatives_of_stress(&s);
        rigid_motion(&s);
        node_order(&s);
        total_mass(&s);
        units(type);
    } else
        gsl_test(1, "%s: prepared %s", type->name, f.text);
    free(s.data);
}

/* Of a section by its matrices. */
static void coupled(const element_type *type)
{
    const unsigned features =
        type->offers & ~(unsigned)FEATURE_CURVATURE & ~(unsigned)FEATURE_WARPING;
    const section_spec spec = matrices_spec(1);
    subject s;
    fault f = {""};
    if (contract_prepare_of(&spec, type, features, 1, &s, &f) == STATUS_OK) {
        derivatives_of_stress(&s);
        rigid_motion(&s);
        total_mass(&s);
    } else
        gsl_test(1, "%s, section by its matrices: prepared %s", type->name, f.text);
    free(s.data);
}

int main(void)
{
    int carry = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        whole(registry_formulations[i]);
        if (registry_formulations[i]->offers & FEATURE_COUPLED) {
            coupled(registry_formulations[i]);
            carry++;
        }
    }
    gsl_test(carry < 1, "%d formulations carry sections by their matrices", carry);
    return gsl_test_summary();
}
