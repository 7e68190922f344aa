#include "harness/numerics/numerics_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/real.h"

enum { WIDE = FRONTS_LANES };

typedef double lanes
    __attribute__((vector_size(WIDE * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Subtracts multiples of one or two rows of U from a row, from column `from` to column `end`.
 * Columns up to end + WIDE - 2 must exist and contain zeros. */
static inline void subtract_one(int from, int end, double l, const double *U, double *row)
{
    for (int j = from; j < end; j += WIDE)
        *(lanes *)(row + j) -= l * *(const lanes *)(U + j);
}

static inline void subtract_two(int from, int end, double l, const double *U, double k,
                                const double *V, double *row)
{
    for (int j = from; j < end; j += WIDE)
        *(lanes *)(row + j) =
            *(const lanes *)(row + j) - l * *(const lanes *)(U + j) - k * *(const lanes *)(V + j);
}

/* Eliminates the pivots of a front. *sums: adds l^2 |d| for each row. */
static void eliminate(const front *f, double *F, double sums[])
{
    const int rows = f->rows, stride = f->stride;
    int k = 0;
    for (; k + 1 < f->pivots; k += 2) {
        double *U = F + (size_t)k * (size_t)stride, *V = U + stride;
        const double d = U[k], l = V[k] / d;
        V[k] = l;
        subtract_one(k + 1, rows, l, U, V);
        sums[k + 1] += l * l * fabs(d);
        const double e = V[k + 1], u = U[k + 1], by_d = 1 / d, by_e = 1 / e;
        for (int i = k + 2; i < rows; i++) {
            double *row = F + (size_t)i * (size_t)stride;
            const double first = row[k] * by_d, second = (row[k + 1] - first * u) * by_e;
            row[k] = first;
            row[k + 1] = second;
            sums[i] += first * first * fabs(d) + second * second * fabs(e);
            subtract_two(k + 2, rows, first, U, second, V, row);
        }
    }
    if (k < f->pivots) {
        const double *U = F + (size_t)k * (size_t)stride, d = U[k], by_d = 1 / d;
        for (int i = k + 1; i < rows; i++) {
            double *row = F + (size_t)i * (size_t)stride;
            const double l = row[k] * by_d;
            row[k] = l;
            sums[i] += l * l * fabs(d);
            subtract_one(k + 1, rows, l, U, row);
        }
    }
}

/* Adds u^2/|d| for each column. */
static void add_columns(const front *f, const double *F, double sums[])
{
    for (int k = 0; k < f->pivots; k++) {
        const double *U = F + (size_t)k * (size_t)f->stride, by_d = 1 / fabs(U[k]);
        for (int j = k + 1; j < f->rows; j += WIDE) {
            const lanes u = *(const lanes *)(U + j);
            *(lanes *)(sums + j) += u * u * by_d;
        }
    }
}

static void scatter(const fronts *t, const front *f, const double sums[], double out[])
{
    const int *below = t->below + f->below;
    for (int i = 0; i < f->pivots; i++)
        out[f->first + i] += sums[i];
    for (int i = f->pivots; i < f->rows; i++)
        out[below[i - f->pivots]] += sums[i];
}

/* Adds what a front leaves to its parent. */
static void add_to_parent(const fronts *t, const front *f, const double *F)
{
    const front *to = &t->front[f->parent];
    const int count = f->rows - f->pivots, *in = t->in_parent + f->below,
              *until = t->until + f->below;
    for (int i = 0; i < count; i++) {
        const double *from = F + (size_t)(f->pivots + i) * (size_t)f->stride + f->pivots;
        double *row = t->value + to->value + (size_t)in[i] * (size_t)to->stride;
        for (int j = 0; j < count; j = until[j]) {
            double *place = row + in[j] - j;
            int k = j;
            for (; k + WIDE <= until[j]; k += WIDE)
                *(lanes *)(place + k) += *(const lanes *)(from + k);
            for (; k < until[j]; k++)
                place[k] += from[k];
        }
    }
}

/* Sets the scale of each unknown: the largest diagonal entry of its copies. */
static void find_scales(const fronts *t)
{
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        for (int k = 0; k < f->pivots; k++)
            t->scale[f->first + k] = fabs(t->value[f->value + (size_t)k * (size_t)(f->stride + 1)]);
    }
    for (int i = 0; i < t->n && t->copies > 1; i += t->copies) {
        double most = 0;
        for (int k = i; k < i + t->copies; k++)
            most = fmax(most, t->scale[k]);
        for (int k = i; k < i + t->copies; k++)
            t->scale[k] = most;
    }
}

static int is_accurate(const fronts *t, fronts_pivots *out)
{
    const double growth = 1e4, lost = 16 * 2.220446049250313e-16;
    double largest = 0, smallest = INFINITY;
    *out = (fronts_pivots){.ratio = INFINITY, .determinant = 1};
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        for (int k = 0; k < f->pivots; k++) {
            const int at = f->first + k;
            const double d = t->value[f->value + (size_t)k * (size_t)(f->stride + 1)],
                         scale = t->scale[at], left = t->left[at], right = t->right[at],
                         part = fabs(d) / (scale + left / 2 + right / 2);
            if (!(left <= growth * scale && right <= growth * scale && part > lost &&
                  part < INFINITY))
                return 0;
            out->determinant = d < 0 ? -out->determinant : out->determinant;
            largest = part > largest ? part : largest;
            smallest = part < smallest ? part : smallest;
            if (part < out->ratio) {
                out->ratio = part;
                out->weakest = t->order[at];
            }
        }
    }
    out->condition = largest / smallest;
    return 1;
}

int REAL_NAMED(triangular_fronts_factor)(const fronts *t, const double a[], fronts_pivots *out)
{
    for (size_t i = 0; i < t->size; i += WIDE)
        *(lanes *)(t->value + i) = (lanes){0};
    memset(t->left, 0, 2 * (size_t)t->n * sizeof *t->left);
    for (int k = 0; k < t->entries; k++)
        t->value[t->place[k]] = a[k];
    find_scales(t);
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        double *F = t->value + f->value;
        const size_t room = ((size_t)f->rows + WIDE) * sizeof *t->work;
        memset(t->work, 0, room);
        eliminate(f, F, t->work);
        scatter(t, f, t->work, t->left);
        memset(t->work, 0, room);
        add_columns(f, F, t->work);
        scatter(t, f, t->work, t->right);
        if (f->parent >= 0)
            add_to_parent(t, f, F);
    }
    return is_accurate(t, out);
}

