/* Candidates for the largest eigenvalues of s A x = mu K x: refined by Rayleigh's quotient, judged
 * and sorted. */
#ifndef BEAMWORK_CANDIDATES_H
#define BEAMWORK_CANDIDATES_H

#include "harness/numerics/eigen.h"

typedef struct candidates {
    const eigen_problem *problem;
    double sign; /* s: of the problem, reversed for the most negative values */
    int n, count, room;
    double *mu;          /* [room] descending */
    double *matrix_mu;   /* [room] the same quotient of the matrices as they are, rounding errors of
                            all elements included */
    double *noise;       /* [room] part of it that rounding the sums changes */
    double *stiffness;   /* [room] x^T K x as the caller evaluates it */
    double *x;           /* [room x n] x^T K x = 1 by the matrix */
    double *work, *form; /* [n] each */
    int refinements;     /* of every solution */
    double *correction;  /* [n] while solutions are refined, else NULL */
    sparse shifted;      /* K - s A/mu; without values until it is needed */
    matrix_factor *shifted_factor;
} candidates;

status candidates_alloc(candidates *p, const eigen_problem *problem, double sign, fault *f);
void candidates_free(candidates *p);
/* Size of the largest |mu|, from below, by a few powers of K^-1 A; 0 where A is nothing but
 * rounding. */
double candidates_scale(candidates *p, long *solutions);
/* 1: rounding alone makes x^T A x as large as `energy`. */
int candidates_is_rounding(const candidates *p, double energy, const double x[]);
/* Largest part of x^T K x that assembling K has changed, of the first `count` candidates. */
double candidates_departure(const candidates *p, int count);
/* From here on K^-1 A x is what K_product says: refined until the present departure leaves 1e-6 of
 * it. */
status candidates_refine(candidates *p, int count, fault *f);
/* y = K^-1 s A x. */
void candidates_apply(candidates *p, const double x[], double y[]);
/* Values below are rounding errors of the largest one, `scale`: n^(3/2) of them add up in a slender
 * structure of n unknowns. */
double candidates_least(int n, double scale);
/* Takes in vectors x[count x n], whatever their length; those with mu <= least are dropped. */
status candidates_add(candidates *p, int count, const double x[], double least, fault *f);
/* The same of vectors that were allocated and are the candidates' from now on. */
status candidates_take(candidates *p, int count, double *x, double least, fault *f);
/* K times each candidate, [count x n], for the caller to free; NULL: out of memory. */
double *candidates_products(const candidates *p);
/* Residual of candidate i and estimated error of its mu, both in parts of mu. One solution. */
void candidates_judge(candidates *p, int i, double *residual, double *error);

#endif
