/* Inertia of every formulation that has one, with every mass it offers, with and without rotary
 * inertia, in a strained state: mass, symmetry, and what a rotating frame does. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/matrices.h"
#include "elements/test/nodes.h"
#include "elements/test/worst.h"
#include "harness/model/test/inertia_subject.h"

static const element_rotating_frame turning = {.omega = {31.3, -17.9, 23.7},
                                               .centre = {0.213, -0.147, 0.089}};

/* Largest |A[i][j] - sign A[j][i]| beside the largest entry. */
static double departure(int n, const double A[], double sign)
{
    double worst = 0, largest = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            worst = worst_of(worst, fabs(A[i * n + j] - sign * A[j * n + i]));
            largest = fmax(largest, fabs(A[i * n + j]));
        }
    return worst / largest;
}

static void at_rest(const inertia_subject *s, const node_state x[])
{
    double M[MOST * MOST], v[MOST] = {0}, Mv[MOST];
    const double mass = s->section.density * s->section.A * s->length;
    gsl_test(s->type->inertia(s->data, x, NULL, &(inertia_output){.M = M}) != STATUS_OK,
             "%s: mass matrix", s->name);
    gsl_test(!(departure(s->coordinates, M, 1) < 1e-14), "%s: mass matrix is symmetric", s->name);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < s->coordinates; i++)
            v[i] = i % 7 == c;
        dense_mul_vec(s->coordinates, s->coordinates, M, v, Mv);
        gsl_test_rel(dense_dot(s->coordinates, v, Mv), mass, 1e-13, "%s: total mass, direction %d",
                     s->name, c);
    }
}

/* The motion v of the frame itself has the kinetic energy 1/2 v^T M v = -V, and G v = -2 F. */
static void own_motion(const inertia_subject *s, const node_state x[], int rotary,
                       const inertia_output *out)
{
    const int n = s->coordinates;
    double v[MOST] = {0}, Mv[MOST], Gv[MOST], worst = 0, largest = 0;
    for (int k = 0; k < s->nodes; k++) {
        const double r[3] = {x[k].r[0] - turning.centre[0], x[k].r[1] - turning.centre[1],
                             x[k].r[2] - turning.centre[2]};
        vec3_cross(turning.omega, r, v + NODE_COORDINATES * k);
        memcpy(v + NODE_COORDINATES * k + 3, turning.omega, sizeof turning.omega);
    }
    dense_mul_vec(n, n, out->M, v, Mv);
    dense_mul_vec(n, n, out->G, v, Gv);
    if (rotary)
        gsl_test_rel(dense_dot(n, v, Mv) / 2, -*out->potential, 1e-13,
                     "%s: the frame's own motion has the centrifugal energy", s->name);
    for (int i = 0; i < n; i++) {
        const double size = i % 7 < 3 ? 1 : s->length;
        worst = worst_of(worst, fabs(Gv[i] + 2 * out->force[i]) / size);
        largest = fmax(largest, fabs(out->force[i]) / size);
    }
    gsl_test(
        !(worst <= 1e-13 * largest),
        "%s: the Coriolis force of the frame's own motion is twice the centrifugal force (%.1e)",
        s->name, worst / largest);
}

/* F = -dV/dx and N = d2V/dx2 by differences along a line. */
static void derivatives(const inertia_subject *s, const node_state x[], const inertia_output *out)
{
    enum { SAMPLES = 5 };
    const int n = s->coordinates;
    const double h = 2e-3;
    double d[MOST], Nd[MOST], V[SAMPLES];
    nodes_increments(s->nodes, s->length, 1, 37, d);
    for (int k = 0; k < SAMPLES; k++) {
        node_state at[ELEMENT_MAX_NODES];
        memcpy(at, x, (size_t)s->nodes * sizeof *at);
        nodes_move(s->nodes, (k - 2) * h, d, at);
        s->type->inertia(s->data, at, &turning, &(inertia_output){.potential = &V[k]});
    }
    dense_mul_vec(n, n, out->N, d, Nd);
    const double first = (V[0] - 8 * V[1] + 8 * V[3] - V[4]) / (12 * h);
    const double second = (-V[0] + 16 * V[1] - 30 * V[2] + 16 * V[3] - V[4]) / (12 * h * h);
    gsl_test_rel(-dense_dot(n, out->force, d), first, 1e-8,
                 "%s: centrifugal force is the gradient of its potential", s->name);
    gsl_test_rel(dense_dot(n, d, Nd), second, 1e-6, "%s: and its stiffness the second derivative",
                 s->name);
}

static void turning_frame(const inertia_subject *s, const node_state x[], int rotary)
{
    double V, F[MOST], M[MOST * MOST], N[MOST * MOST], G[MOST * MOST];
    inertia_output out = {.M = M, .potential = &V, .force = F, .N = N, .G = G};
    gsl_test(s->type->inertia(s->data, x, &turning, &out) != STATUS_OK,
             "%s: inertia in a rotating frame", s->name);
    gsl_test(!(departure(s->coordinates, N, 1) < 1e-14), "%s: centrifugal stiffness is symmetric",
             s->name);
    gsl_test(!(departure(s->coordinates, G, -1) < 1e-14), "%s: gyroscopic matrix is skew", s->name);
    own_motion(s, x, rotary, &out);
    derivatives(s, x, &out);
}

