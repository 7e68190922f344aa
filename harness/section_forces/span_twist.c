#include "harness/section_forces/span_twist.h"

#include <string.h>

#include "elements/math/dense.h"

enum { TWIST_N = SPAN_GRID_POINTS };

/* Amplitudes [N] of the solution with the bimoment given at one end (0, 1) and the amplitude at the
 * other. */
static int amplitudes(const span_grid *g, const span_torsion *t, int end, double a[])
{
    double matrix[TWIST_N * TWIST_N];
    int pivot[TWIST_N];
    for (int i = 0; i < TWIST_N; i++) {
        const double soft = 1 + t->stiffness[i] * t->flexibility;
        for (int j = 0; j < TWIST_N; j++) {
            double second = 0;
            for (int k = 0; k < TWIST_N; k++)
                second += g->derivative[i][k] * g->derivative[k][j];
            matrix[i * TWIST_N + j] = t->EIw * second - (i == j ? t->stiffness[i] / soft : 0);
        }
        a[i] = -(t->torque[i] - t->stiffness[i] * t->shear[i]) / soft;
    }
    const int natural = end ? TWIST_N - 1 : 0, essential = TWIST_N - 1 - natural;
    for (int j = 0; j < TWIST_N; j++) {
        matrix[natural * TWIST_N + j] = t->EIw * g->derivative[natural][j];
        matrix[essential * TWIST_N + j] = j == essential ? t->EIw : 0;
    }
    a[natural] = t->bimoment[end];
    a[essential] = t->EIw * t->amplitude[1 - end];
    if (dense_lu(TWIST_N, matrix, pivot) != 0)
        return 1;
    dense_lu_solve(TWIST_N, 1, matrix, pivot, a);
    return 0;
}

static void add(const span_grid *g, const span_torsion *t, const double a[], const double share[],
                span_twist *out)
{
    for (int i = 0; i < TWIST_N; i++) {
        double slope = 0;
        for (int j = 0; j < TWIST_N; j++)
            slope += g->derivative[i][j] * a[j];
        const double warping = (t->torque[i] - t->stiffness[i] * (a[i] + t->shear[i])) /
                               (1 + t->stiffness[i] * t->flexibility);
        out->bimoment[i] += share[i] * t->EIw * slope;
        out->warping[i] += share[i] * warping;
        out->rate[i] += share[i] * (a[i] + t->flexibility * warping + t->shear[i]);
    }
}

int span_twist_solve(const span_grid *g, const span_torsion *t, span_twist *out)
{
    double a[TWIST_N], share[TWIST_N];
    memset(out, 0, sizeof *out);
    if (t->EIw == 0) {
        for (int i = 0; i < TWIST_N; i++)
            out->rate[i] = t->stiffness[i] != 0 ? t->torque[i] / t->stiffness[i] : 0;
        return 0;
    }
    for (int end = 0; end < 2; end++) {
        if (amplitudes(g, t, end, a) != 0)
            return 1;
        for (int i = 0; i < TWIST_N; i++)
            share[i] = end ? g->x[i] : 1 - g->x[i];
        add(g, t, a, share, out);
    }
    out->bimoment[0] = t->bimoment[0];
    out->bimoment[TWIST_N - 1] = t->bimoment[1];
    return 0;
}
