/* Symbolic analysis of an LU factorisation by dense fronts (I.S. Duff, J.K. Reid, ACM Trans. Math.
 * Softw. 9, 1983). Consecutive columns whose entries below them lie in almost the same rows form
 * one front. */
#include "harness/numerics/numerics_impl.h"

#include <amd.h>
#include <ldl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

typedef struct elimination {
    int *position; /* [n] inverse of the order */
    int *parent;   /* [n] elimination tree; -1: a root */
    int *below;    /* [n] number of entries below the diagonal of each column */
    int *front_of; /* [n] */
    int *work;     /* [2 n + 1] */
} elimination;

/* Returns 1 if every entry has a counterpart across the diagonal, and the diagonal is stored. */
static int is_even(const sparse *a, int next[])
{
    for (int j = 0; j < a->n; j++)
        next[j] = a->column[j];
    for (int j = 0; j < a->n; j++) {
        int diagonal = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            diagonal |= i == j;
            if (next[i] == a->column[i + 1] || a->row[next[i]] != j)
                return 0;
            next[i]++;
        }
        if (!diagonal)
            return 0;
    }
    return 1;
}

/* Collects the entries of all blocks in one block [n x n], where they may occur several times. */
static void gather(const sparse *a, int n, int column[], int row[])
{
    int count = 0;
    for (int j = 0; j < n; j++) {
        column[j] = count;
        for (int c = j; c < a->n; c += n)
            for (int k = a->column[c]; k < a->column[c + 1]; k++)
                row[count++] = a->row[k] % n;
    }
    column[n] = count;
}

/* Orders the unknowns by AMD, and those of the copies one after the other. */
static int find_order(const sparse *a, int copies, int order[])
{
    const int n = a->n / copies;
    int *column = malloc((2 * (size_t)n + (size_t)a->column[a->n] + 1) * sizeof *column);
    if (column == NULL)
        return 0;
    int *one = column + n + 1, *row = one + n;
    gather(a, n, column, row);
    const int good = amd_order(n, column, row, one, NULL, NULL) >= AMD_OK;
    for (int k = 0; k < n && good; k++)
        for (int c = 0; c < copies; c++)
            order[copies * k + c] = one[k] + (copies - 1 - c) * n;
    free(column);
    return good;
}

/* Returns 1 if column j belongs to the front of the previous column, which has `pivots` columns.
 * The front then stores a few zeros in each of them. */
static int joins(const elimination *e, int j, int pivots)
{
    const int zeros = e->below[j] + 1 - e->below[j - 1];
    return e->parent[j - 1] == j && 4L * zeros * pivots <= e->below[j] + 1;
}

/* Sets the fronts, their sizes and the places of their values. Returns 0 if they would need much
 * more memory than the factors. */
static int find_fronts(fronts *t, elimination *e)
{
    size_t most = 4096;
    t->count = 0;
    t->below_count = t->size = 0;
    for (int j = 0; j < t->n; j++) {
        if (j == 0 || !joins(e, j, t->front[t->count - 1].pivots))
            t->front[t->count++] = (front){.first = j};
        e->front_of[j] = t->count - 1;
        t->front[t->count - 1].pivots++;
        most += 8 * (2 * (size_t)e->below[j] + 1);
    }
    for (int i = 0; i < t->count; i++) {
        front *f = &t->front[i];
        const int last = f->first + f->pivots - 1;
        f->rows = f->pivots + e->below[last];
        f->stride = f->rows + FRONTS_LANES - 1;
        f->parent = e->parent[last] < 0 ? -1 : e->front_of[e->parent[last]];
        f->below = t->below_count;
        f->value = t->size;
        t->below_count += (size_t)e->below[last];
        t->size += (size_t)f->rows * (size_t)f->stride + FRONTS_LANES;
        t->most_rows = f->rows > t->most_rows ? f->rows : t->most_rows;
    }
    return t->size <= most && t->size <= INT_MAX;
}

static int ascending(const void *a, const void *b)
{
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

/* Lists the rows below the pivots of every front: those of its columns, and those that its children
 * leave. */
static void find_rows(const sparse *a, fronts *t, const elimination *e)
{
    int *mark = e->work, *child = e->work + t->n, *brother = t->until; /* later overwritten */
    for (int i = 0; i < t->n; i++)
        mark[i] = child[i] = -1;
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        const int end = f->first + f->pivots;
        int *rows = t->below + f->below, count = 0;
        for (int j = f->first; j < end; j++)
            for (int k = a->column[t->order[j]]; k < a->column[t->order[j] + 1]; k++) {
                const int row = e->position[a->row[k]];
                if (row >= end && mark[row] != i) {
                    mark[row] = i;
                    rows[count++] = row;
                }
            }
        for (int c = child[i]; c >= 0; c = brother[c])
            for (int k = 0; k < t->front[c].rows - t->front[c].pivots; k++) {
                const int row = t->below[t->front[c].below + (size_t)k];
                if (row >= end && mark[row] != i) {
                    mark[row] = i;
                    rows[count++] = row;
                }
            }
        qsort(rows, (size_t)count, sizeof *rows, ascending);
        if (f->parent >= 0) {
            brother[i] = child[f->parent];
            child[f->parent] = i;
        }
    }
}

