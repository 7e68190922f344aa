/* P^T L D L^T P x = b for one or several right-hand sides at once. Every number is the sum of its
 * terms in the order of SuiteSparse's ldl_lsolve and ldl_ltsolve: the same bits, however many are
 * solved together. */
#ifndef BEAMWORK_TRIANGULAR_SOLVE_H
#define BEAMWORK_TRIANGULAR_SOLVE_H

#include "harness/numerics/triangular_rows.h"

enum { TRIANGULAR_TOGETHER = 4 };

typedef struct triangular_factors {
    int n;
    const int *order;          /* [n] place k has unknown order[k] */
    const int *begin, *row;    /* L: [n + 1], [begin[n]] ascending in each column */
    const double *value, *D;   /* L: [begin[n]]; [n] */
    int runs;                  /* all columns: each but the last of a run has the next one ... */
    const triangular_run *run; /* ... and the rows of that */
} triangular_factors;

/* In place. x: `columns` right-hand sides [n], each `stride` numbers after the one before it; work:
 * [TRIANGULAR_TOGETHER n]. The second is for processors with AVX2: elements/math/real.h. */
void triangular_solve_plain(const triangular_factors *, int columns, int stride, double x[],
                            double work[]);
void triangular_solve_avx2(const triangular_factors *, int columns, int stride, double x[],
                           double work[]);

#endif
