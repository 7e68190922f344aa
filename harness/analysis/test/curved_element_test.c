/* An element is free of stress along any arc of constant torsion and curvature, initial elongation
 * and shear included: every formulation that offers initial curvature, with every choice of its
 * options.  About such an arc its stress still derives from its energy, and its geometric stiffness
 * is the derivative of its tangent if it is so about the straight element (the others leave out
 * what the strains of the prestressed state add). */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/math/rotation.h"
#include "elements/test/random.h"
#include "elements/test/sections.h"
#include "elements/test/worst.h"
#include "harness/formulations/formulations.h"

enum { STRAINS = ELEMENT_MAX_STRAINS, INNER = 64, MEMORY = 4096, ARCS = 60, ELEMENT_POINTS = 32 };

typedef struct element_subject {
    const formulation *chosen;
    double length, turn[3], strain[3];
    element_data *data;
    int nodes, strains;
    double inner[INNER];
} element_subject;

static section rectangle(void)
{
    section_spec spec = section_spec_rectangle(210e9, 80.7e9, 0.0371, 0.0123);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    return sections_computed(&spec);
}

/* Turns up to `most` [rad]. Wagner torque and initial torsion are not offered together. */
static status prepare(const formulation *chosen, const section *c, double most, uint64_t *state,
                      element_subject *out, fault *f)
{
    const element_type *type = chosen->type;
    memset(out, 0, sizeof *out);
    out->chosen = chosen;
    out->length = 0.05 * (1.5 + random_number(state));
    double curvature[3];
    for (int i = 0; i < 3; i++) {
        out->turn[i] = most / sqrt(3) * random_number(state);
        curvature[i] = out->turn[i] / out->length;
        out->strain[i] = 0.1 * random_number(state);
    }
    if (type->lacks & LACKS_SHEAR_Y)
        out->strain[1] = 0;
    element_request request = {.section = c, .length = out->length, .options = chosen->option};
    request.features = type->offers & ~(unsigned)(FEATURE_WAGNER_TORQUE | FEATURE_ENGESSER);
    memcpy(request.curvature, curvature, sizeof curvature);
    memcpy(request.strain, out->strain, sizeof request.strain);
    out->nodes = element_nodes(type, chosen->option);
    out->strains = element_strains(type, chosen->option);
    out->data = calloc(1, type->data_size(&request));
    const status outcome = type->prepare(&request, out->data, f);
    if (outcome == STATUS_OK && type->rest != NULL)
        type->rest(out->data, out->inner);
    return outcome;
}

/* r = int_0^x R (e_x + strain) dt and R = exp(x turn~), by quadrature. */
static void along_arc(const element_subject *s, double x, const double strain[3], double r[3],
                      double R[9])
{
    double t[ELEMENT_POINTS], w[ELEMENT_POINTS], q[4];
    const double direction[3] = {1 + strain[0], strain[1], strain[2]};
    memset(r, 0, 3 * sizeof *r);
    quadrature_points(ELEMENT_POINTS, t, w);
    for (int g = 0; g <= ELEMENT_POINTS; g++) {
        const double at = g < ELEMENT_POINTS ? x * t[g] : x,
                     part[3] = {s->turn[0] * at, s->turn[1] * at, s->turn[2] * at};
        double axis[3];
        rotation_exp(part, q);
        rotation_matrix(q, R);
        mat3_mul_vec(R, direction, axis);
        if (g < ELEMENT_POINTS)
            for (int i = 0; i < 3; i++)
                r[i] += x * w[g] * axis[i];
    }
}

/* Nodes of the stress-free element, moved as a rigid body. */
static void place(const element_subject *s, const double motion[6], node_state x[])
{
    const double none[3] = {0};
    double q[4], turned[9];
    rotation_exp(motion + 3, q);
    rotation_matrix(q, turned);
    memset(x, 0, (size_t)s->nodes * sizeof *x);
    for (int k = 0; k < s->nodes; k++) {
        double free[3], arc[3], r[3], R[9];
        const double at = (double)k / (s->nodes - 1);
        along_arc(s, at, none, arc, R);
        along_arc(s, at, s->strain, free, R);
        mat3_mul(turned, R, x[k].R);
        mat3_mul_vec(turned, free, r);
        for (int i = 0; i < 3; i++) {
            x[k].r[i] = s->length * (r[i] + motion[i]);
            x[k].u[i] = x[k].r[i] - s->length * arc[i];
        }
    }
}

static status stress_at(element_subject *s, const double e[], stress_output *out)
{
    static double memory[MEMORY];
    const element_type *type = s->chosen->type;
    out->memory = type->memory != NULL ? memory : NULL;
    return type->stress(s->data, e, s->inner, out);
}

