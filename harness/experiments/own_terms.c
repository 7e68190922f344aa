/* Checks of optional terms of a formulation: its damping. */
#include <math.h>
#include <string.h>

#include <gsl/gsl_eigen.h>

#include "harness/experiments/experiments_impl.h"

enum { M = SPECIMEN_STRAINS };

/* Returns the smallest eigenvalue of a symmetric matrix; NaN: out of memory, or not computed. */
static double least_eigenvalue(int n, double A[])
{
    double value[M], least = INFINITY;
    gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc((size_t)n);
    if (w == NULL)
        return NAN;
    gsl_matrix_view a = gsl_matrix_view_array(A, (size_t)n, (size_t)n);
    gsl_vector_view v = gsl_vector_view_array(value, (size_t)n);
    const int failed = gsl_eigen_symm(&a.matrix, &v.vector, w);
    gsl_eigen_symm_free(w);
    for (int i = 0; i < n; i++)
        least = value[i] < least ? value[i] : least;
    return failed ? NAN : least;
}

void own_damping_check(const specimen *s, claims *c)
{
    const int n = s->strains;
    double V[M * M], size = 0;
    if (s->type.damping == NULL)
        return;
    claims_doing(c, "damping%s", s->words);
    memset(V, 0, sizeof V);
    s->type.damping(s->data, V);
    claim *symmetric = claims_open(c, "the damping matrix is symmetric", 1e-13),
          *dissipates = claims_open(c, "damping dissipates energy", 1e-12);
    for (int i = 0; i < n * n; i++)
        size = isnan(V[i]) ? NAN : fmax(size, fabs(V[i]));
    if (size == 0)
        return;
    claims_asks(dissipates, isfinite(size), "damping: V contains %g; give finite numbers%s", size,
                s->words);
    if (!isfinite(size))
        return;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            claims_departs(symmetric, fabs(V[n * i + j] - V[n * j + i]) / size,
                           "damping: entry %d, %d of V is %.6g, but the transposed entry is %.6g%s",
                           i + 1, j + 1, V[n * i + j], V[n * j + i], s->words);
    const double least = least_eigenvalue(n, V);
    claims_departs(dissipates,
                   least < 0    ? -least / size
                   : least >= 0 ? 0
                                : NAN,
                   "damping: V has the eigenvalue %.6g N s/m, so some motions gain energy; give a "
                   "positive semidefinite matrix%s",
                   least, s->words);
}
