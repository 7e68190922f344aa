/* Sparse matrices in compressed columns, and their direct factorisation.
 *
 * Symmetric matrices keep the upper triangle (row <= column) only; the rest keep everything. Some
 * of these are factored as symmetric all the same when their numbers are. The pattern is fixed
 * once; numbers are added by position, so assembly searches nothing. */
#ifndef BEAMWORK_SPARSE_H
#define BEAMWORK_SPARSE_H

#include "elements/shared/status.h"

typedef struct sparse {
    int n, symmetric;
    int *column;    /* [n + 1] */
    int *row;       /* [column[n]], ascending in each column */
    double *value;  /* [column[n]] */
    int by_numbers; /* 1: stored whole; symmetric where its numbers are */
} sparse;

/* A second matrix with the same pattern shares column and row with the first and owns its values
 * only. */
status sparse_alloc_like(const sparse *pattern, sparse *out, fault *f);
void sparse_free_values(sparse *a);
void sparse_zero(sparse *a);
/* The first rows and columns of `whole`, whose others are the last in each of them. */
void sparse_copy_leading(const sparse *whole, sparse *leading);
/* Entry (j, j), 0 where none is stored, whichever part of the matrix is. */
double sparse_diagonal(const sparse *a, int j);
void sparse_mul(const sparse *a, const double x[], double y[]); /* y = A x */
/* What rounding of all its terms, each in the same direction, changes in x^T A y, A symmetric, or
 * skew where the upper triangle is stored. */
double sparse_rounding(const sparse *a, const double x[], const double y[]);

/* Of a matrix that is stored whole, the upper triangle, and whether that is all there is. */
typedef struct by_numbers by_numbers;

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f);
void by_numbers_free(by_numbers *);
/* Largest |a_ij - a_ji|/sqrt|a_ii a_jj| of `a`, whose upper triangle is copied; INFINITY where that
 * has no measure. */
double by_numbers_take(by_numbers *, const sparse *a);
const sparse *by_numbers_upper(const by_numbers *);

typedef struct matrix_factor matrix_factor;

typedef struct factor_counts {
    long entries;        /* of the factors: fill */
    double flops;        /* of one numeric factorisation */
    long factorisations; /* numeric ones, so far */
    int negative_pivots; /* symmetric only; else -1 */
    double asymmetry;    /* of a matrix by its numbers: largest |a_ij - a_ji|/sqrt|a_ii a_jj| */
    int determinant;     /* its sign */
    double condition;    /* cheap estimate max|d|/min|d| */
} factor_counts;

/* Up to this asymmetry a matrix counts as symmetric by its numbers. */
#define FACTOR_SYMMETRIC_WITHIN 1e-11
/* Symbolic analysis once: fill-reducing order (AMD). Symmetric: LDL^T without pivoting, whose signs
 * give the inertia; unsymmetric: KLU. By its numbers: LDL^T of the upper triangle, bit by bit that
 * of a matrix that stores nothing else, or KLU. */
status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f);
/* For a matrix with the pattern that `of` was made for: a symmetric one takes the order of `of`,
 * which must outlive it and not be factored at the same time. */
status factor_alloc_like(const matrix_factor *of, const sparse *pattern, matrix_factor **out,
                         fault *f);
void factor_free(matrix_factor *fa);
/* SINGULAR when a pivot is zero or not finite, or growth has destroyed the digits. */
status factor_numeric(matrix_factor *fa, const sparse *a, fault *f);
/* 1: the numbers factored last were taken for symmetric. */
int factor_is_symmetric(const matrix_factor *fa);
/* The upper triangle that was factored of a matrix by its numbers; NULL: none. It belongs to the
 * factor. */
const sparse *factor_upper(const matrix_factor *fa);
void factor_solve(matrix_factor *fa, double x[]); /* in place */
/* `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[]);
void factor_solve_transposed(matrix_factor *fa, double x[]); /* A^T x = b */
factor_counts factor_count(const matrix_factor *fa);

/* Solutions that somebody else knows how to find. */
typedef struct factor_operator {
    void *context;
    void (*solve)(void *context, int transposed, double x[]);
    factor_counts (*count)(const void *context);
    void (*free)(void *context);
} factor_operator;
/* factor_solve, factor_solve_transposed and factor_count are those of the operator, which the
 * factor owns; it factors no matrix. */
status factor_of(const factor_operator *, matrix_factor **out, fault *f);
/* 1-norm condition number of the factored matrix a, rows and columns scaled by the root of its
 * diagonal: Hager's estimate, a lower bound within a small factor. NAN when memory ran out. */
double factor_condition(matrix_factor *fa, const sparse *a);

#endif
