/* By Sylvester's law the number of mu > s > 0 is that of the negative pivots of K - A/s. The pivots
 * tell sides apart as long as s keeps its distance from every eigenvalue: by more than rounding the
 * matrices moves them. */
#include "harness/numerics/candidates_count.h"

#include <math.h>
#include <stddef.h>

static const double close = 1e-9; /* relative distance of eigenvalues that are not told apart */

/* Unknowns from which on room is worth more than having it at once again. */
enum { LARGE = 20000 };

void candidates_count_rest(candidates *p)
{
    if (p->n < LARGE)
        return;
    sparse_free_values(&p->shifted);
    factor_free(p->shifted_factor);
    p->shifted_factor = NULL;
}

status candidates_count_above(candidates *p, double s, int *above, eigen_result *work, fault *f)
{
    const sparse *K = p->problem->K;
    if (p->shifted.value == NULL)
        TRY(sparse_alloc_like(K, &p->shifted, f));
    if (p->shifted_factor == NULL)
        TRY(factor_alloc_like(p->problem->K_factor, K, &p->shifted_factor, f));
    for (int i = 0; i < K->column[p->n]; i++)
        p->shifted.value[i] = K->value[i] - p->sign * p->problem->A->value[i] / s;
    const status outcome = factor_numeric(p->shifted_factor, &p->shifted, f);
    *above = factor_count(p->shifted_factor).negative_pivots;
    work->factorisations++;
    return outcome;
}

/* Number of candidates above the cluster that the one of rank `wanted` belongs to, and the largest
 * value of the cluster. */
static int above_cluster(const candidates *p, int wanted, double *top)
{
    const double *mu = p->matrix_mu;
    int q = wanted - 1;
    *top = mu[q];
    while (q > 0 &&
           mu[q - 1] - *top <= (close + 16 * fmax(p->noise[q - 1], p->noise[q])) * mu[q - 1])
        *top = fmax(*top, mu[--q]);
    return q;
}

/* The inertia is that of the matrices: so are the values between which it is counted. */
status candidates_count_missing(candidates *p, int wanted, int *missing, eigen_result *work,
                                fault *f)
{
    static const double place[] = {0.5, 0.35, 0.65};
    double low;
    const int q = above_cluster(p, wanted, &low);
    /* just above the cluster: farther up, what is missing could lie below */
    const double told_apart = 2 * close + 32 * p->noise[q], near = 1e-2;
    const double high = q > 0 ? fmin(p->matrix_mu[q - 1], low * (1 + fmax(near, told_apart)))
                              : low * (1 + told_apart);
    int above = 0;
    *missing = -1;
    /* A count that does not fit is not believed at once: there is no pivoting. */
    for (int i = 0; i < 3; i++) {
        const status outcome =
            candidates_count_above(p, low + place[i] * (high - low), &above, work, f);
        if (outcome == STATUS_SINGULAR)
            continue;
        TRY(outcome);
        *missing = above - q;
        if (*missing == 0)
            break;
    }
    if (*missing < 0)
        return fault_set(
            f, STATUS_NOT_CONVERGED,
            "%d eigenvalues found where the inertia counts fewer, or cannot be counted", q);
    return STATUS_OK;
}
