/* LU of a sparse unsymmetric matrix with partial pivoting (SuiteSparse KLU). */
#ifndef BEAMWORK_FACTOR_UNSYMMETRIC_H
#define BEAMWORK_FACTOR_UNSYMMETRIC_H

#include "harness/numerics/sparse.h"

typedef struct factor_unsymmetric factor_unsymmetric;

status factor_unsymmetric_alloc(const sparse *pattern, factor_unsymmetric **out,
                                factor_counts *counts, fault *f);
void factor_unsymmetric_free(factor_unsymmetric *fu);
/* OK, SINGULAR, or FAULT when memory ran out. The pivots chosen once serve all later matrices (and
 * nothing is allocated) until their growth asks for new ones. *row, *column: of the smallest pivot;
 * *ratio: its size by the largest entries of these. */
status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                                  int *row, int *column, double *ratio);
/* In place: `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[]);
void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[]);

#endif
