/* Checks of the inertia forces in transient analysis. The forces required by a motion derive from
 * the kinetic energy T = 1/2 x' . M x' by Lagrange's equations: force = d(M x')/dt + p x w - dT/dx.
 * The term p x w applies to the rotations of each node, where p is the part of M x' for the node
 * and w is the angular velocity of the node. x' and the derivatives refer to spatial rotations. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"

enum { N = SPECIMEN_COORDINATES };

/* State and rates at which the derivatives of M x' are computed. */
typedef struct moving_place {
    specimen_place at;
    const double *rate; /* [7n] */
} moving_place;

static int momenta_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const moving_place *m = context;
    const specimen *s = m->at.s;
    node_state x[ELEMENT_MAX_NODES];
    double M[N * N];
    specimen_moved(&m->at, i, si, j, sj, x);
    const double rate[N] = {0};
    const status outcome =
        s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M, .rate = rate});
    dense_mul_vec(s->coordinates, s->coordinates, M, m->rate, values);
    return (int)outcome;
}

/* Computes the forces required by a motion without accelerations, using finite differences. */
static void by_differences(const moving_place *m, const double M[], double h[])
{
    const specimen *s = m->at.s;
    const int n = s->coordinates;
    double p[N], column[N];
    dense_mul_vec(n, n, M, m->rate, p);
    memset(h, 0, (size_t)n * sizeof *h);
    for (int k = 0; k < s->nodes; k++)
        vec3_cross(p + NODE_COORDINATES * k + 3, m->rate + NODE_COORDINATES * k + 3,
                   h + NODE_COORDINATES * k + 3);
    for (int i = 0; i < n; i++) {
        const double unit = specimen_unit(s, i);
        stencil_first(momenta_at, m, n, i, column);
        for (int j = 0; j < n; j++)
            h[j] += column[j] / unit * m->rate[i];
        h[i] -= dense_dot(n, column, m->rate) / unit / 2;
    }
}

static double size_of(const specimen *s, const double F[])
{
    double size = 0;
    for (int i = 0; i < s->coordinates; i++)
        size = fmax(size, fabs(F[i]) * specimen_unit(s, i));
    return size;
}

static void compare(const specimen *s, const double found[], const double right[], double size,
                    const char *what, claim *one)
{
    char where[SPECIMEN_WORDS];
    for (int i = 0; i < s->coordinates; i++)
        claims_departs(
            one, claims_share(fabs(found[i] - right[i]) * specimen_unit(s, i), size),
            "inertia: the inertia force in coordinate %d (%s) is %.6g, but according to %s it is "
            "%.6g%s",
            i + 1, specimen_coordinate(s, i, where), found[i], what, right[i], s->words);
}

/* Checks that C is the derivative of the inertia forces with respect to the rates. These forces are
 * quadratic in the rates, so central differences are exact. */
static void check_rates(const specimen *s, const node_state x[], const double rate[],
                        const double C[], double size, claim *one)
{
    const int n = s->coordinates;
    char first[SPECIMEN_WORDS], other[SPECIMEN_WORDS];
    double moved[N], taken[2][N];
    memcpy(moved, rate, (size_t)n * sizeof *moved);
    for (int j = 0; j < n; j++) {
        const double step = specimen_unit(s, j);
        for (int side = 0; side < 2; side++) {
            moved[j] = rate[j] + (side ? step : -step);
            s->type.inertia(s->data, x, NULL,
                            &(inertia_output){.rate = moved, .taken = taken[side]});
        }
        moved[j] = rate[j];
        for (int i = 0; i < n; i++) {
            const double found = (taken[1][i] - taken[0][i]) / (2 * step);
            claims_departs(
                one, fabs(C[n * i + j] - found) * specimen_unit(s, i) * step / size,
                "inertia: entry %d, %d (%s, %s) of C is %.6g, but finite differences of the "
                "inertia forces give %.6g%s",
                i + 1, j + 1, specimen_coordinate(s, i, first), specimen_coordinate(s, j, other),
                C[n * i + j], found, s->words);
        }
    }
}

/* Checks that rotating the whole element and its rates rotates the required forces. */
static void check_turned(const specimen *s, const node_state x[], const inertia_output *out,
                         double size, claim *one)
{
    static const double turn[3] = {0.71, -1.93, 1.37};
    const int n = s->coordinates;
    node_state turned[ELEMENT_MAX_NODES];
    double q[4], R[9], rate[N], acceleration[N], taken[N], right[N];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    specimen_carry(s, turn, x, turned);
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

static void check_one(const specimen *s, claims *c)
{
    const int n = s->coordinates;
    if (n > 2 * NODE_COORDINATES) /* only elements with two nodes are checked */
        return;
    node_state x[ELEMENT_MAX_NODES];
    double numbers[2 * N], rate[N], acceleration[N], M[N * N], C[N * N], h[N], taken[N], right[N];
    const moving_place place = {{s, x}, rate};
    specimen_state(s, 0.2, 31, x);
    specimen_numbers(2 * n, 77, numbers);
    for (int i = 0; i < n; i++) {
        rate[i] = 40 * numbers[i] * specimen_unit(s, i);
        acceleration[i] = 900 * numbers[n + i] * specimen_unit(s, i);
    }
    claims_doing(c, "inertia in time%s", s->words);
    inertia_output out = {.M = M, .rate = rate, .taken = h, .C = C};
    const status outcome = s->type.inertia(s->data, x, NULL, &out);
    claims_asks(claims_open(c, "the element has inertia during a motion", 0), outcome == STATUS_OK,
                "inertia: status '%s' in time%s", status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    by_differences(&place, M, right);
    const double size = size_of(s, right);
    compare(s, h, right, size, "finite differences of the kinetic energy",
            claims_open(c, "inertia forces derive from the energy", 1e-8));
    check_rates(s, x, rate, C, size,
                claims_open(c, "C is the derivative with respect to the rates", 1e-11));
    dense_mul_vec(n, n, M, acceleration, right);
    for (int i = 0; i < n; i++)
        right[i] += h[i];
    out = (inertia_output){.rate = rate, .acceleration = acceleration, .taken = taken};
    s->type.inertia(s->data, x, NULL, &out);
    compare(s, taken, right, size_of(s, right),
            "M times the accelerations plus the forces without accelerations",
            claims_open(c, "accelerations are multiplied by M", 1e-12));
    check_turned(s, x, &out, size_of(s, right),
                 claims_open(c, "inertia forces rotate with the element", 1e-11));
}

/* Runs the checks, and repeats them without rotary inertia, so that only the twist has a moment of
 * inertia. The checks are not repeated if the section is given by matrices or the type has no
 * rotary inertia. */
static void check(const specimen *s, claims *c)
{
    specimen_request what = s->made;
    specimen line;
    fault f = {""};
    check_one(s, c);
    if (s->section.matrices || !(s->made.features & FEATURE_ROTARY_INERTIA))
        return;
    what.features &= ~(unsigned)FEATURE_ROTARY_INERTIA;
    if (specimen_make(&what, &line, &f) == STATUS_OK)
        check_one(&line, c);
    specimen_free(&line);
}

void checks_in_time(const formulation *chosen, claims *out)
{
    if (!element_spreads(chosen->type, chosen->option)) {
        claims_not_made(out, "inertia forces derive from the energy",
                        "during motions the mass of the element is lumped at its nodes");
        return;
    }
    specimens_each(chosen, out, check);
}
