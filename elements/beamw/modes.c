/* J Eq. 7, its gradient (J Eq. 13, three rows of which are misprinted) and its second derivatives
 * in the exponential chart.  n is the unit vector from p to q; every bending mode is l0 times n . v
 * with v a vector fixed to a node. */
#include "elements/beamw/modes.h"

#include <string.h>

#include "elements/math/dense.h"

enum { N = 14, RP = 0, TP = 3, AP = 6, RQ = 7, TQ = 10, AQ = 13 };

typedef struct chord {
    double n[3], l; /* direction and length */
    double e1;      /* l - l0 */
} chord;

static chord chord_of(double l0, const node_state x[2])
{
    chord c;
    double d[3], moved[3];
    for (int i = 0; i < 3; i++) {
        moved[i] = x[1].u[i] - x[0].u[i];
        d[i] = x[1].r[i] - x[0].r[i];
    }
    c.l = sqrt(vec3_dot(d, d));
    c.e1 = vec3_elongation(d, moved, l0);
    for (int i = 0; i < 3; i++)
        c.n[i] = d[i] / c.l;
    return c;
}

static void column(const double R[9], int k, double v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = R[3 * i + k];
}

static void put(double row[N], int at, double factor, const double v[3])
{
    for (int i = 0; i < 3; i++)
        row[at + i] = factor * v[i];
}

/* Gradient of c n . v, v fixed to the node whose rotation columns begin at `rotation`. */
static void bending_row(const chord *b, double c, const double v[3], int rotation, double row[N])
{
    double across[3], moment[3];
    const double along = vec3_dot(b->n, v);
    for (int i = 0; i < 3; i++)
        across[i] = v[i] - along * b->n[i];
    vec3_cross(v, b->n, moment);
    put(row, RP, -c / b->l, across);
    put(row, RQ, c / b->l, across);
    put(row, rotation, c, moment);
}

static void add_block(double H[N * N], int row, int col, double factor, const double B[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            H[(row + i) * N + col + j] += factor * B[3 * i + j];
}

/* B and its transpose in the mirrored place. */
static void add_pair(double H[N * N], int row, int col, double factor, const double B[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            H[(row + i) * N + col + j] += factor * B[3 * i + j];
            H[(col + j) * N + row + i] += factor * B[3 * i + j];
        }
}

/* sym(u v^T) - (u . v) I: second derivative of u . v when one of them turns. */
static void turning(const double u[3], const double v[3], double B[9])
{
    const double dot = vec3_dot(u, v);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            B[3 * i + j] = (u[i] * v[j] + v[i] * u[j]) / 2 - (i == j ? dot : 0);
}

/* H += second derivatives of n . v, v fixed to the node at `rotation` (its scale contains the
 * stress). */
static void add_bending(const chord *b, const double v[3], int rotation, double H[N * N])
{
    const double dot = vec3_dot(b->n, v), l = b->l;
    double rr[9], rt[9], tt[9];
    const double skew[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double nn = b->n[i] * b->n[j];
            rr[3 * i + j] =
                (-(b->n[i] * v[j] + v[i] * b->n[j]) - (i == j ? dot : 0) + 3 * dot * nn) / (l * l);
            double P_skew = 0;
            for (int k = 0; k < 3; k++)
                P_skew += ((i == k) - b->n[i] * b->n[k]) * skew[3 * k + j];
            rt[3 * i + j] = P_skew / l;
        }
    turning(b->n, v, tt);
    add_block(H, RP, RP, 1, rr);
    add_block(H, RQ, RQ, 1, rr);
    add_pair(H, RP, RQ, -1, rr);
    add_pair(H, RQ, rotation, -1, rt);
    add_pair(H, RP, rotation, 1, rt);
    add_block(H, rotation, rotation, 1, tt);
}

/* H += c times the second derivatives of u . v, u fixed to p and v to q. */
static void add_twist(double c, const double u[3], const double v[3], double H[N * N])
{
    double same[9], cross[9];
    turning(u, v, same);
    const double dot = vec3_dot(u, v);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            cross[3 * i + j] = (i == j ? dot : 0) - v[i] * u[j];
    add_block(H, TP, TP, c, same);
    add_block(H, TQ, TQ, c, same);
    add_pair(H, TP, TQ, c, cross);
}

static void second_derivatives(double l0, const chord *b, const double yp[3], const double zp[3],
                               const double yq[3], const double zq[3], const double s[8],
                               double H[N * N])
{
    double vp[3], vq[3], rr[9];
    memset(H, 0, N * N * sizeof(double));
    for (int i = 0; i < 3; i++) {
        vp[i] = l0 * (s[4] * yp[i] - s[2] * zp[i]);
        vq[i] = l0 * (s[3] * zq[i] - s[5] * yq[i]);
        for (int j = 0; j < 3; j++)
            rr[3 * i + j] = ((i == j) - b->n[i] * b->n[j]) / b->l;
    }
    add_block(H, RP, RP, s[0], rr);
    add_block(H, RQ, RQ, s[0], rr);
    add_pair(H, RP, RQ, -s[0], rr);
    add_bending(b, vp, TP, H);
    add_bending(b, vq, TQ, H);
    add_twist(l0 / 2 * s[1], zp, yq, H);
    add_twist(-l0 / 2 * s[1], yp, zq, H);
}

static void gradient(double l0, const chord *b, const double yp[3], const double zp[3],
                     const double yq[3], const double zq[3], double J[8 * N])
{
    double first[3], second[3], moment[3];
    memset(J, 0, 8 * N * sizeof(double));
    put(J, RP, -1, b->n);
    put(J, RQ, 1, b->n);
    vec3_cross(zp, yq, first);
    vec3_cross(yp, zq, second);
    for (int i = 0; i < 3; i++)
        moment[i] = first[i] - second[i];
    put(J + N, TP, l0 / 2, moment);
    put(J + N, TQ, -l0 / 2, moment);
    bending_row(b, -l0, zp, TP, J + 2 * N);
    bending_row(b, l0, zq, TQ, J + 3 * N);
    bending_row(b, l0, yp, TP, J + 4 * N);
    bending_row(b, -l0, yq, TQ, J + 5 * N);
    J[6 * N + AP] = J[7 * N + AQ] = l0 * l0;
}

void beamw_modes_strain(double l0, const node_state x[2], strain_output *out)
{
    const chord b = chord_of(l0, x);
    double yp[3], zp[3], yq[3], zq[3];
    column(x[0].R, 1, yp);
    column(x[0].R, 2, zp);
    column(x[1].R, 1, yq);
    column(x[1].R, 2, zq);
    if (out->e != NULL) {
        out->e[0] = b.e1;
        out->e[1] = l0 / 2 * (vec3_dot(zp, yq) - vec3_dot(yp, zq));
        out->e[2] = -l0 * vec3_dot(b.n, zp);
        out->e[3] = l0 * vec3_dot(b.n, zq);
        out->e[4] = l0 * vec3_dot(b.n, yp);
        out->e[5] = -l0 * vec3_dot(b.n, yq);
        out->e[6] = l0 * l0 * x[0].a;
        out->e[7] = l0 * l0 * x[1].a;
    }
    if (out->J != NULL)
        gradient(l0, &b, yp, zp, yq, zq, out->J);
    if (out->s != NULL && out->H != NULL)
        second_derivatives(l0, &b, yp, zp, yq, zq, out->s, out->H);
}