/* Returns the row of a front at a position in the order of elimination. */
static int row_in(const fronts *t, const front *f, int position)
{
    if (position < f->first + f->pivots)
        return position - f->first;
    const int *found = bsearch(&position, t->below + f->below, (size_t)(f->rows - f->pivots),
                               sizeof position, ascending);
    return f->pivots + (int)(found - (t->below + f->below));
}

static void place_values(const sparse *a, fronts *t, const elimination *e)
{
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int row = e->position[a->row[k]], column = e->position[j];
            const front *f = &t->front[e->front_of[row < column ? row : column]];
            t->place[k] = (int)f->value + f->stride * row_in(t, f, row) + row_in(t, f, column);
        }
}

static void relate(fronts *t)
{
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        const int count = f->rows - f->pivots, *below = t->below + f->below;
        int *in = t->in_parent + f->below, *until = t->until + f->below;
        for (int k = 0; k < count; k++)
            in[k] = row_in(t, &t->front[f->parent], below[k]);
        for (int k = count - 1; k >= 0; k--)
            until[k] = k + 1 < count && in[k + 1] == in[k] + 1 ? until[k + 1] : k + 1;
    }
}

static int lay_out(const sparse *a, fronts *t, elimination *e)
{
    const size_t n = (size_t)a->n;
    *e = (elimination){.position = malloc((6 * n + 1) * sizeof(int))};
    t->n = a->n;
    t->entries = a->column[a->n];
    t->order = malloc((n + 1) * sizeof *t->order);
    t->front = malloc((n + 1) * sizeof *t->front);
    t->place = malloc(((size_t)t->entries + 1) * sizeof *t->place);
    if (e->position == NULL || t->order == NULL || t->front == NULL || t->place == NULL)
        return 0;
    e->parent = e->position + n;
    e->below = e->parent + n;
    e->front_of = e->below + n;
    e->work = e->front_of + n;
    return 1;
}

static int lay_out_fronts(fronts *t)
{
    const size_t rows = t->below_count + (size_t)t->n + 1;
    t->below = malloc(3 * rows * sizeof *t->below);
    t->value = malloc((t->size + FRONTS_LANES) * sizeof *t->value);
    t->scale =
        malloc((4 * (size_t)t->n + (size_t)t->most_rows + 2 * FRONTS_LANES) * sizeof *t->scale);
    if (t->below == NULL || t->value == NULL || t->scale == NULL)
        return 0;
    t->in_parent = t->below + rows;
    t->until = t->in_parent + rows;
    t->left = t->scale + t->n;
    t->right = t->left + t->n;
    t->work = t->right + t->n;
    return 1;
}

/* Returns 0 if the matrix has no fronts, or if out of memory. */
static int analyse(const sparse *a, int copies, fronts *t, elimination *e, factor_counts *counts)
{
    if (a->n == 0 || !lay_out(a, t, e) || !is_even(a, e->work) || !find_order(a, copies, t->order))
        return 0;
    t->copies = copies;
    int *L_column = e->work;
    int *mark = t->place; /* at least one entry in each column */
    ldl_symbolic(a->n, a->column, a->row, L_column, e->parent, e->below, mark, t->order,
                 e->position);
    if (!find_fronts(t, e) || !lay_out_fronts(t))
        return 0;
    find_rows(a, t, e);
    place_values(a, t, e);
    relate(t);
    counts->entries = t->n;
    counts->flops = 0;
    for (int j = 0; j < t->n; j++) {
        const double below = e->below[j];
        counts->entries += 2 * (long)e->below[j];
        counts->flops += below * (2 * below + 1);
    }
    return 1;
}

fronts *fronts_alloc(const sparse *pattern, int copies, factor_counts *counts)
{
    fronts *t = calloc(1, sizeof *t);
    elimination e = {0};
    if (t == NULL)
        return NULL;
    if (!analyse(pattern, copies, t, &e, counts)) {
        fronts_free(t);
        t = NULL;
    }
    free(e.position);
    return t;
}

void fronts_free(fronts *t)
{
    if (t == NULL)
        return;
    free(t->order);
    free(t->front);
    free(t->place);
    free(t->below);
    free(t->value);
    free(t->scale);
    free(t);
}
