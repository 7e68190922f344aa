#include "harness/section_forces/span_grid.h"

#include <math.h>

#include "elements/math/pi.h"
#include "elements/math/quadrature.h"

enum {
    GRID_N = SPAN_GRID_POINTS,
    EXACT = GRID_N / 2
}; /* Gauss points that integrate the polynomials */

void span_grid_at(const span_grid *g, double x, double share[])
{
    double sum = 0;
    for (int i = 0; i < GRID_N; i++)
        if (x == g->x[i]) {
            for (int j = 0; j < GRID_N; j++)
                share[j] = i == j;
            return;
        }
    for (int i = 0; i < GRID_N; i++)
        sum += share[i] = g->weight[i] / (x - g->x[i]);
    for (int i = 0; i < GRID_N; i++)
        share[i] /= sum;
}

static void make_integral(span_grid *g)
{
    double at[EXACT], w[EXACT], share[GRID_N];
    quadrature_points(EXACT, at, w);
    for (int j = 0; j < GRID_N; j++)
        g->integral[0][j] = 0;
    for (int i = 1; i < GRID_N; i++) {
        const double gap = g->x[i] - g->x[i - 1];
        for (int j = 0; j < GRID_N; j++)
            g->integral[i][j] = g->integral[i - 1][j];
        for (int k = 0; k < EXACT; k++) {
            span_grid_at(g, g->x[i - 1] + gap * at[k], share);
            for (int j = 0; j < GRID_N; j++)
                g->integral[i][j] += gap * w[k] * share[j];
        }
    }
}

/* The rows' sums are zero: the derivative of a constant. */
static void make_derivative(span_grid *g)
{
    for (int i = 0; i < GRID_N; i++) {
        g->derivative[i][i] = 0;
        for (int j = 0; j < GRID_N; j++)
            if (i != j) {
                g->derivative[i][j] = g->weight[j] / g->weight[i] / (g->x[i] - g->x[j]);
                g->derivative[i][i] -= g->derivative[i][j];
            }
    }
}

void span_grid_make(span_grid *g)
{
    double at[SPAN_GRID_GAUSS], w[SPAN_GRID_GAUSS];
    for (int i = 0; i < GRID_N; i++) {
        const double sine = sin(PI * i / (2 * (GRID_N - 1)));
        g->x[i] = sine * sine;
        g->weight[i] = (i % 2 ? -1 : 1) * (i == 0 || i == GRID_N - 1 ? 0.5 : 1);
    }
    make_integral(g);
    make_derivative(g);
    quadrature_points(SPAN_GRID_GAUSS, at, w);
    for (int i = 0; i + 1 < GRID_N; i++)
        for (int k = 0; k < SPAN_GRID_GAUSS; k++)
            span_grid_at(g, g->x[i] + (g->x[i + 1] - g->x[i]) * at[k], g->gauss[i][k]);
}

void span_grid_integrate(const span_grid *g, int count, const double values[], double out[])
{
    for (int i = 0; i < GRID_N; i++)
        for (int k = 0; k < count; k++) {
            double sum = 0;
            for (int j = 0; j < GRID_N; j++)
                sum += g->integral[i][j] * values[j * count + k];
            out[i * count + k] = sum;
        }
}
