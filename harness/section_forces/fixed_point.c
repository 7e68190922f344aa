#include "harness/section_forces/fixed_point.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { MEMORY = 12, MOST = 100 };

/* Differences of the last moves and of what the map gave, the moves made orthonormal
 * (Gram-Schmidt). */
typedef struct history {
    int count;
    double move[MEMORY][FIXED_POINT_MAX], given[MEMORY][FIXED_POINT_MAX];
} history;

/* Takes up one more pair of differences; the oldest falls out by starting anew. */
static void remember(history *h, int n, double move[], double given[])
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
            remember(&h, n, dm, dg);
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
