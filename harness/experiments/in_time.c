/* Checks of the inertia forces in transient analysis. The forces required by a motion follow from
 * the kinetic energy T = 1/2 x' . M x' by Lagrange's equations: force = d(M x')/dt + p x w - dT/dx.
 * The term p x w acts on the rotations of each node, where p is the part of M x' for these
 * rotations and w is the angular velocity of the node. x' and the derivatives refer to spatial
 * rotations. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"

enum { N = TEST_ELEMENT_COORDINATES };

typedef struct moving_place {
    test_element_stencil at;
    const double *rate; /* [7n] */
} moving_place;

static int momenta_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const moving_place *m = context;
    const test_element *s = m->at.s;
    node_state x[ELEMENT_MAX_NODES];
    double M[N * N];
    test_element_moved(&m->at, i, si, j, sj, x);
    const double rate[N] = {0};
    const status outcome =
        s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M, .rate = rate});
    dense_mul_vec(s->coordinates, s->coordinates, M, m->rate, values);
    return (int)outcome;
}

static void by_differences(const moving_place *m, const double M[], double h[])
{
    const test_element *s = m->at.s;
    const int n = s->coordinates;
    double p[N], column[N];
    dense_mul_vec(n, n, M, m->rate, p);
    memset(h, 0, (size_t)n * sizeof *h);
    for (int k = 0; k < s->nodes; k++)
        vec3_cross(p + NODE_COORDINATES * k + 3, m->rate + NODE_COORDINATES * k + 3,
                   h + NODE_COORDINATES * k + 3);
    for (int i = 0; i < n; i++) {
        const double unit = test_element_unit(s, i);
        stencil_first(momenta_at, m, n, i, column);
        for (int j = 0; j < n; j++)
            h[j] += column[j] / unit * m->rate[i];
        h[i] -= dense_dot(n, column, m->rate) / unit / 2;
    }
}

static double size_of(const test_element *s, const double F[])
{
    double size = 0;
    for (int i = 0; i < s->coordinates; i++)
        size = fmax(size, fabs(F[i]) * test_element_unit(s, i));
    return size;
}

static void compare(const test_element *s, const double found[], const double right[], double size,
                    const char *what, check_result *one)
{
    char where[TEST_ELEMENT_WORDS];
    for (int i = 0; i < s->coordinates; i++)
        checks_deviation(
            one, checks_relative(fabs(found[i] - right[i]) * test_element_unit(s, i), size),
            "inertia: the inertia force in coordinate %d (%s) is %.6g, but %.6g according to %s; "
            "correct 'taken'%s",
            i + 1, test_element_coordinate(s, i, where), found[i], right[i], what, s->words);
}

/* Checks that C is the derivative of the inertia forces with respect to the rates. */
static void check_rates(const test_element *s, const node_state x[], const double rate[],
                        const double C[], double size, check_result *one)
{
    const int n = s->coordinates;
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    double moved[N], taken[2][N];
    memcpy(moved, rate, (size_t)n * sizeof *moved);
    for (int j = 0; j < n; j++) {
        const double step = test_element_unit(s, j);
        for (int side = 0; side < 2; side++) {
            moved[j] = rate[j] + (side ? step : -step);
            s->type.inertia(s->data, x, NULL,
                            &(inertia_output){.rate = moved, .taken = taken[side]});
        }
        moved[j] = rate[j];
        for (int i = 0; i < n; i++) {
            const double found = (taken[1][i] - taken[0][i]) / (2 * step);
            checks_deviation(one,
                             fabs(C[n * i + j] - found) * test_element_unit(s, i) * step / size,
                             "inertia: entry %d, %d (%s, %s) of C is %.6g, but finite differences "
                             "of the inertia forces give %.6g; correct C%s",
                             i + 1, j + 1, test_element_coordinate(s, i, first),
                             test_element_coordinate(s, j, other), C[n * i + j], found, s->words);
        }
    }
}

