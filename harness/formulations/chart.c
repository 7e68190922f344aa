#include "harness/formulations/chart.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

void chart_move(const node_state x[], int nodes, const double step[], node_state out[])
{
    memcpy(out, x, (size_t)nodes * sizeof *x);
    for (int k = 0; k < nodes; k++, step += NODE_COORDINATES) {
        for (int i = 0; i < 3; i++) {
            out[k].r[i] += step[i];
            out[k].u[i] += step[i];
        }
        if (step[3] != 0 || step[4] != 0 || step[5] != 0) {
            double q[4], turn[9];
            rotation_exp(step + 3, q);
            rotation_matrix(q, turn);
            mat3_mul(turn, x[k].R, out[k].R);
        }
        out[k].a += step[6];
    }
}

double chart_unit(int c, double length)
{
    c %= NODE_COORDINATES;
    if (c < 3)
        return length;
    return c < 6 ? 1 : 1 / length;
}

/* 1 + a psi~ + b psi~^2. */
static void quadratic(const double psi[3], double a, double b, double T[9])
{
    const double p[9] = {0, -psi[2], psi[1], psi[2], 0, -psi[0], -psi[1], psi[0], 0};
    double square[9];
    mat3_mul(p, p, square);
    for (int i = 0; i < 9; i++)
        T[i] = (i % 4 == 0) + a * p[i] + b * square[i];
}

void chart_dexp(const double psi[3], double T[9])
{
    const double t = vec3_norm(psi), half = sin(t / 2);
    if (t < 1e-2) /* the next terms are below 1e-16 */
        quadratic(psi, 1. / 2 - t * t / 24 + t * t * t * t / 720,
                  1. / 6 - t * t / 120 + t * t * t * t / 5040, T);
    else
        quadratic(psi, 2 * half * half / (t * t), (t - sin(t)) / (t * t * t), T);
}

void chart_dexp_inverse(const double psi[3], double T[9])
{
    const double t = vec3_norm(psi);
    if (t < 1e-1) /* the next term is below 1e-16 */
        quadratic(psi, -1. / 2,
                  1. / 12 + t * t / 720 + t * t * t * t / 30240 + t * t * t * t * t * t / 1209600,
                  T);
    else
        quadratic(psi, -1. / 2, (1 - t / 2 / tan(t / 2)) / (t * t), T);
}
