/* Columns of a factor L that follow each other, each with the next one and the rows of that: what a
 * row of L takes from them is subtracted together, each number in the order of the columns, so that
 * the sums are those of one column after the other. */
#ifndef BEAMWORK_COLUMN_RUN_H
#define BEAMWORK_COLUMN_RUN_H

enum { COLUMN_RUN_MOST = 6 };

typedef struct column_run {
    int first, count; /* 1 .. COLUMN_RUN_MOST */
} column_run;

/* Columns of L as far as they are filled, their pivots, and the row that is made: y has what it has
 * left of A. */
typedef struct column_run_columns {
    const int *begin, *row; /* [n + 1], [begin[n]] */
    int *filled;            /* [n] entries so far */
    double *value;          /* [begin[n]] */
    const double *D;        /* [n] */
    double *y;              /* [n] */
} column_run_columns;

static inline void column_run_subtract_rows(int columns, int rows, const int row[],
                                            const double *const value[], const double x[],
                                            double y[])
{
    for (int p = 0; p < rows; p++) {
        double sum = y[row[p]];
        for (int c = 0; c < columns; c++)
            sum -= value[c][p] * x[c];
        y[row[p]] = sum;
    }
}

/* x: the run's own entries of y, as the columns before have left them; y is 0 there afterwards. */
static inline void column_run_subtract(const column_run_columns *L, int first, int columns,
                                       double x[])
{
    const double *value[COLUMN_RUN_MOST];
    double *y = L->y + first;
    for (int c = 0; c < columns; c++) {
        value[c] = L->value + L->begin[first + c];
        x[c] = y[c];
        for (int r = c + 1; r < columns; r++)
            y[r] -= *value[c]++ * x[c];
        y[c] = 0;
    }
    const int last = first + columns - 1;
    column_run_subtract_rows(columns, L->filled[last], L->row + L->begin[last], value, x, L->y);
}

/* Of a number of columns that is known when it is compiled. */
static inline double column_run_of(const column_run_columns *L, int first, int columns,
                                   double pivot)
{
    double x[COLUMN_RUN_MOST];
    column_run_subtract(L, first, columns, x);
    for (int c = 0; c < columns; c++) {
        const double l = x[c] / L->D[first + c];
        L->value[L->begin[first + c] + L->filled[first + c]++] = l;
        pivot -= l * x[c];
    }
    return pivot;
}

/* The entries of the row in these columns, into value; returns what they leave of its pivot. */
static inline double column_run_use(const column_run_columns *L, column_run run, double pivot)
{
    switch (run.count) {
    case 1:
        return column_run_of(L, run.first, 1, pivot);
    case 2:
        return column_run_of(L, run.first, 2, pivot);
    case 3:
        return column_run_of(L, run.first, 3, pivot);
    case 4:
        return column_run_of(L, run.first, 4, pivot);
    case 5:
        return column_run_of(L, run.first, 5, pivot);
    default:
        return column_run_of(L, run.first, COLUMN_RUN_MOST, pivot);
    }
}

#endif
