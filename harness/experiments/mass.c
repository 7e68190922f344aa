/* The mass matrix: symmetric, positive, of the mass and the moments of the beam, and it turns with
 * the element. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"
#include "harness/formulations/formulations.h"

enum { MASS_N = SPECIMEN_COORDINATES };

static double size_of(const double A[], int n, int i, int j)
{
    double largest = 0;
    for (int k = 0; k < n; k++)
        largest = fmax(largest, fabs(A[k * n + k]));
    return sqrt(fmax(fabs(A[i * n + i]), 1e-12 * largest) *
                fmax(fabs(A[j * n + j]), 1e-12 * largest));
}

static void symmetric(const specimen *s, const double A[], claim *one)
{
    const int n = s->coordinates;
    char first[SPECIMEN_WORDS], other[SPECIMEN_WORDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            claims_departs(one, fabs(A[i * n + j] - A[j * n + i]) / size_of(A, n, i, j),
                           "inertia: M entry %d, %d (%s, %s) is %.6g, and %.6g the other way "
                           "round%s",
                           i + 1, j + 1, specimen_coordinate(i, first),
                           specimen_coordinate(j, other), A[i * n + j], A[j * n + i], s->words);
}

/* Cholesky's factors of the matrix scaled to ones on its diagonal, and a little more. */
static void positive(const specimen *s, const double A[], claim *one)
{
    const int n = s->coordinates;
    double scaled[MASS_N * MASS_N];
    char where[SPECIMEN_WORDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double size = sqrt(fabs(A[i * n + i]) * fabs(A[j * n + j]));
            scaled[i * n + j] = (size > 0 ? A[i * n + j] / size : 0) + (i == j ? 1e-9 : 0);
        }
    const int pivot = dense_cholesky(n, scaled);
    claims_asks(one, pivot == 0,
                "inertia: M is not positive: some motion of the nodes up to coordinate %d (%s) has "
                "negative kinetic energy%s",
                pivot, specimen_coordinate(pivot > 0 ? pivot - 1 : 0, where), s->words);
}

/* v^T M v of a motion with the velocity omega x r + shift. */
static double energy(const specimen *s, const node_state x[], const double M[],
                     const double omega[3], const double shift[3])
{
    double v[MASS_N] = {0}, Mv[MASS_N];
    for (int k = 0; k < s->nodes; k++) {
        vec3_cross(omega, x[k].r, v + NODE_COORDINATES * k);
        for (int i = 0; i < 3; i++) {
            v[NODE_COORDINATES * k + i] += shift[i];
            v[NODE_COORDINATES * k + 3 + i] = omega[i];
        }
    }
    dense_mul_vec(s->coordinates, s->coordinates, M, v, Mv);
    return dense_dot(s->coordinates, v, Mv);
}

/* [kg/m] */
static double line_mass(const section *c)
{
    return c->matrices ? c->mass[0] : c->density * c->A;
}

static void total(const specimen *s, const node_state x[], const double M[], claim *one)
{
    static const double none[3] = {0, 0, 0};
    const double mass = line_mass(&s->section) * s->request.length;
    for (int c = 0; c < 3; c++) {
        double shift[3] = {0, 0, 0};
        shift[c] = 1;
        const double found = energy(s, x, M, none, shift);
        claims_departs(one, fabs(found / mass - 1),
                       "inertia: the mass along %c is %.6g kg, not rho A l = %.6g kg%s", "xyz"[c],
                       found, mass, s -> words);
    }
}

