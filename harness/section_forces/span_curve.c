#include "harness/section_forces/span_curve.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

enum { CURVE_N = SPAN_GRID_POINTS };

/* The turn over a gap of length h, in the axes at its beginning (Blanes, Casas, Ros, BIT 40, 2000):
 * R^T' = -kappa~ R^T at three Gauss points. */
static void turn_of(const span_grid *g, int gap, const double kappa[], double h, double out[3])
{
    double at[SPAN_GRID_GAUSS][3] = {{0}}, a[3], b[3], c[3], first[3], second[3], third[3],
           fourth[3];
    for (int k = 0; k < SPAN_GRID_GAUSS; k++)
        for (int j = 0; j < CURVE_N; j++)
            for (int i = 0; i < 3; i++)
                at[k][i] -= h * g->gauss[gap][k][j] * kappa[3 * j + i];
    for (int i = 0; i < 3; i++) {
        a[i] = at[1][i];
        b[i] = sqrt(15) / 3 * (at[2][i] - at[0][i]);
        c[i] = 10.0 / 3 * (at[2][i] - 2 * at[1][i] + at[0][i]);
    }
    vec3_cross(a, b, first);
    for (int i = 0; i < 3; i++) {
        third[i] = 2 * c[i] + first[i];
        fourth[i] = -20 * a[i] - c[i] + first[i];
    }
    vec3_cross(a, third, second);
    for (int i = 0; i < 3; i++)
        third[i] = b[i] - second[i] / 60;
    vec3_cross(fourth, third, second);
    for (int i = 0; i < 3; i++)
        out[i] = -(a[i] + c[i] / 12 + second[i] / 240);
}

/* Orientations, so that the last is that of q. */
static void turn(const span_grid *g, const span_frame *p, const span_frame *q, const double kappa[],
                 span_curve *out)
{
    double along[CURVE_N][4], end[4], missing[3];
    rotation_from_matrix(p->R, along[0]);
    rotation_from_matrix(q->R, end);
    for (int i = 0; i + 1 < CURVE_N; i++) {
        double step[3], by[4];
        turn_of(g, i, kappa, g->x[i + 1] - g->x[i], step);
        rotation_exp(step, by);
        rotation_compose(along[i], by, along[i + 1]);
    }
    rotation_between(along[CURVE_N - 1], end, missing);
    for (int i = 0; i < CURVE_N; i++) {
        const double part[3] = {g->x[i] * missing[0], g->x[i] * missing[1], g->x[i] * missing[2]};
        double by[4];
        rotation_exp(part, by);
        rotation_compose(by, along[i], along[i]);
        rotation_matrix(along[i], out->R[i]);
    }
    memcpy(out->R[0], p->R, sizeof out->R[0]);
    memcpy(out->R[CURVE_N - 1], q->R, sizeof out->R[0]);
}

void span_curve_between(const span_grid *g, const span_frame *p, const span_frame *q,
                        const double kappa[], const double gamma[], span_curve *out)
{
    double slope[CURVE_N][3];
    turn(g, p, q, kappa, out);
    for (int i = 0; i < CURVE_N; i++) {
        const double along[3] = {1 + gamma[3 * i], gamma[3 * i + 1], gamma[3 * i + 2]};
        mat3_mul_vec(out->R[i], along, slope[i]);
    }
    span_grid_integrate(g, 3, slope[0], out->r[0]);
    double missing[3];
    for (int k = 0; k < 3; k++)
        missing[k] = q->r[k] - p->r[k] - out->r[CURVE_N - 1][k];
    for (int i = 0; i < CURVE_N; i++)
        for (int k = 0; k < 3; k++)
            out->r[i][k] += p->r[k] + g->x[i] * missing[k];
}
