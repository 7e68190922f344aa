/* Hager's estimate of the 1-norm condition number (W.W. Hager, SIAM J. Sci. Stat. Comput. 5, 1984),
 * from solutions alone.
 *
 * Translations, rotations and warping have different units, and a number that depends on them says
 * nothing: rows and columns are scaled by the root of the diagonal first, which for a positive
 * definite matrix is within a factor n of the best (A. van der Sluis, Numer. Math. 14, 1969). */
#include <math.h>
#include <stdlib.h>

#include "harness/numerics/sparse.h"

enum { MOST_STEPS = 5 };

typedef struct condition {
    matrix_factor *fa;
    int n;
    const double *scale; /* [n] S: the matrix is S A S */
} condition;

/* x := (S A S)^-1 x, or its transpose. */
static void solve_scaled(const condition *c, int transposed, double x[])
{
    for (int i = 0; i < c->n; i++)
        x[i] /= c->scale[i];
    if (transposed)
        factor_solve_transposed(c->fa, x);
    else
        factor_solve(c->fa, x);
    for (int i = 0; i < c->n; i++)
        x[i] /= c->scale[i];
}

/* |(S A S)^-1|_1: the largest column sum is sought by steps along the subgradient. x, z: work space
 * [n]. */
static double inverse_norm(const condition *c, double x[], double z[])
{
    const int n = c->n;
    double norm = 0;
    for (int i = 0; i < n; i++)
        x[i] = 1.0 / n;
    for (int step = 0; step < MOST_STEPS; step++) {
        double sum = 0, along = 0;
        int largest = 0;
        for (int i = 0; i < n; i++)
            z[i] = x[i];
        solve_scaled(c, 0, z);
        for (int i = 0; i < n; i++)
            sum += fabs(z[i]);
        if (!(sum > norm) && step > 0)
            break;
        norm = sum;
        for (int i = 0; i < n; i++)
            z[i] = z[i] >= 0 ? 1 : -1;
        solve_scaled(c, 1, z);
        for (int i = 0; i < n; i++) {
            along += z[i] * x[i];
            if (fabs(z[i]) > fabs(z[largest]))
                largest = i;
        }
        if (fabs(z[largest]) <= along)
            break;
        for (int i = 0; i < n; i++)
            x[i] = i == largest;
    }
    return norm;
}

/* Scale of every unknown and the norm of S A S; sum: work space [n]. */
static double scaled_norm(const sparse *a, double scale[], double sum[])
{
    double norm = 0;
    for (int j = 0; j < a->n; j++) {
        scale[j] = 1;
        sum[j] = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            if (a->row[k] == j && a->value[k] != 0)
                scale[j] = 1 / sqrt(fabs(a->value[k]));
    }
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            const double size = fabs(a->value[k]) * scale[i] * scale[j];
            sum[j] += size;
            if (a->symmetric && i != j)
                sum[i] += size;
        }
    for (int j = 0; j < a->n; j++)
        norm = fmax(norm, sum[j]);
    return norm;
}

double factor_condition(matrix_factor *fa, const sparse *a)
{
    const size_t n = (size_t)a->n;
    double *work = malloc((3 * n + 1) * sizeof *work), estimate = NAN;
    if (work == NULL)
        return estimate;
    const double norm = scaled_norm(a, work, work + n);
    const condition c = {fa, a->n, work};
    estimate = n == 0 ? 1 : norm * inverse_norm(&c, work + n, work + 2 * n);
    free(work);
    return estimate;
}
