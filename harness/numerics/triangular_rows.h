/* The numbers of L and D in P A P^T = L D L^T, row by row. Rows that follow each other and have the
 * same columns, but for themselves, are made side by side, one in each lane; columns that follow
 * each other, each with the next one and the rows of that, are subtracted together. Every number is
 * the sum of its terms in the order of the columns, so that all have the bits of SuiteSparse's
 * ldl_numeric. */
#ifndef BEAMWORK_TRIANGULAR_ROWS_H
#define BEAMWORK_TRIANGULAR_ROWS_H

enum { TRIANGULAR_LANES = 4, TRIANGULAR_RUN = 7 };

/* Columns of L that rows have. */
typedef struct triangular_run {
    int first, count; /* 1 .. TRIANGULAR_RUN */
} triangular_run;

typedef struct triangular_rows {
    int groups;                               /* of 1 .. TRIANGULAR_LANES rows */
    const int *first_of_group, *run_of_group; /* [groups + 1] */
    const triangular_run *run;                /* [run_of_group[groups]] in the order of sums */
    const int *begin_A;                       /* [n + 1] entries of each row of P A P^T ... */
    const int *place, *source; /* ... column TRIANGULAR_LANES + lane of the row; index in a */
    const int *begin, *row;    /* L: [n + 1], [begin[n]] */
    int *filled;               /* [n] entries of a column so far */
    double *value;             /* L: [begin[n]] */
    double *D;                 /* [n] */
    double *diagonal;          /* [n] of |A| */
    double *rest; /* [n + TRIANGULAR_LANES][TRIANGULAR_LANES] work space, zero before and after */
} triangular_rows;

/* The column of an entry of P A P^T, from its place. */
static inline int triangular_column_of(int place)
{
    return place / TRIANGULAR_LANES;
}

/* 0: a pivot is zero, and the rows from there on are not made. The second is for processors with
 * AVX2: elements/math/real.h. */
int triangular_rows_factor_plain(const triangular_rows *, const double a[]);
int triangular_rows_factor_avx2(const triangular_rows *, const double a[]);

#endif