static void check_turned(const test_element *s, const node_state x[], const inertia_output *out,
                         double size, check_result *one)
{
    static const double turn[3] = {0.71, -1.93, 1.37};
    const int n = s->coordinates;
    node_state turned[ELEMENT_MAX_NODES];
    double q[4], R[9], rate[N], acceleration[N], taken[N], right[N];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    test_element_rigid_motion(s, turn, x, turned);
    memcpy(rate, out->rate, (size_t)n * sizeof *rate);
    memcpy(acceleration, out->acceleration, (size_t)n * sizeof *rate);
    memcpy(right, out->taken, (size_t)n * sizeof *right);
    for (int at = 0; at < n; at += NODE_COORDINATES)
        for (int part = at; part < at + 6; part += 3) {
            mat3_mul_vec(R, out->rate + part, rate + part);
            mat3_mul_vec(R, out->acceleration + part, acceleration + part);
            mat3_mul_vec(R, out->taken + part, right + part);
        }
    s->type.inertia(s->data, turned, NULL,
                    &(inertia_output){.rate = rate, .acceleration = acceleration, .taken = taken});
    compare(s, taken, right, size, "the same element rotated as a whole", one);
}

static void check_one(const test_element *s, check_results *c)
{
    const int n = s->coordinates;
    if (n > 2 * NODE_COORDINATES)
        return;
    node_state x[ELEMENT_MAX_NODES];
    double numbers[2 * N], rate[N], acceleration[N], M[N * N], C[N * N], h[N], taken[N], right[N];
    const moving_place place = {{s, x}, rate};
    test_element_state(s, 0.2, 31, x);
    test_element_numbers(2 * n, 77, numbers);
    for (int i = 0; i < n; i++) {
        rate[i] = 40 * numbers[i] * test_element_unit(s, i);
        acceleration[i] = 900 * numbers[n + i] * test_element_unit(s, i);
    }
    checks_current(c, "inertia in time%s", s->words);
    inertia_output out = {.M = M, .rate = rate, .taken = h, .C = C};
    const status outcome = s->type.inertia(s->data, x, NULL, &out);
    checks_require(checks_open(c, "the element has inertia during a motion", 0),
                   outcome == STATUS_OK,
                   "inertia: the status of a moderately strained state in motion is '%s'; compute "
                   "its inertia forces%s",
                   status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    by_differences(&place, M, right);
    const double size = size_of(s, right);
    compare(s, h, right, size, "finite differences of the kinetic energy",
            checks_open(c, "inertia forces derive from the energy", 1e-8));
    check_rates(s, x, rate, C, size,
                checks_open(c, "C is the derivative with respect to the rates", 1e-11));
    dense_mul_vec(n, n, M, acceleration, right);
    for (int i = 0; i < n; i++)
        right[i] += h[i];
    out = (inertia_output){.rate = rate, .acceleration = acceleration, .taken = taken};
    s->type.inertia(s->data, x, NULL, &out);
    compare(s, taken, right, size_of(s, right),
            "M times the accelerations plus the forces without accelerations",
            checks_open(c, "accelerations are multiplied by M", 1e-12));
    check_turned(s, x, &out, size_of(s, right),
                 checks_open(c, "inertia forces rotate with the element", 1e-11));
}

static void check(const test_element *s, check_results *c)
{
    test_element_request what = s->made;
    test_element line;
    fault f = {""};
    check_one(s, c);
    if (s->section.matrices || !(s->made.features & FEATURE_ROTARY_INERTIA))
        return;
    what.features &= ~(unsigned)FEATURE_ROTARY_INERTIA;
    if (test_element_make(&what, &line, &f) == STATUS_OK)
        check_one(&line, c);
    test_element_free(&line);
}

void checks_in_time(const formulation *chosen, check_results *out)
{
    if (!element_spreads(chosen->type, chosen->option)) {
        checks_not_made(out, "inertia forces derive from the energy",
                        chosen->type->inertia == NULL
                            ? "beamwork computes its inertia"
                            : "during motions the mass of the element is lumped at its nodes");
        return;
    }
    test_elements_each(chosen, out, check);
}
