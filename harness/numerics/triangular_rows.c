#include "harness/numerics/numerics_impl.h"

#include <math.h>

#include "elements/math/real.h"

enum { ROWS = TRIANGULAR_LANES };

typedef double lanes
    __attribute__((vector_size(ROWS * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Moves the entries of the rows in the columns of a run from t->rest to x[columns], and sets them
 * to zero in t->rest. Previous columns must have been subtracted. Subtracts the columns of the run
 * from each other and from t->rest. */
static inline __attribute__((always_inline)) void subtract(const triangular_rows *t, int first,
                                                           int columns, lanes x[])
{
    const double *value[TRIANGULAR_RUN];
    const int last = first + columns - 1, *row = t->row + t->begin[last], filled = t->filled[last];
    lanes *rest = (lanes *)t->rest;
    for (int c = 0; c < columns; c++) {
        x[c] = rest[first + c];
        rest[first + c] = (lanes){0};
    }
    for (int c = 0; c < columns; c++) {
        value[c] = t->value + t->begin[first + c];
        for (int r = c + 1; r < columns; r++)
            x[r] -= *value[c]++ * x[c];
    }
    for (int p = 0; p < filled; p++) {
        lanes sum = rest[row[p]];
        for (int c = 0; c < columns; c++)
            sum -= value[c][p] * x[c];
        rest[row[p]] = sum;
    }
}

/* Computes the entries of L in a run, and their contribution to the diagonal block of the rows:
 * own[s][r] for row r in column s. The sizes are compile-time constants. */
static inline __attribute__((always_inline)) void use(const triangular_rows *t, int first,
                                                      int columns, int rows, lanes own[ROWS])
{
    lanes x[TRIANGULAR_RUN];
    subtract(t, first, columns, x);
    for (int c = 0; c < columns; c++) {
        const lanes l = x[c] / t->D[first + c];
        double *to = t->value + t->begin[first + c] + t->filled[first + c];
        t->filled[first + c] += rows;
        if (rows == ROWS)
            *(lanes *)to = l;
        else
            for (int r = 0; r < rows; r++)
                to[r] = l[r];
        for (int r = 0; r < rows; r++)
            own[r] -= l[r] * x[c];
    }
}

static inline __attribute__((always_inline)) void
use_run(const triangular_rows *t, triangular_run run, int rows, lanes own[ROWS])
{
    switch (run.count) {
    case 1:
        use(t, run.first, 1, rows, own);
        break;
    case 2:
        use(t, run.first, 2, rows, own);
        break;
    case 3:
        use(t, run.first, 3, rows, own);
        break;
    case 4:
        use(t, run.first, 4, rows, own);
        break;
    case 5:
        use(t, run.first, 5, rows, own);
        break;
    case 6:
        use(t, run.first, 6, rows, own);
        break;
    default:
        use(t, run.first, TRIANGULAR_RUN, rows, own);
    }
}

static inline __attribute__((always_inline)) int factor_own(const triangular_rows *t, int first,
                                                            int rows, lanes own[ROWS])
{
    for (int c = 0; c < rows; c++) {
        const double pivot = own[c][c];
        double *l = t->value + t->begin[first + c];
        t->D[first + c] = pivot;
        t->filled[first + c] = rows - 1 - c;
        if (pivot == 0)
            return 0;
        for (int r = c + 1; r < rows; r++) {
            const double x = own[c][r];
            l[r - c - 1] = x / pivot;
            for (int s = c + 1; s <= r; s++)
                own[s][r] -= l[s - c - 1] * x;
        }
    }
    return 1;
}

static inline __attribute__((always_inline)) int
factor_rows(const triangular_rows *t, const double a[], int group, int first, int rows)
{
    lanes own[ROWS], *rest = (lanes *)t->rest + first;
    for (int p = t->begin_A[first]; p < t->begin_A[first + rows]; p++)
        t->rest[t->place[p]] += a[t->source[p]];
    for (int r = 0; r < rows; r++) {
        own[r] = rest[r];
        rest[r] = (lanes){0};
        t->diagonal[first + r] = fabs(own[r][r]);
    }
    for (int i = t->run_of_group[group]; i < t->run_of_group[group + 1]; i++)
        use_run(t, t->run[i], rows, own);
    return factor_own(t, first, rows, own);
}

int REAL_NAMED(triangular_rows_factor)(const triangular_rows *t, const double a[])
{
    int regular = 1;
    for (int group = 0; group < t->groups && regular; group++) {
        const int first = t->first_of_group[group], rows = t->first_of_group[group + 1] - first;
        if (rows == 4)
            regular = factor_rows(t, a, group, first, 4);
        else if (rows == 3)
            regular = factor_rows(t, a, group, first, 3);
        else if (rows == 2)
            regular = factor_rows(t, a, group, first, 2);
        else
            regular = factor_rows(t, a, group, first, 1);
    }
    return regular;
}