/* The matrix of an element that is turned as a whole is the turned one. */
static void carried(const specimen *s, const node_state x[], const double M[], claim *one)
{
    static const double turn[3] = {0.71, -1.93, 1.37};
    const int n = s->coordinates;
    node_state turned[ELEMENT_MAX_NODES];
    double other[MASS_N * MASS_N], T[MASS_N * MASS_N] = {0}, back[MASS_N * MASS_N] = {0},
                                              work[MASS_N * MASS_N], q[4], R[9];
    char first[SPECIMEN_WORDS], second[SPECIMEN_WORDS];
    specimen_carry(s, turn, x, turned);
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int b = 0; b < n; b += NODE_COORDINATES) {
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 3; j++)
                T[(b + i) * n + b + i / 3 * 3 + j] = R[3 * (i % 3) + j];
        T[(b + 6) * n + b + 6] = 1;
    }
    s->type.inertia(s->data, turned, NULL, &(inertia_output){.M = other});
    dense_add_congruence(n, n, T, other, back, work);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            claims_departs(one, fabs(back[i * n + j] - M[i * n + j]) / size_of(M, n, i, j),
                           "inertia: M entry %d, %d (%s, %s) of an element turned as a whole is, "
                           "turned back, %.6g, not %.6g%s",
                           i + 1, j + 1, specimen_coordinate(i, first),
                           specimen_coordinate(j, second), back[i * n + j], M[i * n + j], s->words);
}

/* Of a straight element that turns about its first node: rho l (Ip, Iy, Iz) beside what masses on
 * the line have: the difference that FEATURE_ROTARY_INERTIA makes, and all of it about the axis. */
static void moments(const specimen *s, claim *one)
{
    static const double none[3] = {0, 0, 0};
    const section *c = &s->section;
    specimen_request what = s->made;
    specimen line;
    node_state x[ELEMENT_MAX_NODES];
    double M[MASS_N * MASS_N], without[MASS_N * MASS_N];
    fault f = {""};
    if (c->matrices || s->made.curvature[0] != 0 || !(s->made.features & FEATURE_ROTARY_INERTIA))
        return;
    what.features &= ~(unsigned)FEATURE_ROTARY_INERTIA;
    specimen_state(s, 0, 1, x);
    s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M});
    if (specimen_make(&what, &line, &f) == STATUS_OK) {
        line.type.inertia(line.data, x, NULL, &(inertia_output){.M = without});
        const double second[3] = {c->Ip, c->Iy, c->Iz};
        for (int axis = 0; axis < 3; axis++) {
            double omega[3] = {0, 0, 0};
            omega[axis] = 1;
            const double moment = c->density * s->request.length * second[axis],
                         whole = energy(s, x, M, omega, none),
                         thin = energy(&line, x, without, omega, none),
                         found = whole - (axis == 0 ? 0 : thin);
            claims_departs(
                one, fabs(found / moment - 1),
                "inertia: the moment of inertia of the sections about %c is %.6g kg m^2, "
                "not rho l I = %.6g kg m^2%s",
                "xyz"[axis], found, moment, s -> words);
            if (axis == 0)
                claims_departs(one, fabs(thin / moment - 1),
                               "inertia: without rotary inertia the twist has %.6g kg m^2, not rho "
                               "l Ip = %.6g kg m^2: it has inertia always%s",
                               thin, moment, s->words);
        }
    }
    specimen_free(&line);
}

static void check(const specimen *s, claims *c)
{
    node_state x[ELEMENT_MAX_NODES];
    double M[MASS_N * MASS_N];
    claims_doing(c, "inertia%s", s->words);
    specimen_state(s, 0.05, 31, x);
    const status outcome = s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M});
    claims_asks(claims_open(c, "it has a mass matrix", 0), outcome == STATUS_OK,
                "inertia: status '%s' in a strained state%s", status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    symmetric(s, M, claims_open(c, "M is symmetric", 1e-13));
    positive(s, M, claims_open(c, "M is positive", 0));
    total(s, x, M, claims_open(c, "the mass is that of the beam", 1e-12));
    carried(s, x, M, claims_open(c, "M turns with the element", 1e-11));
    moments(s, claims_open(c, "moments of inertia are those of the beam", 1e-9));
}

void checks_mass(const formulation *chosen, claims *out)
{
    if (!(chosen->type->offers & FEATURE_MASS) || chosen->type->inertia == NULL) {
        claims_not_made(out, "M is symmetric",
                        chosen->type->offers & FEATURE_MASS
                            ? "has no inertia of its own: it has that of the displacement field"
                            : "offers no mass");
        return;
    }
    specimens_each(chosen, out, check);
}
