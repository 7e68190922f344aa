/* Moments of inertia of straight elements, and of masses at their nodes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/nodes.h"
#include "harness/catalogue/formulation.h"
#include "harness/model/test/inertia_subject.h"

/* Masses at the nodes of an element stand as the rule for loads does: trapezoids with two nodes,
 * Simpson's with three, whose second moment about the end is exact. The twist has the section's own
 * polar inertia, whatever gives it. */
static void lumped_moments(const element_type *type, const double options[], const char *name)
{
    inertia_subject s = {0};
    double M[MOST * MOST], x_moment = 0, polar = 0;
    node_state x[ELEMENT_MAX_NODES];
    const unsigned features = FEATURE_MASS | FEATURE_ROTARY_INERTIA;
    snprintf(s.name, sizeof s.name, "%s", name);
    s.type = type;
    s.length = 0.2385;
    s.nodes = element_nodes(type, options);
    s.coordinates = NODE_COORDINATES * s.nodes;
    inertia_subject_section(type, &s.section);
    s.section.Ip *= 1.3;
    const element_request request = {
        .section = &s.section, .length = s.length, .features = features, .options = options};
    s.data = calloc(1, type->data_size(&request));
    gsl_test(type->prepare(&request, s.data, NULL) != STATUS_OK, "%s: prepared", name);
    nodes_straight(s.nodes, s.length, x);
    type->inertia(s.data, x, NULL, &(inertia_output){.M = M});
    for (int k = 0; k < s.nodes; k++) {
        x_moment += M[(NODE_COORDINATES * k + 1) * (s.coordinates + 1)] * pow(x[k].r[0], 2);
        polar += M[(NODE_COORDINATES * k + 3) * (s.coordinates + 1)];
    }
    const double mass = s.section.density * s.section.A * s.length;
    gsl_test_rel(x_moment, mass * s.length * s.length / (s.nodes == 2 ? 2 : 3), 1e-13,
                 "%s: second moment of the masses", name);
    gsl_test_rel(polar, s.section.density * s.section.Ip * s.length, 1e-13, "%s: polar inertia",
                 name);
    free(s.data);
}

/* v^T M v of a straight element that turns about an axis through its first node at one radian a
 * second. */
static double turning_inertia(const element_type *type, const double options[], unsigned features,
                              int axis, inertia_subject *s)
{
    double M[MOST * MOST], v[MOST] = {0}, Mv[MOST], omega[3] = {0};
    node_state x[ELEMENT_MAX_NODES];
    omega[axis] = 1;
    if (!inertia_subject_prepare(type, options, features, s)) {
        free(s->data);
        return NAN;
    }
    nodes_straight(s->nodes, s->length, x);
    for (int k = 0; k < s->nodes; k++) {
        vec3_cross(omega, x[k].r, v + NODE_COORDINATES * k);
        memcpy(v + NODE_COORDINATES * k + 3, omega, sizeof omega);
    }
    s->type->inertia(s->data, x, NULL, &(inertia_output){.M = M});
    dense_mul_vec(s->coordinates, s->coordinates, M, v, Mv);
    free(s->data);
    return dense_dot(s->coordinates, v, Mv);
}

/* Of a rigid rotation: rho l (Ip, Iy, Iz), each about its own axis, beside what the masses on the
 * line have. */
static void moments_of_inertia(const element_type *type, const double options[], int choice)
{
    const unsigned features = type->offers & ~(unsigned)FEATURE_CURVATURE;
    inertia_subject s = {0};
    if (!(features & FEATURE_ROTARY_INERTIA))
        return;
    snprintf(s.name, sizeof s.name, "%s, mass %d", type->name, choice);
    for (int axis = 0; axis < 3; axis++) {
        const double whole = turning_inertia(type, options, features, axis, &s);
        const double line =
            turning_inertia(type, options, features & ~(unsigned)FEATURE_ROTARY_INERTIA, axis, &s);
        const section *c = &s.section;
        const double second[3] = {c->Ip, c->Iy, c->Iz},
                     moment = c->density * s.length * second[axis];
        gsl_test_rel(whole - (axis == 0 ? 0 : line), moment, 1e-10,
                     "%s: moment of inertia about %c", s.name, "xyz"[axis]);
        if (axis == 0)
            gsl_test_rel(line, moment, 1e-12, "%s: the twist has inertia always", s.name);
    }
}

static void lumped_elements(void)
{
    static const char *const name[] = {"geometrically_exact:nodes=2", "geometrically_exact:nodes=3",
                                       "collocation"};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        formulation chosen;
        gsl_test(formulation_parse(name[i], &chosen, NULL) != STATUS_OK, "%s", name[i]);
        lumped_moments(chosen.type, chosen.option, name[i]);
    }
}

int main(void)
{
    inertia_subject_each(moments_of_inertia);
    lumped_elements();
    return gsl_test_summary();
}