/* Returns the sum of the products of columns from .. end - 1. Up to WIDE - 1 columns more are read,
 * in which one of the factors is zero. */
static inline double product(int from, int end, const double *a, const double *x)
{
    lanes sum = {0};
    for (int j = from; j < end; j += WIDE)
        sum += *(const lanes *)(a + j) * *(const lanes *)(x + j);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void forwards(const fronts *t, double y[], double z[])
{
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        const double *F = t->value + f->value;
        const int *below = t->below + f->below;
        memset(z, 0, ((size_t)f->pivots + WIDE) * sizeof *z);
        for (int k = 0; k < f->pivots; k++)
            y[f->first + k] = z[k] =
                y[f->first + k] - product(0, k, F + (size_t)k * (size_t)f->stride, z);
        for (int k = f->pivots; k < f->rows; k++)
            y[below[k - f->pivots]] -= product(0, f->pivots, F + (size_t)k * (size_t)f->stride, z);
    }
}

static void backwards(const fronts *t, double y[], double z[])
{
    for (int i = t->count - 1; i >= 0; i--) {
        const front *f = &t->front[i];
        const double *F = t->value + f->value;
        const int *below = t->below + f->below;
        for (int k = f->pivots; k < f->rows; k++)
            z[k] = y[below[k - f->pivots]];
        memset(z + f->rows, 0, WIDE * sizeof *z);
        for (int k = f->pivots - 1; k >= 0; k--) {
            const double *U = F + (size_t)k * (size_t)f->stride;
            y[f->first + k] = z[k] = (y[f->first + k] - product(k + 1, f->rows, U, z)) / U[k];
        }
    }
}

void REAL_NAMED(triangular_fronts_solve)(const fronts *t, int columns, int stride, double x[])
{
    double *y = t->work, *z = t->work + t->n;
    for (int c = 0; c < columns; c++) {
        double *one = x + (size_t)c * (size_t)stride;
        for (int k = 0; k < t->n; k++)
            y[k] = one[t->order[k]];
        forwards(t, y, z);
        backwards(t, y, z);
        for (int k = 0; k < t->n; k++)
            one[t->order[k]] = y[k];
    }
}

static void forwards_transposed(const fronts *t, double y[])
{
    for (int i = 0; i < t->count; i++) {
        const front *f = &t->front[i];
        const int *below = t->below + f->below;
        for (int k = 0; k < f->pivots; k++) {
            const double *U = t->value + f->value + (size_t)k * (size_t)f->stride;
            const double one = y[f->first + k] /= U[k];
            for (int j = k + 1; j < f->pivots; j++)
                y[f->first + j] -= one * U[j];
            for (int j = f->pivots; j < f->rows; j++)
                y[below[j - f->pivots]] -= one * U[j];
        }
    }
}

static void backwards_transposed(const fronts *t, double y[])
{
    for (int i = t->count - 1; i >= 0; i--) {
        const front *f = &t->front[i];
        const int *below = t->below + f->below;
        for (int k = f->rows - 1; k > 0; k--) {
            const double *L = t->value + f->value + (size_t)k * (size_t)f->stride;
            const double one = k < f->pivots ? y[f->first + k] : y[below[k - f->pivots]];
            for (int j = 0; j < k && j < f->pivots; j++)
                y[f->first + j] -= one * L[j];
        }
    }
}

void REAL_NAMED(triangular_fronts_solve_transposed)(const fronts *t, double x[])
{
    double *y = t->work;
    for (int k = 0; k < t->n; k++)
        y[k] = x[t->order[k]];
    forwards_transposed(t, y);
    backwards_transposed(t, y);
    for (int k = 0; k < t->n; k++)
        x[t->order[k]] = y[k];
}
