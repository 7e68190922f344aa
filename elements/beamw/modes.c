#include "elements/beamw/modes.h"

#include <math.h>
#include <string.h>

#include "elements/beamw/screw.h"

enum { N = MODES_COORDINATES };

typedef struct chord {
    double n[3], l, turns[3], grows; /* time derivatives n' and l' */
} chord;

static void chord_of(const node_state x[2], const double rate[N], chord *out)
{
    double d[3], moves[3];
    for (int i = 0; i < 3; i++) {
        d[i] = x[1].r[i] - x[0].r[i];
        moves[i] = rate[MODES_RQ + i] - rate[MODES_RP + i];
    }
    out->l = sqrt(vec3_dot(d, d));
    for (int i = 0; i < 3; i++)
        out->n[i] = d[i] / out->l;
    out->grows = vec3_dot(out->n, moves);
    for (int i = 0; i < 3; i++)
        out->turns[i] = (moves[i] - out->grows * out->n[i]) / out->l;
}

static void axis_of(const node_state *x, const double w[3], int k, double v[3], double turns[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = x->R[3 * i + k];
    vec3_cross(w, v, turns);
}

/* Computes the time derivative of the gradient of c n . v, where v is an axis of the node whose
 * rotations begin at coordinate `rotation`. */
static void bending(const chord *d, double c, const node_state *x, int k, int rotation,
                    const double rate[N], double row[N])
{
    double v[3], turns[3], first[3], second[3];
    axis_of(x, rate + rotation, k, v, turns);
    const double along = vec3_dot(d->n, v), factor = c / d->l,
                 changes = vec3_dot(d->turns, v) + vec3_dot(d->n, turns);
    vec3_cross(turns, d->n, first);
    vec3_cross(v, d->turns, second);
    for (int i = 0; i < 3; i++) {
        row[MODES_RQ + i] = factor * (turns[i] - changes * d->n[i] - along * d->turns[i] -
                                      d->grows / d->l * (v[i] - along * d->n[i]));
        row[MODES_RP + i] = -row[MODES_RQ + i];
        row[rotation + i] = c * (first[i] + second[i]);
    }
}

/* Adds c (a x b)' to `out`, where a' and b' are given. */
static void add_cross_rate(double c, const double a[3], const double a_rate[3], const double b[3],
                           const double b_rate[3], double out[3])
{
    double first[3], second[3];
    vec3_cross(a_rate, b, first);
    vec3_cross(a, b_rate, second);
    for (int i = 0; i < 3; i++)
        out[i] += c * (first[i] + second[i]);
}

static void torsion(double l0, const node_state x[2], const double rate[N], double row[N])
{
    double yp[3], zp[3], yq[3], zq[3], yp_rate[3], zp_rate[3], yq_rate[3], zq_rate[3];
    axis_of(&x[0], rate + MODES_TP, 1, yp, yp_rate);
    axis_of(&x[0], rate + MODES_TP, 2, zp, zp_rate);
    axis_of(&x[1], rate + MODES_TQ, 1, yq, yq_rate);
    axis_of(&x[1], rate + MODES_TQ, 2, zq, zq_rate);
    add_cross_rate(l0 / 2, zp, zp_rate, yq, yq_rate, row + MODES_TP);
    add_cross_rate(-l0 / 2, yp, yp_rate, zq, zq_rate, row + MODES_TP);
    for (int i = 0; i < 3; i++)
        row[MODES_TQ + i] = -row[MODES_TP + i];
}

/* Subtracts 1/2 w x J from the row, as the exponential chart requires. */
static void symmetrise(const double w[3], const double J[3], double row[3])
{
    double half[3];
    vec3_cross(w, J, half);
    for (int i = 0; i < 3; i++)
        row[i] -= half[i] / 2;
}

void beamw_modes_slopes(double l0, const node_state x[2], const double J[8 * N],
                        const double rate[N], double slope[8 * N])
{
    chord d;
    chord_of(x, rate, &d);
    memset(slope, 0, 8 * N * sizeof *slope);
    for (int i = 0; i < 3; i++) {
        slope[MODES_RQ + i] = d.turns[i];
        slope[MODES_RP + i] = -d.turns[i];
    }
    torsion(l0, x, rate, slope + N);
    bending(&d, -l0, &x[0], 2, MODES_TP, rate, slope + 2 * N);
    bending(&d, l0, &x[1], 2, MODES_TQ, rate, slope + 3 * N);
    bending(&d, l0, &x[0], 1, MODES_TP, rate, slope + 4 * N);
    bending(&d, -l0, &x[1], 1, MODES_TQ, rate, slope + 5 * N);
    for (int mode = 1; mode < 6; mode++) {
        symmetrise(rate + MODES_TP, J + N * mode + MODES_TP, slope + N * mode + MODES_TP);
        symmetrise(rate + MODES_TQ, J + N * mode + MODES_TQ, slope + N * mode + MODES_TQ);
    }
}

const double beamw_screw_power[SCREW_POWERS] = {
    0.041666666666666664,   0.0012152777777777778, 3.2035383597883595e-05, 8.202608300264551e-07,
    2.0835982071876168e-08, 5.281609967721337e-10, 1.3380902920268335e-11, 3.389576851489321e-13,
    8.585996549822947e-15,  2.174864550325223e-16, 5.509000201462976e-18,  1.3954463022310702e-19,
};

void beamw_screw_far_factors(double square, double f[SCREW_FACTORS])
{
    const double a = sqrt(square), s = sin(a), c = cos(a), tangent = tan(a / 2),
                 p = (s - a * c) / (s * s);
    const double slope = (a * s * s - 2 * c * (s - a * c)) /
                         (s * s * s); /* dp/da, where p is the derivative of a/sin a */
    double *nu = f + SCREW_NU, *mu = f + SCREW_MU, *tau = f + SCREW_TAU;
    mu[0] = a / s;
    mu[1] = p / (2 * a);
    nu[0] = (1 - mu[0]) / square;
    nu[1] = -(mu[1] + nu[0]) / square;
    nu[2] = -((slope - p / a) / (4 * square) + 2 * nu[1]) / square;
    tau[0] = tangent / a;
    tau[1] = ((1 + tangent * tangent) / 2 - tau[0]) / (2 * square);
}