/* Largest stress, of what a strain of one would give. */
static double stress_of_arc(element_subject *s, const double motion[6])
{
    node_state x[ELEMENT_MAX_NODES];
    double e[STRAINS], sigma[STRAINS], C[STRAINS * STRAINS], worst = 0;
    place(s, motion, x);
    s->chosen->type->strain(s->data, x, &(strain_output){.e = e});
    if (stress_at(s, e, &(stress_output){.sigma = sigma, .C = C}) != STATUS_OK)
        return INFINITY;
    for (int i = 0; i < s->strains; i++) {
        double stiffness = 0;
        for (int j = 0; j < s->strains; j++)
            stiffness += fabs(C[i * s->strains + j]);
        worst = worst_of(worst, fabs(sigma[i]) / (stiffness * s->length));
    }
    return worst;
}

/* Largest difference between the derivative of the energy and the stress about the arc, of the
 * stress there. */
static double error_of_stress(element_subject *s)
{
    const double h = 1e-5 * s->length;
    double e[STRAINS], sigma[STRAINS], largest = 0, worst = 0;
    for (int i = 0; i < s->strains; i++)
        e[i] = 0.01 * s->length * cos(2.3 * i + 0.7);
    stress_at(s, e, &(stress_output){.sigma = sigma});
    for (int i = 0; i < s->strains; i++) {
        double energy[2];
        for (int k = 0; k < 2; k++) {
            e[i] += k == 0 ? h : -2 * h;
            stress_at(s, e, &(stress_output){.energy = &energy[k]});
        }
        e[i] += h;
        worst = worst_of(worst, fabs((energy[0] - energy[1]) / (2 * h) - sigma[i]));
        largest = fmax(largest, fabs(sigma[i]));
    }
    return worst / largest;
}

/* The same of the tangent along the strain that the prestress makes, and the geometric
 * stiffness. */
static double error_of_geometric(element_subject *s)
{
    const int n = s->strains;
    double e[STRAINS] = {0}, v[STRAINS], sigma[STRAINS] = {0}, C[3][STRAINS * STRAINS],
           G[STRAINS * STRAINS] = {0}, largest = 0, worst = 0;
    stress_at(s, e, &(stress_output){.C = C[0]});
    for (int i = 0; i < n; i++)
        v[i] = s->length * cos(1.9 * i + 0.2);
    dense_mul_vec(n, n, C[0], v, sigma);
    if (s->chosen->type->geometric != NULL)
        s->chosen->type->geometric(s->data, sigma, G);
    for (int k = 1; k < 3; k++) {
        for (int i = 0; i < n; i++)
            e[i] = (k == 1 ? 1e-5 : -1e-5) * v[i];
        stress_at(s, e, &(stress_output){.C = C[k]});
    }
    for (int i = 0; i < n * n; i++) {
        worst = worst_of(worst, fabs((C[1][i] - C[2][i]) / 2e-5 - G[i]));
        largest = fmax(largest, fabs(C[0][i]));
    }
    return worst / largest;
}

static void arcs(const formulation *chosen, const section *c)
{
    const double most = chosen->type->limits & LIMIT_QUARTER_TURN ? 1.5 : 3;
    const double still[6] = {0}, motion[6] = {0.3, -0.2, 0.1, 0.7, -1.1, 0.4};
    uint64_t state = 20240101;
    double stress = 0, derived = 0, geometric = 0;
    fault f = {""};
    element_subject straight;
    const int whole = prepare(chosen, c, 0, &state, &straight, &f) == STATUS_OK &&
                      chosen->type->inner == NULL && error_of_geometric(&straight) < 1e-6;
    free(straight.data);
    for (int i = 0; i < ARCS; i++) {
        element_subject s;
        const status outcome = prepare(chosen, c, most * (i + 1) / ARCS, &state, &s, &f);
        gsl_test(outcome != STATUS_OK, "%s: arc %d: %s", chosen->key, i, f.text);
        if (outcome == STATUS_OK) {
            stress =
                worst_of(stress, worst_of(stress_of_arc(&s, still), stress_of_arc(&s, motion)));
            if (chosen->type->inner ==
                NULL) { /* inner unknowns: their stress is that of another state */
                derived = worst_of(derived, error_of_stress(&s));
                geometric = whole ? worst_of(geometric, error_of_geometric(&s)) : 0;
            }
        }
        free(s.data);
    }
    gsl_test(!(stress < 1e-13), "%s: no stress along any arc up to %g rad (%.1e)", chosen->key,
             most, stress);
    gsl_test(!(derived < 1e-6), "%s: stress from energy about an arc (%.1e)", chosen->key, derived);
    gsl_test(!(geometric < 1e-6), "%s: geometric stiffness about an arc (%.1e)", chosen->key,
             geometric);
}

int main(void)
{
    const section c = rectangle();
    int offered = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        formulation chosen;
        if (!(type->offers & FEATURE_CURVATURE))
            continue;
        offered++;
        formulation_default(type, &chosen);
        arcs(&chosen, &c);
        for (int k = 0; k < parameter_count(type->options); k++)
            for (int choice = 0; choice < parameter_choices(parameter_at(type->options, k));
                 choice++)
                if (formulation_choice(type, k, choice, &chosen))
                    arcs(&chosen, &c);
    }
    gsl_test(offered == 0, "%d formulations offer initial curvature", offered);
    return gsl_test_summary();
}