/* Centrifugal energy [J] of a uniformly twisted element whose amplitudes are its twist rate. */
static double twisted_energy(const element_type *type, const double options[], unsigned features,
                             double angle, inertia_subject *s)
{
    double d[MOST] = {0}, V = NAN;
    node_state x[ELEMENT_MAX_NODES];
    if (!inertia_subject_prepare(type, options, features, s)) {
        free(s->data);
        return NAN;
    }
    nodes_straight(s->nodes, s->length, x);
    for (int k = 0; k < s->nodes; k++) {
        const double turn = angle * k / (s->nodes - 1), ys = s->section.ys, zs = s->section.zs;
        d[NODE_COORDINATES * k + 1] =
            ys * (1 - cos(turn)) + zs * sin(turn); /* about the shear centre: nothing shears */
        d[NODE_COORDINATES * k + 2] = zs * (1 - cos(turn)) - ys * sin(turn);
        d[NODE_COORDINATES * k + 3] = turn;
        d[NODE_COORDINATES * k + 6] = sin(angle) / s->length; /* e2 of BEAMW is a sine */
    }
    nodes_move(s->nodes, 1, d, x);
    s->type->inertia(s->data, x, &turning, &(inertia_output){.potential = &V});
    free(s->data);
    return V;
}

/* Fibres that warping moves along the beam turn at another distance from the axis: -1/2 int rho
 * (omega a)^2 |Omega x e_x|^2 dV. */
static void warping_in_a_turning_frame(const element_type *type, const double options[], int choice)
{
    const double angle = 0.005;
    const unsigned features = type->offers & ~(unsigned)FEATURE_CURVATURE;
    inertia_subject s = {0};
    if (!(features & FEATURE_WARPING) || !(features & FEATURE_ROTARY_INERTIA))
        return;
    snprintf(s.name, sizeof s.name, "%s, mass %d", type->name, choice);
    const double with = twisted_energy(type, options, features, angle, &s);
    const double without =
        twisted_energy(type, options, features & ~(unsigned)FEATURE_WARPING, angle, &s);
    const double a = sin(angle) / s.length, *w = turning.omega;
    const double expected =
        -s.section.density * s.section.Iw * s.length * a * a * (w[1] * w[1] + w[2] * w[2]) / 2;
    gsl_test_rel(with - without, expected, 2e-4, "%s: centrifugal energy of warping", s.name);
}

/* An element that is prepared, in a strained state. */
static void strained(const inertia_subject *s, int rotary)
{
    double d[MOST];
    node_state x[ELEMENT_MAX_NODES];
    nodes_straight(s->nodes, s->length, x);
    nodes_increments(s->nodes, s->length, 0.05, 31, d);
    nodes_move(s->nodes, 1, d, x);
    at_rest(s, x);
    turning_frame(s, x, rotary);
}

static void check(const element_type *type, const double options[], int choice, unsigned left_out)
{
    inertia_subject s = {0};
    const unsigned features = type->offers & ~(unsigned)FEATURE_CURVATURE & ~left_out;
    const int rotary = (features & FEATURE_ROTARY_INERTIA) != 0;
    snprintf(s.name, sizeof s.name, "%s, mass %d%s%s", type->name, choice, rotary ? ", rotary" : "",
             features & FEATURE_WARPING ? ", warping" : "");
    if (inertia_subject_prepare(type, options, features, &s))
        strained(&s, rotary);
    free(s.data);
}

static void every_way(const element_type *type, const double options[], int choice)
{
    static const unsigned left_out[] = {0, FEATURE_ROTARY_INERTIA, FEATURE_WARPING,
                                        FEATURE_WARPING | FEATURE_SHEAR};
    for (size_t k = 0; k < sizeof left_out / sizeof left_out[0]; k++)
        check(type, options, choice, left_out[k]);
    warping_in_a_turning_frame(type, options, choice);
}

/* The mass matrix of one node of a straight element is half that of the slice times its length. */
static void slice(const inertia_subject *s)
{
    double M[MOST * MOST], worst = 0;
    node_state x[ELEMENT_MAX_NODES];
    nodes_straight(s->nodes, s->length, x);
    s->type->inertia(s->data, x, NULL, &(inertia_output){.M = M});
    for (int i = 0; i < 36; i++)
        worst = worst_of(
            worst, fabs(M[s->coordinates * (i / 6) + i % 6] - s->length / 2 * s->section.mass[i]) /
                       (s->length * s->section.mass[0]));
    gsl_test(!(worst < 1e-16), "%s: mass matrix of a node (%.1e)", s->name, worst);
}

/* Sections by their matrices have all their inertia, whatever is asked for. */
static void by_matrices(const element_type *type, const double options[], int *carry)
{
    const section_spec spec = matrices_spec(1);
    inertia_subject s = {0};
    if (!(type->offers & FEATURE_COUPLED))
        return;
    snprintf(s.name, sizeof s.name, "%s, by matrices", type->name);
    s.section = sections_computed(&spec);
    if (inertia_subject_prepare_of(type, options, FEATURE_MASS | FEATURE_SHEAR, &s)) {
        strained(&s, 1);
        *carry += 1;
        if (s.nodes == 2)
            slice(&s);
    }
    free(s.data);
}

int main(void)
{
    int carry = 0;
    inertia_subject_each(every_way);
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        double options[ELEMENT_MAX_OPTIONS] = {0};
        parameter_defaults(registry_formulations[i]->options, options);
        by_matrices(registry_formulations[i], options, &carry);
    }
    gsl_test(carry < 1, "%d formulations carry sections by their matrices", carry);
    return gsl_test_summary();
}
