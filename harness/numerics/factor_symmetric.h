/* LDL^T of a sparse symmetric matrix without pivoting (SuiteSparse AMD and LDL): the signs of D are
 * the inertia. */
#ifndef BEAMWORK_FACTOR_SYMMETRIC_H
#define BEAMWORK_FACTOR_SYMMETRIC_H

#include "harness/numerics/sparse.h"

typedef struct factor_symmetric factor_symmetric;

status factor_symmetric_alloc(const sparse *pattern, factor_symmetric **out, factor_counts *counts,
                              fault *f);
/* Of a matrix with the same pattern: order, pattern and workspace are those of `of`, which must
 * outlive it; only one of the two is factored at a time. */
status factor_symmetric_alloc_like(const factor_symmetric *of, factor_symmetric **out, fault *f);
void factor_symmetric_free(factor_symmetric *fs);
/* OK or SINGULAR; allocates nothing. *weakest: unknown whose pivot lost most digits; *ratio: its
 * size by that of the terms it is the sum of. */
status factor_symmetric_numeric(factor_symmetric *fs, const sparse *a, factor_counts *counts,
                                int *weakest, double *ratio);
/* In place: `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_symmetric_solve(factor_symmetric *fs, int columns, int stride, double x[]);

#endif
