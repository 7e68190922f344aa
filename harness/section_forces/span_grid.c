#include "harness/section_forces/section_forces_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

enum {
    GRID_N = SPAN_GRID_POINTS,
    EXACT = GRID_N / 2
}; /* number of Gauss points, for which polynomials of the grid are integrated exactly */

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

/* Computes the matrix of derivatives at the points. The sum of each row is zero, because
 * the derivative of a constant is zero. */
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

enum { MEMORY = 12, MOST = 100 };

/* Differences of the steps G(x) - x, orthonormalised (Gram-Schmidt), and of the values G(x) of the
 * map. */
typedef struct history {
    int count;
    double move[MEMORY][FIXED_POINT_MAX], given[MEMORY][FIXED_POINT_MAX];
} history;

/* Adds a pair of differences: that of the steps G(x) - x (`move`), made orthogonal to the previous
 * ones, and that of the values G(x) of the map (`given`), combined in the same way. A full history
 * is cleared first. Nothing is added if `move` depends linearly on the previous differences. */
static void store_history(history *h, int n, double move[], double given[])
{
    if (h->count == MEMORY)
        h->count = 0;
    const double size = sqrt(dense_dot(n, move, move));
    for (int twice = 0; twice < 2; twice++)
        for (int k = 0; k < h->count; k++) {
            const double part = dense_dot(n, h->move[k], move);
            for (int i = 0; i < n; i++) {
                move[i] -= part * h->move[k][i];
                given[i] -= part * h->given[k][i];
            }
        }
    const double left = sqrt(dense_dot(n, move, move));
    if (!(left > 1e-10 * size))
        return;
    for (int i = 0; i < n; i++) {
        h->move[h->count][i] = move[i] / left;
        h->given[h->count][i] = given[i] / left;
    }
    h->count++;
}

double fixed_point_find(int n, fixed_point_map map, void *context, double enough, double x[])
{
    history h = {.count = 0};
    double given[FIXED_POINT_MAX], before[FIXED_POINT_MAX], move[FIXED_POINT_MAX],
        last[FIXED_POINT_MAX], best[FIXED_POINT_MAX], least = INFINITY;
    for (int round = 0; round < MOST; round++) {
        double largest = 0;
        if (map(context, x, given) != 0)
            return INFINITY;
        for (int i = 0; i < n; i++) {
            const double moved = given[i] - x[i];
            largest = fmax(largest, isfinite(moved) ? fabs(moved) : INFINITY);
        }
        if (!isfinite(largest))
            break;
        if (largest < least) {
            least = largest;
            memcpy(best, given, (size_t)n * sizeof *best);
        }
        if (largest <= enough)
            break;
        for (int i = 0; i < n; i++)
            move[i] = given[i] - x[i];
        if (round > 0) {
            double dm[FIXED_POINT_MAX], dg[FIXED_POINT_MAX];
            for (int i = 0; i < n; i++) {
                dm[i] = move[i] - last[i];
                dg[i] = given[i] - before[i];
            }
            store_history(&h, n, dm, dg);
        }
        memcpy(before, given, (size_t)n * sizeof *before);
        memcpy(last, move, (size_t)n * sizeof *last);
        memcpy(x, given, (size_t)n * sizeof *x);
        for (int k = 0; k < h.count; k++) {
            const double part = dense_dot(n, h.move[k], move);
            for (int i = 0; i < n; i++)
                x[i] -= part * h.given[k][i];
        }
    }
    if (isfinite(least))
        memcpy(x, best, (size_t)n * sizeof *x);
    return least;
}
