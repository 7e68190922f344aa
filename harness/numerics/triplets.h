/* Matrices as lists of entries, to be kept and written. */
#ifndef BEAMWORK_TRIPLETS_H
#define BEAMWORK_TRIPLETS_H

#include "harness/numerics/sparse.h"

typedef enum matrix_kind { MATRIX_GENERAL, MATRIX_SYMMETRIC, MATRIX_SKEW } matrix_kind;

/* Entries that are not zero; where the kind is not general those on and below the diagonal only. */
typedef struct triplets {
    matrix_kind kind;
    int rows, columns, entries;
    int *row, *column; /* [entries] from zero, column by column */
    double *value;     /* [entries] */
} triplets;

/* Entries of a; skew: of a symmetric pattern the upper triangle of a skew matrix is stored. */
status triplets_of(const sparse *a, int skew, triplets *out, fault *);
/* From columns [columns x rows], one after the other. */
status triplets_of_columns(int rows, int columns, const double value[], triplets *out, fault *);
/* y[rows] = A x */
void triplets_mul(const triplets *A, const double x[], double y[]);
void triplets_free(triplets *);

#endif
