#include "elements/section/tree.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

double tree_wall_length(const section_spec *s, int w)
{
    const double *p = s->point[s->wall[w].from], *q = s->point[s->wall[w].to];
    return hypot(q[0] - p[0], q[1] - p[1]);
}

/* Entries of `t` that reach a point; the walls that close cells are put behind them. */
static status connect(const section_spec *s, section_tree *t, fault *f)
{
    int reached[SECTION_MAX_POINTS] = {0}, used[SECTION_MAX_WALLS] = {0}, count = 0;
    int closing[SECTION_MAX_WALLS];
    reached[0] = 1;
    for (int grown = 1; grown;) {
        grown = 0;
        for (int w = 0; w < s->walls; w++) {
            const int a = s->wall[w].from, b = s->wall[w].to;
            if (used[w] || (!reached[a] && !reached[b]))
                continue;
            used[w] = grown = 1;
            if (reached[a] && reached[b]) {
                if (t->cells == s->cells)
                    return fault_set(f, STATUS_REFUSED,
                                     "section: wall %d (points %d-%d) closes a cell; %s", w, a, b,
                                     s->cells > 0 ? "give the number of cells that the walls close"
                                                  : "open it, or give the number of cells");
                closing[t->cells++] = w;
                continue;
            }
            t->wall[count] = w;
            t->near[count] = reached[a] ? a : b;
            t->far[count] = reached[a] ? b : a;
            reached[t->far[count]] = 1;
            count++;
        }
    }
    for (int w = 0; w < s->walls; w++)
        if (!used[w])
            return fault_set(f, STATUS_REFUSED,
                             "section: wall %d (points %d-%d) is not connected to wall 0; join the "
                             "walls at shared points",
                             w, s->wall[w].from, s->wall[w].to);
    for (int p = 0; p < s->points; p++)
        if (!reached[p])
            return fault_set(f, STATUS_REFUSED, "section: point %d belongs to no wall; remove it",
                             p);
    for (int c = 0; c < t->cells; c++) {
        t->wall[count + c] = closing[c];
        t->near[count + c] = s->wall[closing[c]].from;
        t->far[count + c] = s->wall[closing[c]].to;
    }
    return STATUS_OK;
}

/* Adds the way from a point to the root, times `sign`, to a cell. */
static void walk_to_root(const section_spec *s, section_tree *t, int c, int point, int sign)
{
    for (int k = s->walls - t->cells - 1; k >= 0; k--)
        if (t->far[k] == point) {
            const int forward = s->wall[t->wall[k]].from == point;
            t->round[c][t->wall[k]] += (signed char)(forward ? sign : -sign);
            point = t->near[k];
        }
}

status tree_grow(const section_spec *s, section_tree *t, fault *f)
{
    memset(t, 0, sizeof *t);
    TRY(connect(s, t, f));
    if (t->cells < s->cells)
        return fault_set(f, STATUS_REFUSED,
                         "section: the walls close %d of the %d cells; correct the number or close "
                         "them at shared points",
                         t->cells, s->cells);
    for (int c = 0; c < t->cells; c++) {
        const int k = s->walls - t->cells + c;
        t->round[c][t->wall[k]] = 1;
        walk_to_root(s, t, c, t->far[k], 1);
        walk_to_root(s, t, c, t->near[k], -1);
    }
    return STATUS_OK;
}

void tree_flow(const section_spec *s, const section_tree *t, const double jump[], double flow[])
{
    /* sum over the cells d of (oint_c,d ds/t) x_d = oint_c: symmetric, positive definite */
    double matrix[SECTION_MAX_WALLS * SECTION_MAX_WALLS], x[SECTION_MAX_WALLS];
    const int n = t->cells;
    for (int w = 0; w < s->walls; w++)
        flow[w] = 0;
    if (n == 0)
        return;
    for (int c = 0; c < n; c++) {
        x[c] = 0;
        for (int d = 0; d < n; d++)
            matrix[c * n + d] = 0;
        for (int w = 0; w < s->walls; w++) {
            x[c] += t->round[c][w] * jump[w];
            for (int d = 0; d < n; d++)
                matrix[c * n + d] +=
                    t->round[c][w] * t->round[d][w] * tree_wall_length(s, w) / s->wall[w].thickness;
        }
    }
    dense_cholesky(n, matrix);
    dense_cholesky_solve(n, 1, matrix, x);
    for (int w = 0; w < s->walls; w++)
        for (int c = 0; c < n; c++)
            flow[w] += t->round[c][w] * x[c];
}
